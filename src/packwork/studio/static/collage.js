// @ts-check
/** What there is to be seen: items, how they look, where they are, and where they are shown. */

import { kindOf } from "./kinds.js";
import { ringsOf } from "./rings.js";
import { Tiling } from "./tiling.js";

/** @typedef {import("./wire.js").Scene} Scene */
/** @typedef {import("./wire.js").Shape} Shape */
/** @typedef {import("./wire.js").Thing} Thing */
/** @typedef {import("./wire.js").State} State */
/** @typedef {import("./connection.js").Frame} Frame */
/** @typedef {{x: number, y: number, angle: number, scale: number}} Pose */
/** @typedef {Shape & {outlinePath: Path2D, inkPath: Path2D | null, extent: number, half: [number, number], points: [number, number][]}} Look half: of a box about its middle that holds box and outline */

/** Time in which what is shown comes most of the way to where it is, ms. */
const EASE = 38;
/** How near is there, as shares of an item: nothing can be seen of less. */
const THERE = 0.002;

export class Collage {
  constructor() {
    /** @type {Map<string, Look>} */
    this.looks = new Map();
    /** @type {Scene | null} */
    this.scene = null;
    /** @type {State | null} */
    this.state = null;
    /** @type {Thing[]} */
    this.items = [];
    /** @type {Map<number, number>} */
    this.rows = new Map();
    /** @type {Float32Array} */
    this.poses = new Float32Array(0);
    /** @type {Float32Array} */
    this.shown = new Float32Array(0);
    /** What the hand has, until a frame knows it. @type {Map<number, {pose: Pose, until: number}>} */
    this.hand = new Map();
    this.tiling = new Tiling(this);
    this.hasPoses = false;
    /** The newest command of this page that is done. */
    this.done = 0;
  }

  /** @param {Shape[]} shapes */
  addShapes(shapes) {
    for (const shape of shapes) {
      const [left, top, right, bottom] = shape.box;
      const inkPath = shape.svg ? null : new Path2D(shape.ink);
      const extent = Math.max(right - left, bottom - top);
      const points = ringsOf(shape.outline).flat();
      const half = /** @type {[number, number]} */ ([0, 1].map((axis) => points.reduce((most, one) => Math.max(most, Math.abs(one[axis])), Math.max(-shape.box[axis], shape.box[axis + 2]))));
      this.looks.set(shape.key, { ...shape, outlinePath: new Path2D(shape.outline), inkPath, extent, half, points });
    }
  }

  /** @param {Scene} scene */
  setScene(scene) {
    const before = new Map(this.items.map((item, k) => [item.id, k]));
    const count = scene.items.length;
    const [shown, poses] = [new Float32Array(4 * count), new Float32Array(4 * count)];
    scene.items.forEach((item, k) => {
      const row = before.get(item.id);
      if (row === undefined) shown[4 * k + 3] = -1;
      else {
        shown.set(this.shown.subarray(4 * row, 4 * row + 4), 4 * k);
        poses.set(this.poses.subarray(4 * row, 4 * row + 4), 4 * k);
      }
    });
    this.hasPoses = count > 0 && scene.items.every((item) => before.has(item.id)) && this.hasPoses;
    this.scene = scene;
    this.items = scene.items;
    this.rows = new Map(scene.items.map((item, k) => [item.id, k]));
    [this.shown, this.poses] = [shown, poses];
    for (const id of this.hand.keys()) if (!this.rows.has(id)) this.hand.delete(id);
  }

  /**
   * Take over where items are; false if the frame is of another scene.
   * @param {Frame} frame
   */
  setFrame(frame) {
    if (!this.scene || frame.version !== this.scene.version) return false;
    if (frame.poses.length !== this.poses.length) return false;
    [this.poses, this.done] = [frame.poses, frame.done];
    for (const [id, held] of this.hand) if (held.until && held.until <= frame.done) this.hand.delete(id);
    this.tiling.follow();
    for (let k = 0; k < this.items.length; k++) if (this.shown[4 * k + 3] < 0) this.appear(k);
    this.hasPoses = true;
    return true;
  }

  /**
   * Show a new item: small, at its place.
   * @param {number} k
   */
  appear(k) {
    this.shown.set(this.poses.subarray(4 * k, 4 * k + 4), 4 * k);
    this.shown[4 * k + 3] *= 0.2;
  }

  /**
   * Bring what is shown nearer to where it is; whether anything is still on its way.
   * @param {number} milliseconds
   * @param {boolean} isCalm show everything at its place at once
   */
  ease(milliseconds, isCalm) {
    const share = isCalm ? 1 : 1 - Math.exp(-milliseconds / EASE);
    let moves = false;
    for (let k = 0; k < this.items.length; k++) {
      const at = 4 * k;
      const given = this.hand.get(this.items[k].id);
      if (given) {
        this.shown.set([given.pose.x, given.pose.y, given.pose.angle, given.pose.scale], at);
        continue;
      }
      moves = this.easeOne(at, share) || moves;
    }
    return moves;
  }

  /**
   * @param {number} at
   * @param {number} share
   */
  easeOne(at, share) {
    const { shown, poses } = this;
    const size = Math.max(poses[at + 3], 1e-9);
    const look = this.looks.get(this.items[at / 4].shape);
    const extent = size * (look ? look.extent : 1);
    const turn = shortest(poses[at + 2] - shown[at + 2]);
    const away = Math.max(
      Math.abs(poses[at] - shown[at]) / extent,
      Math.abs(poses[at + 1] - shown[at + 1]) / extent,
      Math.abs(turn),
      Math.abs(poses[at + 3] - shown[at + 3]) / size,
    );
    const step = away < THERE ? 1 : share;
    shown[at] += step * (poses[at] - shown[at]);
    shown[at + 1] += step * (poses[at + 1] - shown[at + 1]);
    shown[at + 2] += step * turn;
    shown[at + 3] += step * (poses[at + 3] - shown[at + 3]);
    return step < 1;
  }

  /**
   * Radius of the disc about the middle of an item that holds all that is drawn of it, canvas units.
   * @param {number} k its row
   * @param {Float32Array} poses
   */
  reach(k, poses = this.shown) {
    const { shape, stretch, halo } = this.items[k];
    const look = this.looks.get(shape);
    if (!look) return 0;
    const root = Math.sqrt(stretch);
    const rim = halo ? this.scene?.rim ?? 0 : 0;
    return poses[4 * k + 3] * Math.hypot(root * look.half[0], look.half[1] / root) + rim * Math.max(root, 1 / root);
  }

  /**
   * Where an item is shown.
   * @param {number} id
   * @returns {Pose | null}
   */
  pose(id) {
    const k = this.rows.get(id);
    if (k === undefined) return null;
    const [x, y, angle, scale] = this.shown.subarray(4 * k, 4 * k + 4);
    return { x, y, angle, scale };
  }

  /**
   * Where an item is, or where the hand has it.
   * @param {number} id
   * @returns {Pose | null}
   */
  target(id) {
    const k = this.rows.get(id);
    if (k === undefined) return null;
    const [x, y, angle, scale] = this.poses.subarray(4 * k, 4 * k + 4);
    return this.hand.get(id)?.pose ?? { x, y, angle, scale };
  }

  /**
   * The nearest angle that an item may have, radians.
   * @param {number} id
   * @param {number} angle
   */
  allowed(id, angle) {
    if (!kindOf(this).turns && this.item(id)?.held[1]) return this.pose(id)?.angle ?? angle;
    const angles = this.scene?.angles;
    if (!angles?.length) return angle;
    const off = angles.map((one) => shortest(one - angle));
    return angle + off.reduce((least, one) => (Math.abs(one) < Math.abs(least) - 1e-9 ? one : least));
  }

  /**
   * The angle that an item has once it is turned on; where only some are allowed, the next of them.
   * @param {number} id
   * @param {number} by radians
   */
  turned(id, by) {
    const from = this.pose(id)?.angle ?? 0;
    const [angles, way] = [this.scene?.angles, Math.sign(by)];
    if (!angles?.length) return from + by;
    const ahead = angles.map((one) => way * shortest(way * (one - from) - Math.PI) + way * Math.PI).filter((off) => Math.abs(off) > 1e-3);
    return this.allowed(id, from + (ahead.length ? way * Math.min(...ahead.map(Math.abs)) : 0));
  }

  /** @param {number} id */
  item(id) {
    const k = this.rows.get(id);
    return k === undefined ? null : this.items[k];
  }

  /** @param {Thing} item */
  look(item) {
    return /** @type {Look} */ (this.looks.get(item.shape));
  }

  /**
   * The one colour of an item, as colour fields take it; null of a drawing in several.
   * @param {number} id
   */
  colour(id) {
    const item = this.item(id);
    const look = item && this.looks.get(item.shape);
    if (!look) return null;
    const found = new Set(look.svg ? look.svg.match(/#[0-9a-f]{6}\b/gi) : [look.fill.slice(0, 7)]);
    return found.size === 1 ? [...found][0] : null;
  }

  /**
   * Corners of an item's box in place.
   * @param {number} id
   * @returns {[number, number][]}
   */
  corners(id) {
    const [item, pose] = [this.item(id), this.pose(id)];
    if (!item || !pose) return [];
    const [left, top, right, bottom] = this.look(item).box;
    const matrix = matrixOf(pose, item.stretch);
    return [[left, top], [right, top], [right, bottom], [left, bottom]].map(([x, y]) => {
      const point = matrix.transformPoint({ x, y });
      return [point.x, point.y];
    });
  }

  /**
   * Box about the outline of an item, where it is.
   * @param {number} id
   * @returns {[number, number, number, number]}
   */
  bounds(id) {
    const [item, pose] = [this.item(id), this.target(id)];
    if (!item || !pose) return [0, 0, 0, 0];
    const look = this.look(item);
    const { a, b, c, d, e, f } = matrixOf(pose, item.stretch);
    const box = /** @type {[number, number, number, number]} */ ([Infinity, Infinity, -Infinity, -Infinity]);
    for (const [px, py] of look.points) {
      const [x, y] = [a * px + c * py + e, b * px + d * py + f];
      [box[0], box[1], box[2], box[3]] = [Math.min(box[0], x), Math.min(box[1], y), Math.max(box[2], x), Math.max(box[3], y)];
    }
    return box;
  }

  /**
   * Box about items in place: left, top, right, bottom.
   * @param {Iterable<number>} ids
   * @returns {[number, number, number, number] | null}
   */
  box(ids) {
    const points = [...ids].flatMap((id) => this.corners(id));
    if (!points.length) return null;
    const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
    return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
  }
}

/**
 * Map from an item's units to canvas units.
 * @param {Pose} pose
 * @param {number} stretch
 */
export function matrixOf(pose, stretch) {
  const root = Math.sqrt(stretch);
  const [cos, sin] = [Math.cos(pose.angle) * pose.scale, Math.sin(pose.angle) * pose.scale];
  return new DOMMatrix([cos * root, sin * root, -sin / root, cos / root, pose.x, pose.y]);
}

/** @param {number} angle */
function shortest(angle) {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}
