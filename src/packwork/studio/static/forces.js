// @ts-check
/** Forces as arrows on the canvas and as lines of a list. */

import { button, h } from "./dom.js";

/** @typedef {{x: number, y: number}} Point */

/** Ready-made ones, as the command line has them. */
const READY = ["down", "up", "left", "right", "towards centre", "away centre", "together"];
/** Length of an arrow of strength 1, as a share of the canvas' longer side; weakest and strongest drawn. */
const UNIT = 0.25;
const BOUNDS = [0.2, 8];
const TURNS = /** @type {Record<string, number>} */ ({ right: 0, down: 90, left: 180, up: 270 });
/** Length of an arrow's head, px. */
const HEAD = 12;

export class Forces {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.isDrawing = false;
    this.asks = "Draw an arrow";
    /** The arrow in the hand. @type {[Point, Point] | null} */
    this.arrow = null;
    /** Where arrows were drawn, by what they say. @type {Map<string, Point>} */
    this.places = new Map();
    this.element = h("div", { class: "question" });
  }

  /** @returns {string[]} */
  get texts() {
    return this.studio.collage.scene?.options.force ?? [];
  }

  /** @param {string[]} texts */
  set(texts) {
    this.studio.connection.send({ type: "set", options: { force: texts } });
  }

  /** Bring the list up to what there is. */
  refresh() {
    if (!this.element.isConnected) return;
    const texts = this.texts;
    const rows = texts.map((text, k) => h("li", {}, h("span", { class: "name" }, text), button("close", `Without ${text}`, () => this.set(texts.filter((_, one) => one !== k)))));
    const ready = h("select", { "aria-label": "Add a force", onchange: () => ready.value && this.set([...texts, ready.value]) },
      h("option", { value: "" }, "Add …"), ...READY.filter((one) => !texts.includes(one)).map((one) => h("option", { value: one }, one)));
    const key = JSON.stringify(texts);
    if (this.element.dataset.shows === key) return;
    this.element.dataset.shows = key;
    this.element.replaceChildren(h("strong", {}, "Forces"), h("ul", { class: "items" }, ...rows),
      h("div", { class: "row" }, ready, h("button", { type: "button", onclick: () => this.begin() }, "Draw an arrow")),
      h("p", { class: "hint" }, "Items fall the way of an arrow, at their sizes, as far as there is room; a longer one counts for more; those chosen alone, if any are."));
  }

  /** Have the next drag draw one. */
  begin() {
    this.studio.gestures.draw();
    this.isDrawing = true;
    this.studio.redraw();
  }

  /** @param {Point} to @param {Point} from in the window */
  draw(to, from) {
    const { view } = this.studio;
    this.arrow = [view.toCanvas(from.x, from.y), view.toCanvas(to.x, to.y)];
  }

  /** Let go of the arrow: it becomes a force. */
  drop() {
    const arrow = this.arrow;
    this.arrow = null;
    if (!arrow) return;
    this.isDrawing = false;
    const { collage, choice, view } = this.studio;
    const [from, to] = arrow;
    const [x, y] = [to.x - from.x, to.y - from.y];
    const side = Math.max(view.whole.width, view.whole.height);
    const strength = Math.min(Math.max(Math.hypot(x, y) / side / UNIT, BOUNDS[0]), BOUNDS[1]);
    const degrees = Math.round((Math.atan2(y, x) * 180) / Math.PI + 360) % 360;
    const names = [...new Set([...choice.ids].map((id) => collage.item(id)?.name ?? ""))].filter((name) => /^[^\s,]+$/.test(name));
    const text = `${degrees}deg strength=${Number(strength.toPrecision(2))}${names.length ? ` items=${names.join(",")}` : ""}`;
    this.places.set(text, from);
    this.set([...this.texts, text]);
  }

  /** Draw it anew. */
  clear() {
    this.arrow = null;
  }

  cancel() {
    const was = this.isDrawing;
    this.isDrawing = false;
    this.clear();
    return was;
  }

  /**
   * Arrows of all forces that lead the same way everywhere, in the window.
   * @returns {[Point, Point][]}
   */
  arrows() {
    const { view } = this.studio;
    const { width, height } = view.whole;
    const side = Math.max(width, height);
    return this.texts.flatMap((text) => {
      const [word] = text.split(" ");
      const degrees = TURNS[word] ?? Number(/^(-?[\d.]+)deg$/.exec(word)?.[1] ?? NaN);
      if (Number.isNaN(degrees)) return [];
      const far = side * UNIT * Number(/strength=([\d.]+)/.exec(text)?.[1] ?? 1);
      const turn = (degrees * Math.PI) / 180;
      const from = this.places.get(text) ?? { x: width / 2 - (far / 2) * Math.cos(turn), y: height / 2 - (far / 2) * Math.sin(turn) };
      const to = { x: from.x + far * Math.cos(turn), y: from.y + far * Math.sin(turn) };
      return [/** @type {[Point, Point]} */ ([view.toScreen(from.x, from.y), view.toScreen(to.x, to.y)])];
    });
  }

  /** @param {import("./room.js").Pen} pen */
  paint(pen) {
    const { view, stage } = this.studio;
    const own = this.arrow ? [/** @type {[Point, Point]} */ (this.arrow.map(({ x, y }) => view.toScreen(x, y)))] : [];
    stage.toWindow();
    pen.lineCap = pen.lineJoin = "round";
    for (const arrow of [...this.arrows(), ...own]) {
      for (const [colour, wide] of /** @type {[string, number][]} */ ([[stage.colours.handle, 7], [stage.colours.accent, 3.5]])) {
        pen.strokeStyle = colour;
        pen.lineWidth = wide;
        pen.stroke(arrowPath(arrow));
      }
    }
  }
}

/** @param {[Point, Point]} arrow */
function arrowPath([from, to]) {
  const turn = Math.atan2(to.y - from.y, to.x - from.x);
  const path = new Path2D();
  path.moveTo(from.x, from.y);
  path.lineTo(to.x, to.y);
  for (const side of [2.6, -2.6]) {
    path.moveTo(to.x, to.y);
    path.lineTo(to.x + HEAD * Math.cos(turn + side), to.y + HEAD * Math.sin(turn + side));
  }
  return path;
}
