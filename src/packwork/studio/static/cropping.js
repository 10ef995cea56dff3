// @ts-check
/** A photograph in the hand within its frame: dragged, zoomed, and kept as one command. */

import { say } from "./toasts.js";

/** @typedef {{x: number, y: number}} Point */

const CLOSEST = 20;
/** How much of the picture outside its frame is seen meanwhile. */
const FAINT = 0.3;

export class Cropping {
  /**
   * @param {import("./stage.js").Stage} stage
   * @param {import("./connection.js").Connection} connection
   */
  constructor(stage, connection) {
    this.stage = stage;
    this.connection = connection;
    /** @type {number | null} */
    this.id = null;
    this.now = { zoom: 1, x: 0, y: 0 };
    /** As it was taken in hand. */
    this.was = this.now;
  }

  get isOn() {
    return this.id !== null && this.stage.collage.rows.has(this.id);
  }

  /** Take a photograph in hand; whether it is one. @param {number | null} id */
  begin(id) {
    const crop = id === null ? null : this.stage.collage.item(id)?.crop;
    if (!crop) return false;
    this.id = id;
    const [zoom, x, y] = crop;
    this.was = this.now = { zoom, x, y };
    say("Dragging and arrow keys move the picture in its frame, wheel, two fingers, plus and minus zoom; Enter keeps it, Escape leaves it as it was");
    return true;
  }

  /** Let go. @param {boolean} isKept */
  end(isKept) {
    const { zoom, x, y } = this.was;
    const isOther = zoom !== this.now.zoom || x !== this.now.x || y !== this.now.y;
    if (this.isOn && isKept && isOther) this.connection.do({ kind: "crop", item: this.id, ...this.now });
    this.id = null;
  }

  /**
   * Move the picture, px of the window.
   * @param {number} x
   * @param {number} y
   */
  drag(x, y) {
    const { collage, view } = this.stage;
    const pose = collage.pose(this.id ?? -1);
    if (!pose) return;
    const [width, height] = this.look.size;
    const [cos, sin] = [Math.cos(pose.angle), Math.sin(pose.angle)];
    const far = view.zoom * pose.scale;
    this.move((cos * x + sin * y) / far / width, (cos * y - sin * x) / far / height);
  }

  /**
   * Move the picture by shares of its frame, as far as it fills it.
   * @param {number} x
   * @param {number} y
   */
  move(x, y) {
    const most = (this.now.zoom - 1) / 2;
    const bounded = (/** @type {number} */ at) => Math.min(Math.max(at, -most), most);
    this.now = { ...this.now, x: bounded(this.now.x + x), y: bounded(this.now.y + y) };
  }

  /** @param {number} factor */
  zoom(factor) {
    const zoom = Math.min(Math.max(this.now.zoom * factor, 1), CLOSEST);
    const by = zoom / this.now.zoom;
    this.now = { zoom, x: this.now.x * by, y: this.now.y * by };
    this.move(0, 0);
  }

  get look() {
    const { collage } = this.stage;
    return collage.look(/** @type {import("./wire.js").Thing} */ (collage.item(this.id ?? -1)));
  }

  /** @param {CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D} pen */
  draw(pen) {
    if (!this.isOn) return;
    const { stage, look, now } = this;
    const item = /** @type {import("./wire.js").Thing} */ (stage.collage.item(this.id ?? -1));
    const scale = stage.toItem(/** @type {number} */ (stage.collage.rows.get(item.id)), item);
    const whole = { ...look, key: `${look.key}/whole`, svg: look.whole || look.svg };
    const sprite = stage.sprites.of(whole, look.extent * scale * now.zoom * stage.view.zoom * stage.ratio);
    if (!sprite) return;
    const [left, top, right, bottom] = look.box;
    const [cx, cy] = [(left + right) / 2, (top + bottom) / 2];
    for (const alpha of [FAINT, 1]) {
      pen.save();
      pen.globalAlpha = alpha;
      if (alpha === 1) pen.clip(look.outlinePath, "evenodd");
      pen.translate(cx + now.x * look.size[0], cy + now.y * look.size[1]);
      pen.scale(now.zoom, now.zoom);
      pen.drawImage(sprite, left - cx, top - cy, right - left, bottom - top);
      pen.restore();
    }
    stage.outlineOf(item.id, stage.colours.accent, 2.5);
  }
}
