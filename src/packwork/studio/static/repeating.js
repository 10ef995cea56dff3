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
    /** Size of the canvas before it became a honeycomb's. */
    this.size = "";
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
    const size = `${scene.width}x${scene.height}${scene.unit}`;
    const canvas = this.now === "hexagon" ? this.size || size : size;
    this.size = canvas;
    this.studio.connection.send({ type: "room", source: "page", canvas, tile: way || null });
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
