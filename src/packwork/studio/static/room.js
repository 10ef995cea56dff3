// @ts-check
/** The container in the hand: moved, scaled and turned by its frame, reshaped by its points. */

import { boundsOf, pathOf, pulled, ringsOf, tellingPoints } from "./rings.js";

/** @typedef {import("./rings.js").Ring} Ring */
/** @typedef {{x: number, y: number}} Point */
/** @typedef {CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D} Pen */
/** @typedef {{kind: "point", ring: number, which: number} | {kind: "scale" | "turn" | "move"}} Grip */

/** Distance of the turning handle from the frame, of the frame from the outline, half a handle, px. */
const AWAY = 30;
const EDGE = 12;
const HALF = 5;
/** Angles that are snapped to with shift, degrees. */
const SNAP = 15;

export class Room {
  /**
   * @param {import("./stage.js").Stage} stage
   * @param {import("./connection.js").Connection} connection
   */
  constructor(stage, connection) {
    this.stage = stage;
    this.connection = connection;
    this.isOn = false;
    this.text = "";
    /** @type {Ring[]} */
    this.rings = [];
    /** @type {number[][]} */
    this.telling = [];
    /** @type {Ring[] | null} as the hand has them */
    this.preview = null;
    /** @type {object | null} what is told when the hand lets go */
    this.command = null;
    /** @type {Grip | null} */
    this.grip = null;
    /** Which point keys move, counted through all rings; -1 the whole. */
    this.at = -1;
  }

  /** Take over the outline that there is now. */
  refresh() {
    const text = this.stage.collage.scene?.outline ?? "";
    if (!this.isOn || text === this.text) return;
    this.text = text;
    this.rings = ringsOf(text);
    this.telling = tellingPoints(this.rings);
    this.preview = null;
    if (this.at >= this.telling.flat().length) this.at = -1;
  }

  /** @param {boolean} isOn */
  turnOn(isOn) {
    this.isOn = isOn;
    this.at = -1;
    this.text = "";
    this.preview = null;
    this.refresh();
  }

  get path() {
    return this.preview ? pathOf(this.preview) : null;
  }

  /** Frame about the container, px. */
  get frame() {
    const [left, top, right, bottom] = boundsOf(this.preview ?? this.rings);
    const [a, b] = [this.stage.view.toScreen(left, top), this.stage.view.toScreen(right, bottom)];
    return { left: a.x - EDGE, top: a.y - EDGE, right: b.x + EDGE, bottom: b.y + EDGE };
  }

  /** @returns {{x: number, y: number, grip: Grip}[]} */
  grips() {
    const { left, top, right, bottom } = this.frame;
    const corners = [[left, top], [right, top], [right, bottom], [left, bottom]].map(([x, y]) => ({ x, y, grip: /** @type {Grip} */ ({ kind: "scale" }) }));
    const shown = this.preview ?? this.rings;
    const points = this.telling.flatMap((indices, ring) => indices.map((index, which) => {
      const [x, y] = shown[ring][index];
      return { ...this.stage.view.toScreen(x, y), grip: /** @type {Grip} */ ({ kind: "point", ring, which }) };
    }));
    return [...points, { x: (left + right) / 2, y: top - AWAY + EDGE, grip: { kind: "turn" } }, ...corners];
  }

  /** @param {Point} at @param {number} reach px */
  gripAt(at, reach) {
    return this.grips().find(({ x, y }) => Math.hypot(x - at.x, y - at.y) <= reach)?.grip ?? null;
  }

  /** @param {Point} at @param {number} reach px */
  down(at, reach) {
    this.grip = this.gripAt(at, reach) ?? { kind: "move" };
  }

  /**
   * @param {Point} from
   * @param {Point} to
   * @param {boolean} snaps
   */
  move(from, to, snaps) {
    const { zoom } = this.stage.view;
    const [x, y] = [(to.x - from.x) / zoom, (to.y - from.y) / zoom];
    const grip = this.grip;
    if (grip?.kind === "point") return this.pull(grip.ring, grip.which, x, y);
    if (grip?.kind === "move") return this.place({ x, y });
    const { left, top, right, bottom } = this.frameAtRest;
    const [cx, cy] = [(left + right) / 2, (top + bottom) / 2];
    if (grip?.kind === "scale") return this.place({ factor: Math.min(Math.max(Math.hypot(to.x - cx, to.y - cy) / Math.hypot(from.x - cx, from.y - cy), 0.1), 10) });
    let angle = ((Math.atan2(to.y - cy, to.x - cx) - Math.atan2(from.y - cy, from.x - cx)) * 180) / Math.PI;
    if (snaps) angle = SNAP * Math.round(angle / SNAP);
    this.place({ angle });
  }

  get frameAtRest() {
    const [left, top, right, bottom] = boundsOf(this.rings);
    const [a, b] = [this.stage.view.toScreen(left, top), this.stage.view.toScreen(right, bottom)];
    return { left: a.x, top: a.y, right: b.x, bottom: b.y };
  }

  /**
   * Have it elsewhere, larger, turned about its middle by degrees.
   * @param {{x?: number, y?: number, factor?: number, angle?: number}} how
   */
  place(how) {
    const { x = 0, y = 0, factor = 1, angle = 0 } = how;
    const [left, top, right, bottom] = boundsOf(this.rings);
    const [cx, cy] = [(left + right) / 2, (top + bottom) / 2];
    const [cos, sin] = [factor * Math.cos((angle * Math.PI) / 180), factor * Math.sin((angle * Math.PI) / 180)];
    this.preview = this.rings.map((ring) => ring.map(([px, py]) => [cx + cos * (px - cx) - sin * (py - cy) + x, cy + sin * (px - cx) + cos * (py - cy) + y]));
    this.command = { kind: "place_container", x, y, factor, angle };
  }

  /**
   * @param {number} ring
   * @param {number} which
   * @param {number} x
   * @param {number} y
   */
  pull(ring, which, x, y) {
    const made = this.rings.map((one, k) => (k === ring ? pulled(one, this.telling[k], which, x, y) : one));
    this.preview = made;
    this.command = { kind: "reshape", rings: made };
  }

  /** Let go: the others hear of it. */
  drop() {
    this.grip = null;
    if (this.command) this.connection.do(this.command);
    this.command = null;
  }

  /** Put it back. */
  cancel() {
    this.command = null;
    this.preview = null;
    this.grip = null;
  }

  /** Choose the next point for the keys. @param {number} step */
  next(step) {
    const count = this.telling.flat().length;
    this.at = ((this.at + 1 + step + count + 1) % (count + 1)) - 1;
    return this.at < 0 ? "the whole container" : `point ${this.at + 1} of ${count}`;
  }

  /**
   * Move the point of the keys, or all of it.
   * @param {number} x
   * @param {number} y
   */
  nudge(x, y) {
    const all = this.telling.flatMap((indices, ring) => indices.map((_, which) => ({ ring, which })));
    const point = all[this.at];
    if (point) this.pull(point.ring, point.which, x, y);
    else this.place({ x, y });
    this.drop();
  }

  /** @param {{factor?: number, angle?: number}} how */
  change(how) {
    this.place(how);
    this.drop();
  }

  /** @param {Pen} pen */
  draw(pen) {
    if (!this.isOn || !this.rings.length) return;
    const { accent, handle } = this.stage.colours;
    const { left, top, right, bottom } = this.frame;
    this.stage.toWindow();
    pen.strokeStyle = accent;
    pen.lineWidth = 1;
    pen.setLineDash([4, 3]);
    pen.strokeRect(left, top, right - left, bottom - top);
    pen.setLineDash([]);
    pen.lineWidth = 1.75;
    const grips = this.grips();
    grips.forEach(({ x, y, grip }, k) => {
      pen.beginPath();
      if (grip.kind === "scale") pen.rect(x - HALF, y - HALF, 2 * HALF, 2 * HALF);
      else pen.arc(x, y, HALF, 0, 2 * Math.PI);
      pen.fillStyle = k === this.at ? accent : handle;
      pen.fill();
      pen.stroke();
    });
  }
}
