// @ts-check
/** What lies where: all put anew in an order, or like things side by side. */

import { h } from "./dom.js";

/** @typedef {import("./wire.js").Order} Order */

const MEASURES = /** @type {const} */ ([["hue", "their hue"], ["lightness", "their lightness"], ["weight", "their weight"], ["name", "their name"]]);
const WAYS = /** @type {const} */ ([["around", "around the middle"], ["outwards", "from the middle outwards"], ["inwards", "from the rim inwards"],
  ["right", "from left to right"], ["left", "from right to left"], ["down", "from top to bottom"], ["up", "from bottom to top"], ["along", "along the container"]]);
const TABLES = ".csv,.tsv,.xlsx,.json,.npy,.parquet";

export class Ordering {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.by = choice("By what", MEASURES);
    this.way = choice("Which way", WAYS);
    this.element = h("details", { class: "ordering" }, h("summary", {}, "Put them in an order"),
      h("label", { class: "row" }, "By", this.by), h("label", { class: "row" }, "Way", this.way),
      h("div", { class: "row" }, h("button", { type: "button", onclick: () => this.order() }, "Put in order")),
      h("p", { class: "hint" }, "What is held stays. Undo brings the old places back."));
  }

  /** Show where it is asked for. */
  open() {
    this.studio.panels.goTo("items");
    this.element.open = true;
    this.element.scrollIntoView({ block: "nearest" });
    this.by.focus();
  }

  order() {
    const [by, way] = /** @type {[Order["by"], Order["way"]]} */ ([this.by.value, this.way.value]);
    this.studio.connection.send({ type: "order", by, way });
  }

  /** Ask for a table of vectors, by which like things come to lie together. */
  chooseVectors() {
    const { dropping, connection } = this.studio;
    dropping.ask(TABLES, false, (batch) => connection.send({ type: "alike", source: `file:${batch}` }));
  }

  /** Put words together that stand together in their text. */
  byText() {
    this.studio.connection.send({ type: "alike", source: "auto" });
  }
}

/**
 * @param {string} label
 * @param {readonly (readonly [string, string])[]} choices
 */
function choice(label, choices) {
  return h("select", { "aria-label": label }, ...choices.map(([value, shown]) => h("option", { value }, shown)));
}
