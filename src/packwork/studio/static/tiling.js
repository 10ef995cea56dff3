// @ts-check
/** Canvases that repeat without a seam: where an item is seen, and how much of the plane. */

/** @typedef {[number, number]} Shift */

/** @type {Shift[]} */
const HERE = [[0, 0]];
/** Tiles seen side by side in the preview. */
const ACROSS = 3;

export class Tiling {
  /** @param {import("./collage.js").Collage} collage */
  constructor(collage) {
    this.collage = collage;
    /** Whether several tiles are seen side by side. */
    this.isPreview = false;
  }

  /** Width and height of the cell, and the drop of each column; null of what has an edge. */
  get repeat() {
    return this.collage.scene?.repeat ?? null;
  }

  /** What is seen of the plane: x, y, width and height, canvas units. */
  get whole() {
    const { width, height } = this.collage.scene ?? { width: 1, height: 1 };
    if (!this.repeat || !this.isPreview) return { x: 0, y: 0, width, height };
    const far = (ACROSS - 1) / 2;
    return { x: -far * width, y: -far * height, width: ACROSS * width, height: ACROSS * height };
  }

  /** The same as a box: left, top, right, bottom. */
  get box() {
    const { x, y, width, height } = this.whole;
    return [x, y, x + width, y + height];
  }

  /** Where the canvas is seen. @returns {Shift[]} */
  get sheets() {
    const { width, height } = this.collage.scene ?? { width: 1, height: 1 };
    if (!this.repeat || !this.isPreview) return HERE;
    return [-1, 0, 1].flatMap((row) => [-1, 0, 1].map((column) => /** @type {Shift} */ ([column * width, row * height])));
  }

  /** Translations by which the item of a row is seen. @param {number} k @returns {Shift[]} */
  shifts(k) {
    const { collage, repeat } = this;
    if (!repeat) return HERE;
    const [x, y] = collage.shown.subarray(4 * k, 4 * k + 2);
    const reach = collage.reach(k);
    const [left, top, right, bottom] = this.box;
    const [width, height, drop] = repeat;
    const found = [];
    for (const a of between((left - x - reach) / width, (right - x + reach) / width)) {
      const down = a * drop;
      for (const b of between((top - y - reach - down) / height, (bottom - y + reach - down) / height)) found.push(/** @type {Shift} */ ([a * width, down + b * height]));
    }
    return found;
  }

  /** Places where the item of a row is seen, canvas units. @param {number} k @returns {Shift[]} */
  places(k) {
    const [x, y] = this.collage.shown.subarray(4 * k, 4 * k + 2);
    return this.shifts(k).map(([dx, dy]) => [x + dx, y + dy]);
  }

  /**
   * Translation that brings a point to the image of it that is nearest to another one.
   * @param {number} x from one to the other
   * @param {number} y
   * @returns {Shift}
   */
  nearest(x, y) {
    const [width, height, drop] = /** @type {number[]} */ (this.repeat);
    const near = Math.round(x / width);
    const found = [near - 1, near, near + 1].map((a) => /** @type {Shift} */ ([a * width, a * drop + height * Math.round((y - a * drop) / height)]));
    return found.reduce((best, one) => (Math.hypot(x - one[0], y - one[1]) < Math.hypot(x - best[0], y - best[1]) - 1e-9 ? one : best));
  }

  /** Translation by whole canvases that brings a point to where it is seen. @param {number} x @param {number} y @returns {Shift} */
  home(x, y) {
    const { width, height } = this.collage.scene ?? { width: 1, height: 1 };
    const [left, top, right, bottom] = this.box;
    return [width * over(x, left, right, width), height * over(y, top, bottom, height)];
  }

  /** Take the places of a frame for those images that are shown, as far as they are seen. */
  follow() {
    const { collage } = this;
    if (!this.repeat) return;
    const { poses, shown, items, hand } = collage;
    for (let k = 0; k < items.length; k++) {
      const at = 4 * k;
      const [x, y] = shown[at + 3] < 0 ? [0, 0] : this.nearest(shown[at] - poses[at], shown[at + 1] - poses[at + 1]);
      poses[at] += x;
      poses[at + 1] += y;
      if (!hand.has(items[k].id)) this.move(k, this.home(poses[at], poses[at + 1]));
    }
  }

  /** Have all items be images of them that are seen. */
  bringHome() {
    const { items, poses } = this.collage;
    for (let k = 0; k < items.length; k++) this.move(k, this.home(poses[4 * k], poses[4 * k + 1]));
  }

  /** Have an item be the image of it that lies elsewhere. @param {number} k @param {Shift} shift */
  move(k, [x, y]) {
    for (const numbers of [this.collage.poses, this.collage.shown]) {
      numbers[4 * k] += x;
      numbers[4 * k + 1] += y;
    }
  }
}

/** @param {number} low @param {number} high */
function between(low, high) {
  const first = Math.ceil(low);
  return Array.from({ length: Math.max(Math.floor(high) - first + 1, 0) }, (_, k) => first + k);
}

/** How many steps bring a number between two others. @param {number} at @param {number} low @param {number} high @param {number} step */
function over(at, low, high, step) {
  if (at < low) return Math.ceil((low - at) / step);
  return at > high ? -Math.ceil((at - high) / step) : 0;
}
