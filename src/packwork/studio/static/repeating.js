// @ts-check
/** Which way the canvas repeats, and a look at several tiles side by side: in the panel of containers. */

import { h } from "./dom.js";

/** @typedef {"square" | "half-drop" | "hexagon"} Way */

const WAYS = /** @type {const} */ ([["", "no, it has an edge"], ["square", "in rows and columns"], ["half-drop", "every other column half lower"], ["hexagon", "as a honeycomb"]]);
/** By how much the sides of a honeycomb's canvas may be off: pixels are whole. */
const OFF = 0.01;

export class Repeating {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.way = h("select", { onchange: () => this.ask(/** @type {Way | ""} */ (this.way.value)) }, ...WAYS.map(([value, label]) => h("option", { value }, label)));
    this.preview = h("input", { type: "checkbox", onchange: () => this.show(this.preview.checked) });
    this.shown = h("label", { class: "row" }, this.preview, "Show three by three tiles");
    this.elements = [h("label", { class: "row" }, "Repeats", this.way), this.shown];
    /** Canvas before it was made a honeycomb's, which is as wide. @type {{size: string, width: number, unit: string} | null} */
    this.before = null;
  }

  /** @returns {Way | null} */
  get now() {
    const { scene } = this.studio.collage;
    if (!scene?.repeat) return null;
    if (!scene.repeat[2]) return "square";
    return Math.abs(scene.width / scene.height / Math.sqrt(3) - 1) < OFF ? "hexagon" : "half-drop";
  }

  /** Have the canvas repeat so, or have an edge. @param {Way | ""} way */
  ask(way) {
    const { scene } = this.studio.collage;
    if (!scene) return;
    const { before } = this;
    const { width, height, unit } = scene;
    const isOurs = before && this.now === "hexagon" && before.width === width && before.unit === unit;
    const canvas = isOurs ? before.size : `${width}x${height}${unit}`;
    this.before = { size: canvas, width, unit };
    this.studio.connection.send({ type: "room", source: "page", canvas, tile: way || null });
  }

  /** Forget the canvas that was: this is another one. */
  opened() {
    this.before = null;
  }

  /** @param {boolean} isPreview */
  show(isPreview) {
    const { tiling } = this.studio.collage;
    tiling.isPreview = isPreview;
    tiling.bringHome();
    this.studio.seen();
    this.refresh();
  }

  refresh() {
    const { now } = this;
    this.way.value = now ?? "";
    this.shown.hidden = !now;
    this.preview.checked = this.studio.collage.tiling.isPreview;
  }
}
