// @ts-check
/** The field of a font: the bundled one, an installed family, or a file. */

import { h } from "./dom.js";

const [BUNDLED, OWN] = ["inter display", "own"];

export class FontField {
  /**
   * @param {import("./studio.js").Studio} studio
   * @param {string} label
   * @param {(name: string) => void} [changed] told of the font that was chosen
   */
  constructor(studio, label, changed = () => {}) {
    this.studio = studio;
    this.told = changed;
    /** What the studio is told; null until one is chosen. @type {string | null} */
    this.value = null;
    this.field = h("select", { "aria-label": label, onchange: () => this.changed() }, option(BUNDLED, "Inter Display, bundled"), option(OWN, "A font file …"));
    this.element = h("label", { class: "row" }, label, this.field);
  }

  async fill() {
    const choices = await this.studio.panels.load();
    if (this.field.options.length > 2) return;
    const families = (choices?.fonts ?? []).filter((/** @type {string} */ one) => one !== BUNDLED);
    this.field.querySelector(`[value=${OWN}]`)?.before(...families.map((/** @type {string} */ one) => option(one, named(one))));
  }

  changed() {
    if (this.field.value !== OWN) {
      this.value = this.field.value;
      return this.told(this.field.selectedOptions[0].text);
    }
    this.field.value = this.value ?? BUNDLED;
    this.studio.dropping.ask(".ttf,.otf,.ttc,.otc", false, (batch) => this.own(batch, this.studio.dropping.field.files?.[0]?.name ?? "your font"));
  }

  /** @param {string} batch of the file @param {string} name */
  own(batch, name) {
    this.value = `file:${batch}`;
    this.field.prepend(option(this.value, name));
    this.field.value = this.value;
    this.told(name);
  }
}

/** @param {string} value @param {string} label */
function option(value, label) {
  return h("option", { value }, label);
}

/** A family, told in lower case, as people write it. @param {string} family */
function named(family) {
  return family.replace(/(^|\s)\S/g, (letter) => letter.toUpperCase());
}
