// @ts-check
/** The field of a font: the bundled one, an installed family, or a file. */

import { h, openList } from "./dom.js";

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
    this.file = option(OWN, "A font file …");
    this.lacking = h("optgroup", { label: "Without some of their letters" });
    this.field = h("select", { "aria-label": label, onchange: () => this.changed(), onkeydown: openList }, option(BUNDLED, "Inter Display, bundled"), this.file);
    /** Stands for a font that words have by a file, which the studio takes from them. */
    this.other = h("option", {});
    /** Options of families, each in its face. @type {HTMLOptionElement[]} */
    this.families = [];
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

  /** Offer what is installed, families that have all letters of a text first. @param {string} [text] */
  async fill(text = "") {
    /** @type {Record<string, string[]>} */
    const fonts = (await this.studio.panels.load())?.fonts ?? {};
    const isFirst = !this.families.length;
    if (isFirst) this.families = Object.keys(fonts).filter((one) => one !== BUNDLED).map((one) => option(one, named(one), fonts[one]));
    const asked = new Set(Object.values(fonts).flat().filter((script) => new RegExp(`\\p{Script=${script}}`, "u").test(text)));
    const { value } = this.field;
    for (const one of this.families) {
      if ([...asked].every((script) => fonts[one.value].includes(script))) this.file.before(one);
      else this.lacking.append(one);
    }
    if (this.lacking.childElementCount) this.file.before(this.lacking);
    else this.lacking.remove();
    this.field.value = value;
    if (isFirst && value === this.other.value) this.refused();
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

/** @param {string} value @param {string} label @param {string[]} [scripts] of the family that it stands for */
function option(value, label, scripts = []) {
  const made = h("option", { value }, label);
  // A name in signs that are no letters tells nobody anything.
  if (scripts.includes("Latin")) made.style.fontFamily = `"${value}"`;
  return made;
}

/** A family, told in lower case, as people write it. @param {string} family */
function named(family) {
  return family.replace(/(^|\s)\S/g, (letter) => letter.toUpperCase());
}
