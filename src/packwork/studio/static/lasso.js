// @ts-check
/** Choosing items by a line that is drawn round them. */

import { pathOf } from "./rings.js";
import { say } from "./toasts.js";

/** @typedef {{x: number, y: number}} Point */

export class Lasso {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.isDrawing = false;
    this.asks = "Draw round the items";
    /** The line in the hand, canvas units. @type {[number, number][]} */
    this.line = [];
    /** What is chosen beside what the line holds. @type {number[]} */
    this.base = [];
    /** What was chosen before. @type {number[]} */
    this.before = [];
  }

  /** Have the next drag draw the line. @param {boolean} [adds] to what is chosen */
  begin(adds = false) {
    this.studio.gestures.draw();
    this.isDrawing = true;
    this.before = [...this.studio.choice.ids];
    this.base = adds ? this.before : [];
    this.studio.redraw();
    say(`${this.asks}; Escape leaves off`);
  }

  /** Go on with the line: what it holds, closed, is chosen. @param {Point} at in the window @param {Point} from where it began */
  draw(at, from) {
    const { choice, collage, stage, view } = this.studio;
    for (const point of this.line.length ? [at] : [from, at]) {
      const { x, y } = view.toCanvas(point.x, point.y);
      this.line.push([x, y]);
    }
    stage.pen.resetTransform();
    const path = new Path2D(pathOf([this.line]));
    const held = collage.items.filter((_, k) => collage.tiling.places(k).some(([x, y]) => stage.pen.isPointInPath(path, x, y, "nonzero")));
    choice.isBusy = true;
    choice.set([...this.base, ...held.map((item) => item.id)]);
  }

  /** Let go of the line. */
  drop() {
    [this.isDrawing, this.line] = [false, []];
  }

  /** Draw it anew: what was chosen before is chosen again. */
  clear() {
    if (this.line.length) this.studio.choice.set(this.before);
    this.line = [];
  }

  cancel() {
    const was = this.isDrawing;
    this.clear();
    this.drop();
    return was;
  }

  /** @param {import("./room.js").Pen} pen */
  paint(pen) {
    if (!this.line.length) return;
    const { stage, view } = this.studio;
    stage.toCanvas();
    const path = new Path2D(pathOf([this.line]));
    pen.fillStyle = stage.colours.marquee;
    pen.fill(path, "nonzero");
    pen.strokeStyle = stage.colours.accent;
    pen.lineWidth = 1.5 / view.zoom;
    pen.setLineDash([6 / view.zoom, 4 / view.zoom]);
    pen.stroke(path);
    pen.setLineDash([]);
  }
}
