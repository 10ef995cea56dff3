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
    /** Batches of font files, by their names. @type {Map<string, string>} */
    this.known = new Map();
    /** Name of the font that words have now. */
    this.seen = "";
    this.field = h("select", { "aria-label": label, onchange: () => this.changed() }, option(BUNDLED, "Inter Display, bundled"), option(OWN, "A font file …"));
    /** Stands for a font that words have by a file, which the studio takes from them. */
    this.other = h("option", {});
    this.element = h("label", { class: "row" }, label, this.field);
  }

  /** Forget what was chosen in another document. */
  begin() {
    this.known.clear();
    [this.value, this.seen, this.field.value] = [null, "", BUNDLED];
  }

  /** Show the font that words are in: of one that was undone the one before. @param {string} name empty without words */
  show(name) {
    if (name === this.seen) return;
    this.seen = name;
    if (!name) return;
    const known = this.known.get(name) ?? name;
    this.other.remove();
    const isOffered = [...this.field.options].some((one) => one.value === known);
    // The bundled font by name has no other for letters that it lacks.
    this.value = known === BUNDLED && this.value !== BUNDLED ? null : known;
    this.other.value = this.other.textContent = name;
    if (!isOffered) this.field.prepend(this.other);
    this.field.value = known;
  }

  /** What was chosen last is not to be had. */
  refused() {
    const name = this.seen;
    this.seen = "";
    this.show(name);
  }

  async fill() {
    const choices = await this.studio.panels.load();
    const there = new Set([...this.field.options].map((one) => one.value));
    const families = (choices?.fonts ?? []).filter((/** @type {string} */ one) => !there.has(one));
    this.field.querySelector(`[value=${OWN}]`)?.before(...families.map((/** @type {string} */ one) => option(one, named(one))));
    if (families.length && this.field.value === this.other.value) this.refused();
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
    this.known.set(name, this.value);
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
