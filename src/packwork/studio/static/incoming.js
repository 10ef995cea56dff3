// @ts-check
/** Dropped or chosen files by their kind: documents open, texts and tables fill, fonts set words. */

import { h } from "./dom.js";
import { tell } from "./toasts.js";

/** @typedef {"document" | "table" | "text" | "font" | "art"} Kind */

/** @type {Record<string, Kind>} */
const KINDS = {
  packwork: "document", toml: "document", geojson: "document", csv: "table", tsv: "table", txt: "text", md: "text",
  ttf: "font", otf: "font", ttc: "font", otc: "font",
};
/** Bytes of a table that are shown, of a text that is taken into the field of words. */
const SHOWN = 4000;
const LONGEST = 500_000;
/** Rows and columns of a table that are shown. */
const ROWS = 5;
const COLUMNS = 4;

/** @param {File} file @returns {Kind} */
function kindOf(file) {
  return KINDS[file.name.split(".").at(-1)?.toLowerCase() ?? ""] ?? "art";
}

export class Incoming {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.title = h("h2", {});
    this.rows = h("table", {});
    this.dialog = h("dialog", { class: "asking", "aria-label": "What is in the table" }, this.title, this.rows,
      h("div", { class: "stack" },
        this.answer("Words", "each as large as its number", (batch) => this.fill(batch), "primary"),
        this.answer("Vectors", "like items come to lie side by side", (batch) => studio.connection.send({ type: "alike", source: `file:${batch}` }))),
      h("div", { class: "row end" }, h("button", { type: "button", onclick: () => this.dialog.close() }, "Cancel")));
    document.body.append(this.dialog);
    /** The table that is asked about. @type {File | null} */
    this.table = null;
  }

  /** @param {string} label @param {string} what @param {(batch: string) => void} act @param {string} [look] */
  answer(label, what, act, look = "") {
    const answered = () => {
      this.dialog.close();
      if (this.table) this.studio.dropping.send([this.table], act);
    };
    return h("button", { type: "button", class: look, onclick: answered }, h("strong", {}, label), h("span", {}, what));
  }

  /**
   * Do with files what a person means by them.
   * @param {File[]} files
   */
  take(files) {
    const { dropping, words } = this.studio;
    const [file] = files;
    const kind = kindOf(file);
    if (files.some((one) => kindOf(one) === "document")) return dropping.send(files, (batch) => this.open(batch));
    if (files.length === 1 && kind === "table") return this.ask(file);
    if (files.length === 1 && kind === "text") return this.read(file);
    if (files.length === 1 && kind === "font") return dropping.send(files, (batch) => words.setIn(batch, file.name));
    const art = files.filter((one) => kindOf(one) === "art");
    for (const one of files) if (!art.includes(one)) tell(`${one.name} is no drawing; give it alone`, { isError: true });
    if (art.length) return dropping.send(art, (batch) => dropping.bring(batch));
  }

  /** @param {string} batch */
  open(batch) {
    this.studio.choice.set([]);
    this.studio.connection.send({ type: "open", source: `file:${batch}` });
  }

  /** @param {File} file */
  async ask(file) {
    this.table = file;
    const lines = (await file.slice(0, SHOWN).text()).split(/\r?\n/).filter((line) => line.trim()).slice(0, ROWS);
    this.title.textContent = `What is in ${file.name}?`;
    this.rows.replaceChildren(...lines.map((line) => h("tr", {}, ...line.split(/[,;\t]/).slice(0, COLUMNS).map((cell) => h("td", {}, cell)))));
    this.dialog.showModal();
  }

  /** @param {string} batch */
  fill(batch) {
    this.studio.words.fillFrom(batch);
  }

  /** @param {File} file */
  async read(file) {
    if (file.size > LONGEST) return this.studio.dropping.send([file], (batch) => this.fill(batch));
    this.studio.words.text.value = await file.text();
    await this.studio.words.submit();
  }
}
