// @ts-check
/** The canvas in a notebook: what Python shows comes by traits, what the hand does goes as messages. */

import { Choice } from "./choice.js";
import { Collage } from "./collage.js";
import { frameOf } from "./connection.js";
import { h } from "./dom.js";
import { Hand } from "./hand.js";
import { Sprites } from "./sprites.js";
import { Stage } from "./stage.js";
import { View } from "./view.js";

/** @typedef {{get: (name: string) => any, on: (event: string, heard: () => void) => void, off: (event: string, heard: () => void) => void, send: (message: object) => void}} Model */

/** Height of the canvas at most, px. */
const HIGHEST = 600;
/** Commands on their way at most: more would lag behind the hand. */
const AHEAD = 2;

class Notebook {
  /** @param {Model} model @param {HTMLElement} element */
  constructor(model, element) {
    this.model = model;
    this.canvas = /** @type {HTMLCanvasElement} */ (h("canvas", { tabindex: "0", "aria-label": "Layout: arrow keys go through items, with Alt they move one" }));
    this.badge = h("output", {});
    /** @type {[string, () => void][]} */
    const actions = [["Undo", () => this.send("undo")], ["Redo", () => this.send("redo")], ["Hold", () => this.hold()], ["Settle", () => this.send("settle")]];
    const buttons = actions.map(([name, act]) => h("button", { type: "button", onclick: act }, name));
    element.classList.add("packwork");
    // The picture that the notebook is saved with is hidden while the hand is there.
    const hiding = h("style", {}, `.${model.get("still")} { display: none !important }`);
    element.append(hiding, this.canvas, h("div", {}, ...buttons, this.badge));
    this.collage = new Collage();
    this.view = new View(() => this.redraw());
    this.sprites = new Sprites(() => this.redraw());
    this.choice = new Choice(() => this.redraw());
    this.stage = new Stage(this.canvas, this.collage, this.view, this.sprites, this.choice);
    this.hand = new Hand(this.collage, /** @type {any} */ (this));
    this.count = 0;
    this.done = 0;
    this.timer = 0;
    this.at = 0;
    /** @type {{type: string, n: number, command: object} | null} */
    this.waiting = null;
    /** Where the hand has taken hold, canvas units. @type {{x: number, y: number} | null} */
    this.from = null;
    this.observer = new ResizeObserver(() => this.resized());
    this.observer.observe(this.canvas);
    /** @type {[string, () => void][]} */
    this.heard = [["change:scene", () => this.scene()], ["change:frame", () => this.frame()], ["change:state", () => this.stated()]];
    for (const [event, heard] of this.heard) model.on(event, heard);
    this.listen();
    this.scene();
    this.stated();
  }

  listen() {
    const { canvas } = this;
    canvas.addEventListener("pointerdown", (event) => this.taken(event));
    canvas.addEventListener("pointermove", (event) => this.moved(event));
    canvas.addEventListener("pointerup", () => this.dropped());
    canvas.addEventListener("pointercancel", () => this.hand.cancel());
    canvas.addEventListener("keydown", (event) => this.typed(event));
  }

  /** @param {PointerEvent} event */
  taken(event) {
    const id = this.stage.take(event.offsetX, event.offsetY);
    this.choice.set(id === null ? [] : [id]);
    if (id === null) return;
    this.canvas.setPointerCapture(event.pointerId);
    this.from = this.view.toCanvas(event.offsetX, event.offsetY);
    this.hand.grab([id]);
  }

  /** @param {PointerEvent} event */
  moved(event) {
    if (!this.from) return;
    const at = this.view.toCanvas(event.offsetX, event.offsetY);
    this.hand.move(at.x - this.from.x, at.y - this.from.y);
    this.redraw();
  }

  dropped() {
    this.from = null;
    this.hand.drop();
  }

  /** @param {KeyboardEvent} event */
  typed(event) {
    const step = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowDown: [0, 1], ArrowUp: [0, -1] }[event.key];
    if (!step || !this.collage.items.length) return;
    event.preventDefault();
    event.stopPropagation();
    const { items } = this.collage;
    const [id] = this.choice.ids;
    if (event.altKey && id !== undefined) {
      const by = this.view.whole.width / 50;
      this.hand.grab([id]);
      this.hand.move(by * step[0], by * step[1]);
      return this.dropped();
    }
    const k = items.findIndex((item) => item.id === id);
    const next = items[(k + step[0] + step[1] + items.length) % items.length];
    this.choice.set([next.id]);
    this.badge.textContent = next.name;
  }

  /** Hold what is chosen, or let go of it. */
  hold() {
    const items = [...this.choice.ids];
    const isHeld = items.every((id) => this.collage.item(id)?.held.every(Boolean));
    if (items.length) this.do({ kind: isHeld ? "release" : "hold", items });
  }

  /** @param {string} type */
  send(type) {
    this.model.send({ type, n: ++this.count });
  }

  /**
   * Have a command done; its number. While others are on their way the newest place of the hand waits.
   * @param {{kind: string, items?: number[]}} command
   */
  do(command) {
    const message = { type: "do", n: ++this.count, command };
    const isWay = command.kind === "move" || command.kind === "together";
    if (isWay && this.count - this.done > AHEAD) this.waiting = message;
    else {
      this.flush();
      this.model.send(message);
    }
    return message.n;
  }

  flush() {
    if (this.waiting) this.model.send(this.waiting);
    this.waiting = null;
  }

  scene() {
    const scene = JSON.parse(this.model.get("scene"));
    /** @type {import("./wire.js").Shape[]} */
    const shapes = JSON.parse(this.model.get("shapes"));
    this.collage.addShapes(shapes.filter((shape) => !this.collage.looks.has(shape.key)));
    this.collage.setScene(scene);
    this.choice.keep(this.collage.rows);
    this.view.whole = this.collage.tiling.whole;
    this.canvas.style.aspectRatio = `${scene.width} / ${scene.height}`;
    this.canvas.style.maxHeight = `${HIGHEST}px`;
    this.frame();
    this.view.refit();
  }

  frame() {
    const bytes = this.model.get("frame");
    const frame = frameOf(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
    this.done = frame.done;
    this.collage.setFrame(frame);
    if (this.waiting && this.count - this.done <= AHEAD) this.flush();
    this.redraw();
  }

  stated() {
    const state = JSON.parse(this.model.get("state"));
    this.canvas.dataset.is = state.is;
    this.badge.textContent = `${Math.round(1000 * state.covered) / 10} % covered · ${state.told}`;
  }

  resized() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    Object.assign(this.view.size, { width, height, left: 8, right: 8, top: 8, bottom: 8 });
    this.stage.resize();
    this.stage.recolour();
    this.view.refit();
  }

  redraw() {
    this.timer ||= requestAnimationFrame((now) => this.draw(now));
  }

  /** @param {number} now */
  draw(now) {
    this.timer = 0;
    const moves = this.collage.hasPoses && this.collage.ease(Math.min(now - this.at, 50), false);
    this.at = now;
    const lacks = this.sprites.begin();
    const isMoving = moves || this.hand.isFull;
    const isLast = this.stage.draw(isMoving);
    this.canvas.dataset.drawn = String(Number(this.canvas.dataset.drawn ?? 0) + 1);
    if (moves || lacks || this.sprites.left < 0 || !(isLast || isMoving)) this.redraw();
  }

  /** Let go of all, as the cell's output goes. */
  end() {
    this.observer.disconnect();
    cancelAnimationFrame(this.timer);
    for (const [event, heard] of this.heard) this.model.off(event, heard);
  }
}

/** @param {{model: Model, el: HTMLElement}} given */
export function render({ model, el }) {
  const notebook = new Notebook(model, el);
  return () => notebook.end();
}
