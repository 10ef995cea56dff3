// @ts-check
/** What lies still, as one picture: while a few items move, only these are drawn anew. */

/** @typedef {import("./collage.js").Collage} Collage */

/** Pictures for which an item lies still until it is part of the backdrop again. */
const QUIET = 20;
/** How far about an item that begins to move others are taken out with it, in its reaches. */
const NEAR = 3.5;
/** Share of the items that may be drawn anew for nothing. */
const SLACK = 0.2;
/** How far an item may move and still be taken to lie where it is in the picture, px: nobody sees it, and at rest nothing is off. */
const NEARLY = 0.1;

/** @typedef {[number, number, number, number]} Box left, top, right, bottom, canvas units */

export class Backdrop {
  /** @param {Collage} collage */
  constructor(collage) {
    this.collage = collage;
    /** @type {OffscreenCanvas | null} */
    this.picture = null;
    /** What the picture is of, beside poses. @type {unknown[]} */
    this.key = [];
    this.isWhole = false;
    /** Where each item was when it was last seen to move. */
    this.last = new Float32Array(0);
    /** Pictures since each item has moved. */
    this.still = new Uint8Array(0);
    /** Which items are not in the picture. */
    this.loose = new Uint8Array(0);
    /** Where each is in it. */
    this.drawn = new Float32Array(0);
    /** Parts of it that are stale; all of it unless some are told, and so always at rest: parts of a curve differ by a shade from all of it. @type {Box[] | null} */
    this.regions = null;
    /** Rows of the items that these are about. @type {number[]} */
    this.changed = [];
  }

  /**
   * Look what has moved; whether the picture is of what is to be seen, or has to be made first.
   * @param {unknown[]} key all that it depends on beside poses
   * @param {boolean} isMoving
   * @param {number} perUnit pixels of a canvas unit
   * @returns {"good" | "stale" | "new"}
   */
  look(key, isMoving, perUnit) {
    const moved = this.follow(perUnit);
    if (key.length !== this.key.length || key.some((one, k) => one !== this.key[k])) {
      [this.key, this.picture] = [key, null];
      return "new";
    }
    const wants = isMoving ? moved.some((k) => !this.loose[k]) || this.isSlack : this.loose.includes(1) || this.drawn.some((value, k) => value !== this.collage.shown[k]);
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

  /** Rows of the items that have moved by more than can be seen. @param {number} perUnit pixels of a canvas unit */
  follow(perUnit) {
    const { items, shown, hand } = this.collage;
    if (this.last.length !== shown.length) {
      this.last = new Float32Array(shown.length);
      [this.still, this.loose] = [new Uint8Array(items.length), new Uint8Array(items.length)];
    }
    const moved = [];
    for (let k = 0; k < items.length; k++) {
      if (hand.has(items[k].id) || away(this.last, shown, 4 * k, this.collage.reach(k) / shown[4 * k + 3]) * perUnit > NEARLY) {
        moved.push(k);
        this.last.set(shown.subarray(4 * k, 4 * k + 4), 4 * k);
        this.still[k] = 0;
      } else if (this.still[k] < QUIET) this.still[k]++;
    }
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
    for (let k = 0; k < items.length; k++) this.loose[k] = Number(isMoving && this.still[k] < QUIET);
    if (!isMoving) this.still.fill(QUIET);
    for (const m of isMoving ? moved.filter((k) => hand.has(items[k].id)) : []) {
      const reach = NEAR * this.collage.reach(m);
      for (let k = 0; k < items.length; k++) {
        const isNear = Math.abs(shown[4 * k] - shown[4 * m]) < reach && Math.abs(shown[4 * k + 1] - shown[4 * m + 1]) < reach;
        if (isNear) this.loose[k] = 1;
      }
    }
    // What repeats is in several places.
    const isPartial = isMoving && !this.collage.tiling.repeat && this.picture && this.isWhole && this.drawn.length === shown.length;
    this.changed = [...items.keys()].filter((k) => before[k] !== this.loose[k]);
    this.regions = isPartial ? apart(this.changed.flatMap((k) => this.boxes(k, before[k] === 1))) : null;
  }

  /**
   * Boxes about an item where it is in the picture, and where it is to be.
   * @param {number} k
   * @param {boolean} wasLoose whether it is not in the picture
   */
  boxes(k, wasLoose) {
    const places = [...(wasLoose ? [] : [this.drawn]), ...(this.loose[k] ? [] : [this.collage.shown])];
    return places.map((poses) => this.box(k, poses));
  }

  /** @param {number} k @param {Float32Array} poses @returns {Box} */
  box(k, poses) {
    const [x, y] = poses.subarray(4 * k, 4 * k + 2);
    const reach = this.collage.reach(k, poses);
    return [x - reach, y - reach, x + reach, y + reach];
  }

  /** Whether an item is to be in a part of the picture. @param {number} k @param {Box} [part] all of it unless told */
  isStale(k, part) {
    return !this.loose[k] && (!part || meet(this.box(k, this.collage.shown), part));
  }

  /** Note that the picture shows what is to be in it. @param {boolean} isWhole */
  done(isWhole) {
    const { shown } = this.collage;
    this.isWhole = isWhole;
    // What lies near by was drawn in part.
    if (this.regions) for (const k of this.changed) this.drawn.set(shown.subarray(4 * k, 4 * k + 4), 4 * k);
    else this.drawn = shown.slice();
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
 * How far the edge of an item is from where it was at most, or nearly so, canvas units.
 * @param {Float32Array} one
 * @param {Float32Array} other
 * @param {number} at
 * @param {number} radius item units
 */
function away(one, other, at, radius) {
  const edge = radius * Math.max(Math.abs(other[at + 2] - one[at + 2]) * other[at + 3], Math.abs(other[at + 3] - one[at + 3]));
  return Math.max(Math.abs(other[at] - one[at]), Math.abs(other[at + 1] - one[at + 1]), edge);
}

/** @param {Box} one @param {Box} other */
function meet(one, other) {
  return one[0] < other[2] && other[0] < one[2] && one[1] < other[3] && other[1] < one[3];
}

/** Boxes that hold all of some, and do not meet. @param {Box[]} boxes */
function apart(boxes) {
  /** @type {Box[]} */
  let found = [];
  for (let box of boxes) {
    for (let met = found.filter((one) => meet(one, box)); met.length; met = found.filter((one) => meet(one, box))) {
      found = found.filter((one) => !met.includes(one));
      box = [box, ...met].reduce(([l, t, r, b], one) => [Math.min(l, one[0]), Math.min(t, one[1]), Math.max(r, one[2]), Math.max(b, one[3])]);
    }
    found.push(box);
  }
  return found;
}
