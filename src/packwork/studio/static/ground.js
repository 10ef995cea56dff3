// @ts-check
/** What is behind all: a colour, a gradient or a picture. */

import { h, picker } from "./dom.js";

/** Backgrounds a press away. */
const GROUNDS = /** @type {const} */ ([["none", "Transparent"], ["#ffffff", "White"], ["#faf7f0", "Paper"], ["#171717", "Black"]]);
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
    this.picture = h("button", { type: "button", onclick: () => studio.dropping.choosePicture("behind") }, "Picture …");
    this.gradient = h("button", { type: "button", onclick: () => this.shade() }, "Gradient");
    this.plain = grounds((colour) => this.set(colour));
    /** Gradient that the fields show. */
    this.shown = "";
    /** Number of the command that asked for it last. */
    this.sent = 0;
    this.elements = [
      h("div", { class: "row wrap" }, h("span", {}, "Background"), ...this.plain, this.colour.element),
      h("div", { class: "row wrap", role: "group", "aria-label": "A gradient or a picture behind all" }, this.gradient, ...this.ends, this.way, this.picture),
      h("label", { class: "row" }, "Halos", this.halos)];
  }

  /** Show what is there. */
  refresh() {
    const { ground = "", gradient = "", halos, under = [] } = this.studio.collage.scene ?? {};
    const isPicture = !gradient && under.some((one) => !one.faint);
    this.halos.value = halos || "none";
    this.colour.show(ground.slice(0, 7) || "#ffffff", !ground);
    const now = gradient || isPicture ? "" : ground || "none";
    for (const one of this.plain) one.setAttribute("aria-pressed", String(one.dataset.ground === now));
    this.gradient.setAttribute("aria-pressed", String(Boolean(gradient)));
    this.picture.setAttribute("aria-pressed", String(isPicture));
    // What the fields ask for is on its way: an answer to an earlier change takes none of it back.
    if (this.sent > this.studio.collage.done) return;
    if (gradient && gradient !== this.shown) this.follow(gradient);
    this.shown = gradient;
  }

  /** Have the fields say what a gradient is, of several colours the first and the last. @param {string} gradient */
  follow(gradient) {
    const way = WAYS.find(([start]) => gradient.startsWith(start));
    const colours = gradient.match(/#[0-9a-f]{6}/g) ?? [];
    if (way) this.way.value = way[0];
    [colours[0], colours[colours.length - 1]].forEach((colour, k) => colour && (this.ends[k].value = colour));
  }

  /** @param {string} colour as CSS writes it */
  set(colour) {
    this.sent = this.studio.connection.do({ kind: "background", colour });
    this.shown = colour;
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
