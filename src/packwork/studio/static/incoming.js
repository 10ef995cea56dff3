// @ts-check
/** Dropped or chosen files by their kind: documents open, texts and tables fill, fonts set words. */

import { kindOf as kindOfDocument } from "./kinds.js";
import { isPicture, PictureQuestion } from "./mosaic.js";
import { Tables } from "./tables.js";
import { tell } from "./toasts.js";

/** @typedef {"document" | "table" | "text" | "font" | "art"} Kind */

/** @type {Record<string, Kind>} */
const KINDS = {
  packwork: "document", toml: "document", geojson: "document", csv: "table", tsv: "table", xlsx: "table", txt: "text", md: "text",
  ttf: "font", otf: "font", ttc: "font", otc: "font",
};
/** Bytes of a text that is taken into the field of words. */
const LONGEST = 500_000;

/** @param {File} file @returns {Kind} */
function kindOf(file) {
  return KINDS[file.name.split(".").at(-1)?.toLowerCase() ?? ""] ?? "art";
}

export class Incoming {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.tables = new Tables(studio);
    this.pictures = new PictureQuestion(studio);
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
    if (files.length === 1 && kind === "table") return dropping.send(files, (batch) => this.tables.ask(file.name, batch));
    if (files.length === 1 && kind === "text") return this.read(file);
    if (files.length === 1 && kind === "font") return words.take(file);
    const art = files.filter((one) => kindOf(one) === "art");
    for (const one of files) if (!art.includes(one)) tell(`${one.name} is no drawing; give it alone`, { isError: true });
    if (files.length === 1 && isPicture(file) && dropping.as === "beside" && this.studio.collage.hasPoses && kindOfDocument(this.studio.collage).orders) return this.pictures.ask(file);
    if (art.length) return dropping.send(art, (batch) => dropping.bring(batch));
  }

  /** @param {string} batch */
  open(batch) {
    this.studio.choice.set([]);
    this.studio.connection.send({ type: "open", source: `file:${batch}` });
  }

  /** @param {File} file */
  async read(file) {
    if (file.size > LONGEST) return this.studio.dropping.send([file], (batch) => this.studio.words.fillFrom(batch));
    this.studio.words.text.value = await file.text();
    await this.studio.words.submit();
  }
}
