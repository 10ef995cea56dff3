// @ts-check
/** Lines that a drag snaps to: the container's middle, and edges and middles of what is next in row and column. */

import { boundsOf, ringsOf } from "./rings.js";

/** @typedef {[number, number, number, number]} Box */
/** @typedef {{axis: 0 | 1, at: number, from: number, to: number}} Guide */

/** How near a line draws what is dragged to it, px: more draws from afar, less is missed. */
const NEAR = 5;

export class Snapping {
  /**
   * @param {import("./collage.js").Collage} collage
   * @param {import("./view.js").View} view
   */
  constructor(collage, view) {
    this.collage = collage;
    this.view = view;
    /** @type {Guide[]} */
    this.guides = [];
    /** @type {Box | null} */
    this.box = null;
    /** @type {Box[]} */
    this.others = [];
    /** @type {Box} */
    this.room = [0, 0, 0, 0];
  }

  /** Begin to drag items: the lines are those of how all lie now. @param {Set<number>} ids */
  begin(ids) {
    const { collage } = this;
    const dragged = [...ids].filter((id) => collage.rows.has(id)).map((id) => collage.bounds(id));
    this.box = dragged.length ? dragged.reduce((a, b) => [Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.max(a[2], b[2]), Math.max(a[3], b[3])]) : null;
    this.others = collage.items.flatMap(({ id }, k) => {
      if (ids.has(id)) return [];
      const [left, top, right, bottom] = collage.bounds(id);
      return collage.tiling.shifts(k).map(([x, y]) => /** @type {Box} */ ([left + x, top + y, right + x, bottom + y]));
    });
    this.room = /** @type {Box} */ (boundsOf(ringsOf(collage.scene?.outline ?? "")));
  }

  /**
   * The way that a drag goes once it has snapped.
   * @param {number} x canvas units
   * @param {number} y
   * @returns {[number, number]}
   */
  snapped(x, y) {
    const box = this.box;
    this.guides = [];
    if (!box) return [x, y];
    const now = /** @type {Box} */ ([box[0] + x, box[1] + y, box[2] + x, box[3] + y]);
    return [x + this.pull(now, 0), y + this.pull(now, 1)];
  }

  end() {
    this.guides = [];
    this.box = null;
  }

  /**
   * How far the nearest line is along an axis; 0 where none is near.
   * @param {Box} box
   * @param {0 | 1} axis
   */
  pull(box, axis) {
    const lines = this.lines(box, axis);
    const off = lines.flatMap(({ at, end, of }) => placesOf(box, axis).filter((_, k) => of === k).map((place) => ({ by: at - place, at, end })));
    const [best] = off.filter(({ by }) => Math.abs(by) * this.view.zoom <= NEAR).sort((a, b) => Math.abs(a.by) - Math.abs(b.by));
    if (!best) return 0;
    const [from, to] = [Math.min(best.end[0], box[1 - axis]), Math.max(best.end[1], box[3 - axis])];
    this.guides.push({ axis, at: best.at, from, to });
    return best.by;
  }

  /**
   * Lines across an axis, the edge or middle that each is for, and how long it is.
   * @param {Box} box
   * @param {0 | 1} axis
   */
  lines(box, axis) {
    const other = /** @type {0 | 1} */ (1 - axis);
    const beside = this.others.filter((one) => one[axis] < box[axis + 2] && one[axis + 2] > box[axis]);
    const middle = placesOf(box, other)[1];
    const sides = [beside.filter((one) => placesOf(one, other)[1] < middle), beside.filter((one) => placesOf(one, other)[1] >= middle)];
    const next = sides.flatMap((side) => side.sort((a, b) => Math.abs(placesOf(a, other)[1] - middle) - Math.abs(placesOf(b, other)[1] - middle)).slice(0, 1));
    const end = (/** @type {Box} */ one) => [one[other], one[other + 2]];
    return [{ at: placesOf(this.room, axis)[1], of: 1, end: end(this.room) }, ...next.flatMap((one) => placesOf(one, axis).map((at, of) => ({ at, of, end: end(one) })))];
  }
}

/**
 * First edge, middle and last edge of a box.
 * @param {Box} box
 * @param {0 | 1} axis
 */
function placesOf(box, axis) {
  return [box[axis], (box[axis] + box[axis + 2]) / 2, box[axis + 2]];
}
