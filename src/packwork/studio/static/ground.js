// @ts-check
/** What is behind all: a colour, a gradient or a picture. */

import { h, picker } from "./dom.js";

/** Backgrounds a press away. */
const GROUNDS = /** @type {const} */ ([["none", "Transparent"], ["white", "White"], ["#faf7f0", "Paper"], ["#171717", "Black"]]);
/** Ways of gradients, as CSS begins them. */
const WAYS = /** @type {const} */ ([["linear-gradient(180deg, ", "down"], ["linear-gradient(90deg, ", "across"], ["linear-gradient(135deg, ", "slanting"], ["radial-gradient(", "outwards"]]);
/** Colours that a gradient begins with. */
const FIRST = ["#fdf6e3", "#8ecae6"];
/** Which items have halos. */
const HALOS = /** @type {const} */ ([["none", "none"], ["faint", "those hardly to be seen"], ["all", "all"]]);

export class Ground {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.colour = picker("Colour behind all", (colour) => this.set(colour));
    this.way = h("select", { class: "way", "aria-label": "Way of the gradient", onchange: () => this.shade() }, ...WAYS.map(([value, label]) => h("option", { value }, label)));
    this.ends = FIRST.map((value, k) => h("input", { type: "color", value, "aria-label": `Colour ${k + 1} of the gradient`, onchange: () => this.shade() }));
    this.halos = h("select", { onchange: () => studio.connection.do({ kind: "halos", choice: this.halos.value }) }, ...HALOS.map(([value, label]) => h("option", { value }, label)));
    const picture = h("button", { type: "button", onclick: () => studio.dropping.choosePicture("behind") }, "Picture …");
    this.elements = [
      h("div", { class: "row wrap" }, h("span", {}, "Background"), ...grounds((colour) => this.set(colour)), this.colour.element),
      h("div", { class: "row wrap", role: "group", "aria-label": "A gradient or a picture behind all" }, h("button", { type: "button", onclick: () => this.shade() }, "Gradient"), ...this.ends, this.way, picture),
      h("label", { class: "row" }, "Halos", this.halos)];
  }

  /** Show what is there. */
  refresh() {
    const { ground = "", halos } = this.studio.collage.scene ?? {};
    this.halos.value = halos || "none";
    this.colour.show(ground || "#ffffff", !ground);
  }

  /** @param {string} colour as CSS writes it */
  set(colour) {
    this.studio.connection.do({ kind: "background", colour });
  }

  /** Have the gradient of the fields. */
  shade() {
    this.set(`${this.way.value}${this.ends.map((one) => one.value).join(", ")})`);
  }
}

/**
 * Buttons of a few backgrounds.
 * @param {(colour: string) => void} take
 */
export function grounds(take) {
  return GROUNDS.map(([colour, name]) => h("button", { type: "button", class: "ground", "data-ground": colour, title: name, "aria-label": name, onclick: () => take(colour) }));
}
