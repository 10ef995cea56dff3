// @ts-check
/** The panel of colours: palettes as strips, colours of one's own, and what is behind all. */

import { button, h } from "./dom.js";
import { Ground } from "./ground.js";
import { Mosaic } from "./mosaic.js";

const SHADES = /** @type {const} */ ([["tint", "tints and shades of one"], ["nearest", "the nearest of these, each"], ["keep", "their own"]]);
/** A colour that is added, to be changed. */
const NEW = "#8a8f98";
export class Look {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.ground = new Ground(studio);
    this.mosaic = new Mosaic(studio);
    this.shades = h("select", { onchange: () => this.colours.length && this.paint(this.colours) }, ...SHADES.map(([value, label]) => h("option", { value }, label)));
    this.strips = h("div", { class: "strips", role: "group", "aria-label": "Palettes" });
    this.own = h("div", { class: "swatches", role: "group", "aria-label": "Colours of the palette" });
    this.shown = "";
    /** Treatment of drawings of several colours that the field shows. */
    this.seen = "";
  }

  /** Colours that are put on all items. */
  get colours() {
    return this.studio.collage.scene?.palette ?? [];
  }

  /** @param {HTMLElement} body */
  async fill(body) {
    body.replaceChildren(
      ...this.ground.elements, this.mosaic.element,
      h("h3", {}, "Palettes"), this.strips, this.own,
      h("label", { class: "stack" }, "Drawings of several colours get", this.shades),
      h("p", { class: "hint" }, "Neighbours get unlike colours; photographs keep theirs."));
    this.refresh();
    const palettes = Object.entries((await this.studio.panels.load())?.palettes ?? {});
    this.strips.replaceChildren(this.strip("their own", []), ...palettes.map(([name, colours]) => this.strip(name, colours)));
    this.refresh();
  }

  /** @param {string} name @param {string[]} colours */
  strip(name, colours) {
    return h("button", { type: "button", class: "strip", "data-colours": colours.join(" "), "aria-label": name, onclick: () => this.paint(colours) },
      h("span", { class: "bands" }, ...colours.map((colour) => band(colour))), h("span", {}, name));
  }

  /** Show what is put on now. */
  refresh() {
    this.ground.refresh();
    this.mosaic.refresh();
    const { shades = "" } = this.studio.collage.scene ?? {};
    if (shades !== this.seen) this.shades.value = shades || "tint";
    this.seen = shades;
    const now = this.colours.join(" ");
    for (const one of this.strips.querySelectorAll(".strip")) one.setAttribute("aria-pressed", String(!this.mosaic.isOn && /** @type {HTMLElement} */ (one).dataset.colours === now));
    if (this.shown === now && this.own.childElementCount) return;
    this.shown = now;
    this.own.hidden = !now;
    this.own.replaceChildren(...this.colours.map((colour, k) => this.swatch(colour, k)),
      button("minus", "One colour less", () => this.paint(this.colours.slice(0, -1)), { disabled: this.colours.length < 2 }),
      button("plus", "One colour more", () => this.paint([...this.colours, NEW])));
  }

  /** @param {string} colour @param {number} k */
  swatch(colour, k) {
    const field = h("input", { type: "color", value: colour.slice(0, 7), "aria-label": `Colour ${k + 1} of the palette`,
      onchange: () => this.paint(this.colours.map((one, at) => (at === k ? field.value : one))) });
    return field;
  }

  /** @param {string[]} colours none for those that each was drawn in */
  paint(colours) {
    this.studio.connection.do({ kind: "paint", palette: colours, shades: this.shades.value });
  }
}

/** @param {string} colour */
function band(colour) {
  const made = h("span");
  made.style.background = colour;
  return made;
}
