// @ts-check
/** What lies still, as one picture: while a few items move, only these are drawn anew. */

/** @typedef {import("./collage.js").Collage} Collage */

/** Pictures for which an item lies still until it is part of the backdrop again. */
const QUIET = 20;
/** How far about an item that begins to move others are taken out with it, in its extents. */
const NEAR = 2.5;
/** Share of the items that may be drawn anew for nothing. */
const SLACK = 0.2;

export class Backdrop {
  /** @param {Collage} collage */
  constructor(collage) {
    this.collage = collage;
    /** @type {OffscreenCanvas | null} */
    this.picture = null;
    /** What the picture is of, beside poses. @type {unknown[]} */
    this.key = [];
    this.isWhole = false;
    this.last = new Float32Array(0);
    /** Pictures since each item has moved. */
    this.still = new Uint8Array(0);
    /** Which items are not in the picture. */
    this.loose = new Uint8Array(0);
    /** Where each is in it. */
    this.drawn = new Float32Array(0);
    /** Part of it that is stale, canvas units: left, top, right, bottom; all of it unless one is told. @type {number[] | null} */
    this.region = null;
  }

  /**
   * Look what has moved; whether the picture is of what is to be seen, or has to be made first.
   * @param {unknown[]} key all that it depends on beside poses
   * @param {boolean} isMoving
   * @returns {"good" | "stale" | "new"}
   */
  look(key, isMoving) {
    const moved = this.follow();
    if (key.length !== this.key.length || key.some((one, k) => one !== this.key[k])) {
      [this.key, this.picture] = [key, null];
      return "new";
    }
    const wants = isMoving ? moved.some((k) => !this.loose[k]) || this.isSlack : moved.length || this.loose.includes(1);
    if (this.picture && this.isWhole && !wants) return "good";
    this.loosen(moved, isMoving);
    return "stale";
  }

  /** Whether many are drawn anew that could be in the picture. */
  get isSlack() {
    let count = 0;
    for (let k = 0; k < this.loose.length; k++) count += Number(this.loose[k] && this.still[k] >= QUIET);
    return count > SLACK * this.loose.length;
  }

  /** Rows of the items that have moved since the last picture. */
  follow() {
    const { items, shown, hand } = this.collage;
    if (this.last.length !== shown.length) {
      this.last = new Float32Array(shown.length);
      [this.still, this.loose] = [new Uint8Array(items.length), new Uint8Array(items.length)];
    }
    const moved = [];
    for (let k = 0; k < items.length; k++) {
      if (hand.has(items[k].id) || differ(this.last, shown, 4 * k)) {
        moved.push(k);
        this.still[k] = 0;
      } else if (this.still[k] < QUIET) this.still[k]++;
    }
    this.last.set(shown);
    return moved;
  }

  /**
   * Choose what is not in the next picture: what moves, and what will soon.
   * @param {number[]} moved
   * @param {boolean} isMoving
   */
  loosen(moved, isMoving) {
    const { items, shown, hand } = this.collage;
    const before = this.loose.slice();
    this.region = null;
    for (let k = 0; k < items.length; k++) this.loose[k] = Number(isMoving && this.still[k] < QUIET);
    if (!isMoving) {
      this.still.fill(QUIET);
      return;
    }
    const held = moved.filter((k) => hand.has(items[k].id));
    for (const m of held) {
      const look = this.collage.looks.get(items[m].shape);
      const reach = NEAR * (look ? look.extent : 1) * shown[4 * m + 3];
      for (let k = 0; k < items.length; k++) {
        const isNear = Math.abs(shown[4 * k] - shown[4 * m]) < reach && Math.abs(shown[4 * k + 1] - shown[4 * m + 1]) < reach;
        if (isNear) this.loose[k] = 1;
      }
    }
    // What repeats is in several places.
    if (!this.collage.tiling.repeat && this.picture && this.isWhole && this.drawn.length === shown.length) this.region = this.changed(before);
  }

  /**
   * Box about the items that are in the picture and no longer are to be, or the other way round.
   * @param {Uint8Array} before which were not in it
   */
  changed(before) {
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    this.collage.items.forEach((item, k) => {
      if (before[k] === this.loose[k]) return;
      const [x, y, , scale] = (this.loose[k] ? this.drawn : this.collage.shown).subarray(4 * k, 4 * k + 4);
      const reach = scale * (this.collage.looks.get(item.shape)?.extent ?? 1);
      [x - reach, y - reach].forEach((value, axis) => (box[axis] = Math.min(box[axis], value)));
      [x + reach, y + reach].forEach((value, axis) => (box[axis + 2] = Math.max(box[axis + 2], value)));
    });
    return box;
  }

  /** Whether an item is to be in the stale part of the picture. @param {number} k */
  isStale(k) {
    if (this.loose[k]) return false;
    const { items, looks, shown } = this.collage;
    const [x, y, , scale] = shown.subarray(4 * k, 4 * k + 4);
    const [reach, box] = [scale * (looks.get(items[k].shape)?.extent ?? 1), this.region];
    return !box || (x + reach > box[0] && y + reach > box[1] && x - reach < box[2] && y - reach < box[3]);
  }

  /** Note that the picture shows what is to be in it. @param {boolean} isWhole */
  done(isWhole) {
    this.isWhole = isWhole;
    this.drawn = this.collage.shown.slice();
  }

  /**
   * Where the picture is to be drawn.
   * @param {number} width
   * @param {number} height
   */
  pen(width, height) {
    if (!this.picture || this.picture.width !== width || this.picture.height !== height) {
      this.picture = new OffscreenCanvas(width, height);
    }
    return /** @type {OffscreenCanvasRenderingContext2D} */ (this.picture.getContext("2d", { alpha: false }));
  }
}

/**
 * @param {Float32Array} one
 * @param {Float32Array} other
 * @param {number} at
 */
function differ(one, other, at) {
  return (
    one[at] !== other[at] || one[at + 1] !== other[at + 1] ||
    one[at + 2] !== other[at + 2] || one[at + 3] !== other[at + 3]
  );
}
