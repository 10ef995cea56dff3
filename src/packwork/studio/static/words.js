// @ts-check
/** The panel in which a text becomes words that fill the container, and words are changed. */

import { h } from "./dom.js";
import { FontField } from "./fonts.js";
import { Lines } from "./lines.js";
import { Mixing } from "./mixing.js";
import { tell } from "./toasts.js";
import { WordTable } from "./wordtable.js";

/** Subject of lines about the font of words. */
const FONT = "font";
const EXAMPLE = "Paste a text here, or a table: a word and its weight on each line, as\nhope, 12\njoy, 7";
const ROW = /^\s*(.*\S)\s*[,;\t]\s*([0-9]*\.?[0-9]+)\s*$/;

export class Words {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.text = h("textarea", { id: "text", rows: "10", placeholder: EXAMPLE, "aria-label": "Text or table of words", spellcheck: "false", dir: "auto" });
    /** Table that the field of text was filled with last. */
    this.filled = "";
    this.count = h("input", { type: "number", id: "words-count", min: "1", max: "1000", value: "80" });
    this.font = new FontField(studio, "Font", (name) => this.setIn(name));
    this.palette = h("select", {});
    this.mixing = new Mixing(studio);
    this.lines = new Lines(this);
    this.update = h("button", { type: "button", onclick: () => this.change() }, "Change these, keep their places");
    this.list = new WordTable(this);
    this.form = h("form", { class: "stack", onsubmit: (/** @type {Event} */ event) => this.submitted(event) },
      this.text, h("label", { class: "row" }, "Words at most", this.count),
      h("label", { class: "row" }, "Colours", this.palette), this.mixing.choice, h("button", { type: "submit", class: "primary" }, "Fill with words"), this.update);
  }

  /** @param {HTMLElement} body */
  async fill(body) {
    body.replaceChildren(h("p", { class: "hint" }, "Words are as large as they are often there. They take the place of what is on the sheet, which undo brings back, or come beside it with a share of their own."), this.mixing.element, this.font.element, this.lines.element, this.list.element,
      h("details", { open: true }, h("summary", {}, "A text or another table"), this.form));
    this.list.listed = "";
    if (!this.text.value.trim()) this.filled = this.text.value;
    this.refresh();
    const choices = await this.studio.panels.load();
    if (!this.palette.options.length) {
      this.palette.append(...Object.keys(choices?.palettes ?? {}).map((name) => h("option", { value: name, selected: name === "ink" }, name)));
    }
    await this.font.fill(this.letters());
  }

  /** Begin anew with another document. */
  opened() {
    this.list.without.clear();
    this.font.begin();
    this.fillText("");
  }

  /** Have a table in the field of text, unless something was typed there. @param {string} table */
  fillText(table) {
    if (this.text.value === this.filled) this.text.value = table;
    this.filled = table;
  }

  refresh() {
    this.list.refresh();
    this.font.show(this.studio.collage.scene?.font ?? "");
    this.fillText(this.table());
    this.mixing.refresh();
    this.lines.refresh();
    this.update.hidden = !this.studio.collage.items.some((item) => item.is_word);
  }

  letters() {
    return this.list.things.map(({ name }) => name).join("");
  }

  /** Words that are there, heaviest first, as a table. */
  table() {
    const { things } = this.list;
    return things.map(({ name }) => `${name}, ${this.list.countOf(name, things)}`).join("\n");
  }

  /** Words and weights, if each line has both. @returns {[string, number][] | null} */
  rows() {
    const found = this.text.value.trim().split("\n").map((line) => ROW.exec(line));
    if (found.some((row) => !row || !(Number(row[2]) > 0))) return null;
    return found.map((row) => [/** @type {RegExpExecArray} */ (row)[1], Number(/** @type {RegExpExecArray} */ (row)[2])]);
  }

  /** Leave items out, words and texts round the edge. @param {number[]} ids */
  leaveOut(ids) {
    const chosen = this.studio.collage.items.filter(({ id }) => ids.includes(id));
    const texts = new Set(chosen.filter((one) => !one.is_word).map(({ name }) => name));
    if (texts.size) this.lines.leaveOut(texts);
    this.list.leaveOut(...new Set(chosen.filter((one) => one.is_word).map(({ name }) => name)));
  }

  change() {
    const words = this.rows();
    if (!words) return tell("each line needs a word and a weight above 0, as hope, 12", { isError: true });
    this.studio.connection.send({ type: "words", words, font: this.font.value });
  }

  /** @param {Event} event */
  submitted(event) {
    event.preventDefault();
    if (!this.text.value.trim()) return this.text.focus();
    return this.submit();
  }

  /** Fill with the text or table that is in the field. */
  async submit() {
    const rows = this.rows();
    const lines = rows ? ["word,weight", ...rows.map(([word, weight]) => `"${word.replaceAll('"', '""')}",${weight}`)].join("\n") : this.text.value;
    const file = new File([lines], rows ? "words.csv" : "words.txt");
    await this.studio.dropping.send([file], (batch) => this.fillFrom(batch));
  }

  /** @param {string} batch of a text or a table */
  fillFrom(batch) {
    const words = { source: `file:${batch}`, count: Number(this.count.value) || 80, font: this.font.value, palette: this.palette.value || null };
    if (this.mixing.isBeside) this.mixing.send(words);
    else this.studio.connection.send({ type: "fill", use: "words", ...words, ...this.lines.asked, without: [...this.list.without.keys()] });
  }

  /**
   * Have a font of a file.
   * @param {File} file
   */
  async take(file) {
    tell(`Reading ${file.name}`, { about: FONT });
    if (this.studio.panels.current !== "words") await this.studio.panels.toggle("words");
    await this.font.fill(this.letters());
    await this.studio.dropping.send([file], (batch) => this.font.own(batch, file.name));
  }

  /** Set the words that are there in the font that was chosen. @param {string} name */
  setIn(name) {
    const areThere = this.list.things.length > 0;
    tell(areThere ? `Setting the words in ${name}` : `${name}: words are set in it from now on`, { about: FONT });
    this.list.tell(new Map());
  }
}
