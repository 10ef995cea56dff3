// @ts-check
/** Drawing the container, or a hole in it, freehand. */

import { pathOf, smoothed } from "./rings.js";
import { say, tell } from "./toasts.js";

/** @typedef {{x: number, y: number}} Point */
/** Length of the shortest line that is taken for one, as a share of the canvas. */
const SHORTEST = 0.1;

export class Sketch {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.isDrawing = false;
    this.isHole = false;
    /** The line in the hand, canvas units. @type {[number, number][]} */
    this.line = [];
  }

  get asks() {
    return this.isHole ? "Draw round the hole" : "Draw the outline";
  }

  /** Have the next drag draw an outline. @param {boolean} isHole */
  begin(isHole) {
    this.studio.gestures.draw();
    [this.isDrawing, this.isHole] = [true, isHole];
    this.studio.redraw();
    say(`${this.asks}; Escape leaves off`);
  }

  /** @param {Point} at in the window */
  draw(at) {
    const { x, y } = this.studio.view.toCanvas(at.x, at.y);
    this.line.push([x, y]);
  }

  /** Let go of the line: closed and smoothed, it is the outline. */
  drop() {
    if (!this.line.length) return;
    const { connection, view } = this.studio;
    const line = smoothed(this.line, SHORTEST * Math.max(view.whole.width, view.whole.height));
    this.line = [];
    if (!line) return tell("draw a longer line, round what is to be inside");
    this.isDrawing = false;
    if (this.isHole) connection.do({ kind: "draw_container", line, is_hole: true });
    else connection.send({ type: "outline", line });
  }

  /** Draw it anew. */
  clear() {
    this.line = [];
  }

  cancel() {
    const was = this.isDrawing;
    this.isDrawing = false;
    this.clear();
    return was;
  }

  /** @param {import("./room.js").Pen} pen */
  paint(pen) {
    if (!this.isDrawing) return;
    const { stage, view } = this.studio;
    stage.toCanvas();
    const path = new Path2D(this.line.length ? pathOf([this.line]) : "");
    pen.fillStyle = stage.colours.marquee;
    pen.fill(path, "nonzero");
    pen.lineJoin = "round";
    for (const [colour, wide] of /** @type {[string, number][]} */ ([[stage.colours.handle, 6], [stage.colours.accent, 3]])) {
      pen.strokeStyle = colour;
      pen.lineWidth = wide / view.zoom;
      pen.stroke(path);
    }
  }
}
