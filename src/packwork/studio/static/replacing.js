// @ts-check
/** The dialog that puts another drawing in the place of what is chosen. */

import { h } from "./dom.js";
import { thumbOf } from "./thumbs.js";

export class Replacing {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.grid = h("div", { class: "grid small" });
    const close = () => this.dialog.close();
    this.dialog = h("dialog", { class: "replacing", "aria-label": "Replace what is chosen" }, h("h2", {}, "Replace by"),
      h("div", { class: "row" }, h("button", { type: "button", class: "primary", onclick: () => this.file() }, "A file …")), this.grid,
      h("div", { class: "row end" }, h("button", { type: "button", onclick: close }, "Cancel")));
    document.body.append(this.dialog);
  }

  async open() {
    this.dialog.showModal();
    const bundled = (await this.studio.panels.load())?.items ?? [];
    this.grid.replaceChildren(...bundled.map((/** @type {any} */ one) =>
      h("button", { type: "button", class: "choice", title: one.name, "aria-label": one.name, onclick: () => this.swap(`builtin:${one.name}`) }, thumbOf(one))));
  }

  file() {
    this.studio.dropping.chooseOne((batch) => this.swap(`file:${batch}`));
  }

  /** @param {string} source */
  swap(source) {
    this.dialog.close();
    this.studio.connection.send({ type: "swap", items: [...this.studio.choice.ids], source });
  }
}
