// @ts-check
/** The dialog that a document begins with: templates as pictures, what was kept, files. */

import { h } from "./dom.js";
import { tell } from "./toasts.js";

/** @typedef {{name: string, title: string, count: number, changed: number, png: string}} Recent */

/** Templates: name, what it is called, and what it takes of a person's own. */
const TEMPLATES = /** @type {const} */ ([
  ["icons", "Icons in a heart", ""], ["letters", "A word of icons", ""], ["words", "A word cloud", ""],
  ["names", "A wall of names", ""], ["badge", "A badge", ""], ["paper", "Wrapping paper", ""], ["jar", "A jar of icons", ""], ["nest", "Parts on a sheet", ""],
  ["photos", "Your photographs", "image/*"], ["mosaic", "A mosaic of icons", "image/*"], ["chart", "A chart of your table", ".csv,.tsv,.xlsx,.json"],
]);
const UNITS = /** @type {const} */ ([["day", 86400], ["hour", 3600], ["minute", 60]]);

export class Start {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.recent = h("div", { class: "starts" });
    this.kept = h("section", { hidden: true }, h("h3", {}, "Recent"), this.recent);
    this.dialog = h("dialog", { class: "start", "aria-label": "New document" },
      h("div", { class: "row head" }, h("h2", {}, "Begin with"), h("button", { type: "button", onclick: () => this.files() }, "Open a file …")),
      h("div", { class: "starts" }, ...TEMPLATES.map(([name, label, accept]) => this.card(`${new URL("templates", import.meta.url)}/${name}.webp`, label, "", () => this.begin(name, accept)))),
      this.kept,
      h("div", { class: "row end" }, h("span", { class: "hint" }, "All you do is kept on this machine."), h("button", { type: "button", onclick: () => this.dialog.close() }, "Cancel")));
    document.body.append(this.dialog);
    // Files that are dragged in show where they may be dropped, which it would cover.
    addEventListener("dragenter", (event) => event.dataTransfer?.types.includes("Files") && this.dialog.close());
    /** @type {string[]} */
    this.pictures = [];
  }

  /** @param {string} picture @param {string} label @param {string} hint @param {() => void} act */
  card(picture, label, hint, act) {
    return h("button", { type: "button", onclick: act }, h("img", { src: picture, alt: "", width: "160", height: "120", loading: "lazy" }),
      h("strong", {}, label), hint && h("span", {}, hint));
  }

  async open() {
    this.dialog.showModal();
    try {
      const found = await (await this.studio.connection.ask("/recent")).json();
      this.show(found);
    } catch (error) {
      tell(/** @type {Error} */ (error).message, { isError: true });
    }
  }

  /** @param {Recent[]} found */
  show(found) {
    for (const one of this.pictures) URL.revokeObjectURL(one);
    this.pictures = found.map(({ png }) => URL.createObjectURL(new Blob([Uint8Array.from(atob(png), (letter) => letter.charCodeAt(0))], { type: "image/png" })));
    this.kept.hidden = !found.length;
    this.recent.replaceChildren(...found.map(({ name, title, count, changed }, k) =>
      this.card(this.pictures[k], title, `${count} items, ${ago(changed)}`, () => this.send({ kept: name }))));
  }

  /** @param {typeof TEMPLATES[number][0]} name @param {string} accept */
  begin(name, accept) {
    const { dropping } = this.studio;
    if (name === "chart") return dropping.question(accept, false, ([file]) => this.chart(file));
    if (!accept) return this.send({ template: name });
    dropping.ask(accept, name === "photos", (batch) => this.send({ template: name, source: `file:${batch}` }));
  }

  /** @param {File} file */
  chart(file) {
    this.dialog.close();
    return this.studio.dropping.send([file], (batch) => this.studio.incoming.tables.ask(file.name, batch, true));
  }

  /** @param {Partial<import("./wire.js").Begin>} asked */
  send(asked) {
    this.dialog.close();
    this.studio.choice.set([]);
    this.studio.connection.send({ type: "begin", ...asked });
  }

  files() {
    this.dialog.close();
    this.studio.dropping.choose();
  }
}

/** How long ago that was, in words. @param {number} changed seconds since 1970 */
function ago(changed) {
  const passed = Date.now() / 1000 - changed;
  const format = new Intl.RelativeTimeFormat("en", { numeric: "auto" });
  const [unit, seconds] = UNITS.find(([, length]) => passed >= length) ?? UNITS[2];
  return passed < 60 ? "just now" : format.format(-Math.floor(passed / seconds), unit);
}
