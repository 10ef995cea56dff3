// @ts-check
/** What can be changed of the items of one row: name, weight, colour, drawing. */

import { h } from "./dom.js";
import { together } from "./hand.js";
import { kindOf } from "./kinds.js";

/** @typedef {import("./wire.js").Thing} Thing */

export class ItemEditor {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    /** @type {Thing[]} */
    this.items = [];
    this.name = h("input", { type: "text", maxlength: "200", onchange: () => this.rename() });
    this.weight = h("input", { type: "number", min: "0.01", step: "any", onchange: () => this.weigh() });
    this.weighs = h("label", {}, "Weight", this.weight);
    this.colour = h("input", { type: "color", value: "#1f6f78", onchange: () => studio.recolour(this.colour.value) });
    const replace = h("button", { type: "button", onclick: () => studio.replacing.open() }, "Replace …");
    this.element = h("div", { class: "editor", role: "group", "aria-label": "Change what is chosen" },
      h("label", {}, "Name", this.name), this.weighs, h("label", {}, "Colour", this.colour), replace);
  }

  get ids() {
    return this.items.map((item) => item.id);
  }

  /** @param {Thing[]} items at least one */
  show(items) {
    this.items = items;
    this.weighs.hidden = !kindOf(this.studio.collage).sizes;
    const [first] = items;
    const own = this.studio.collage.colour(first.id);
    const colour = own ?? this.colour.value;
    this.colour.classList.toggle("mixed", !own);
    for (const [field, value] of /** @type {const} */ ([[this.name, first.name], [this.weight, shown(first.weight)], [this.colour, colour]])) {
      if (document.activeElement !== field) field.value = value;
    }
  }

  rename() {
    const name = this.name.value.trim();
    if (name) this.studio.connection.do(together(this.ids.map((item) => ({ kind: "rename", item, name }))));
  }

  weigh() {
    const weight = Number(this.weight.value);
    if (weight > 0) this.studio.connection.do({ kind: "weigh", items: this.ids, weight });
  }
}

/** @param {number} weight */
function shown(weight) {
  return String(Number(weight.toPrecision(4)));
}
