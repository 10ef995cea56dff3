// @ts-check
/** The dialog about a table: its words, a chart of its columns, or vectors of the items. */

import { h } from "./dom.js";
import { tell } from "./toasts.js";

/** @typedef {{name: string, numbers: boolean, values: number, regions: boolean}} Column */
/** @typedef {{columns: Column[], rows: string[][], count: number}} Offered */

/** Columns of the preview. */
const COLUMNS = 4;
/** Values of a column that colours can tell apart. */
const COLOURS = 9;

export class Tables {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.batch = "";
    /** Columns of numbers. @type {Set<string>} */
    this.numbers = new Set();
    /** Columns that name parts of the container. @type {Set<string>} */
    this.mapped = new Set();
    this.title = h("h2", {});
    this.rows = h("table", {});
    this.size = h("select", {});
    this.colour = h("select", {});
    this.label = h("select", {});
    this.mark = h("select", {});
    this.by = h("select", { onchange: () => this.refresh() });
    this.inRegions = h("input", { type: "checkbox", checked: true });
    this.step = h("input", { type: "number", min: "0", step: "any", placeholder: "each value" });
    this.heading = h("input", { type: "text", maxlength: "200", placeholder: "none" });
    this.answers = h("div", { class: "stack" },
      this.answer("Words", "each as large as its number", () => this.fill(), "primary"),
      this.answer("A chart", "a mark for each row, as large as its number", () => this.show(true)),
      this.answer("Vectors", "like items come to lie side by side", () => this.alike()));
    const field = (/** @type {string} */ label, /** @type {HTMLElement} */ of) => h("label", { class: "row" }, label, of);
    this.form = h("form", { class: "columns", onsubmit: (/** @type {Event} */ event) => this.submitted(event) },
      field("Size", this.size), field("Colour", this.colour), field("Names", this.label), field("Groups", this.by),
      this.regions = h("label", { class: "tick" }, this.inRegions, "Each in its region of the map"),
      this.steps = field("In steps of", this.step), field("Marks", this.mark), field("Title", this.heading),
      h("p", { class: "hint" }, "It begins as a document of its own, in the container that is there."),
      h("div", { class: "row" }, h("button", { type: "submit", class: "primary" }, "Draw the chart"), h("button", { type: "button", onclick: () => this.show(false) }, "Back")));
    this.dialog = h("dialog", { class: "asking", "aria-label": "What is in the table" }, this.title, this.rows, this.answers, this.form,
      h("div", { class: "row end" }, h("button", { type: "button", onclick: () => this.dialog.close() }, "Cancel")));
    document.body.append(this.dialog);
  }

  /** @param {string} label @param {string} what @param {() => void} act @param {string} [look] */
  answer(label, what, act, look = "") {
    return h("button", { type: "button", class: look, onclick: act }, h("strong", {}, label), h("span", {}, what));
  }

  /**
   * Ask what a table is, or how a chart shows it.
   * @param {string} name
   * @param {string} batch in which the studio has it
   * @param {boolean} [isChart]
   */
  async ask(name, batch, isChart = false) {
    try {
      this.offer(await (await this.studio.connection.ask(`/tables/${batch}`)).json());
    } catch (error) {
      return tell(/** @type {Error} */ (error).message, { isError: true });
    }
    this.batch = batch;
    this.title.textContent = `What is in ${name}?`;
    this.show(isChart);
    this.dialog.showModal();
  }

  /** @param {Offered} offered */
  offer({ columns, rows, count }) {
    const line = (/** @type {"th" | "td"} */ tag, /** @type {string[]} */ cells) => h("tr", {}, ...cells.slice(0, COLUMNS).map((cell) => h(tag, {}, cell)));
    this.rows.replaceChildren(line("th", columns.map(({ name }) => name)), ...rows.map((cells) => line("td", cells)));
    const numbers = columns.filter((one) => one.numbers);
    const texts = columns.filter((one) => !one.numbers);
    const names = texts.toSorted((a, b) => b.values - a.values)[0];
    const mapped = columns.filter((one) => one.regions);
    const kinds = texts.find((one) => one !== names && one !== mapped[0] && one.values > 1 && one.values < count && one.values <= COLOURS);
    choose(this.size, "all alike", numbers, numbers[0]);
    choose(this.colour, "all alike", columns, kinds);
    choose(this.label, "none", columns, names);
    choose(this.by, "none", columns, mapped[0]);
    this.mapped = new Set(mapped.map((one) => one.name));
    this.numbers = new Set(numbers.map((one) => one.name));
    this.refresh();
  }

  /** Ask for steps of what are numbers, and whether names of parts of the container mean these. */
  refresh() {
    this.regions.hidden = !this.mapped.has(this.by.value);
    this.steps.hidden = !this.numbers.has(this.by.value);
  }

  /** @param {boolean} isChart */
  async show(isChart) {
    [this.answers.hidden, this.form.hidden] = [isChart, !isChart];
    if (!isChart) return;
    this.size.focus();
    const bundled = (await this.studio.panels.load())?.items ?? [];
    if (!this.mark.options.length) this.mark.append(h("option", { value: "" }, "circles"), ...bundled.map((/** @type {any} */ { name }) => h("option", { value: name }, name)));
  }

  /** @param {Event} event */
  submitted(event) {
    event.preventDefault();
    this.dialog.close();
    const { size, colour, label, by, step, mark, heading } = this;
    this.studio.choice.set([]);
    this.studio.connection.send({
      type: "chart", source: `file:${this.batch}`, size_by: size.value || null, color_by: colour.value || null, label_by: label.value || null,
      by: by.value || null, in_regions: !this.regions.hidden && this.inRegions.checked, by_step: this.steps.hidden ? null : step.valueAsNumber || null,
      mark: mark.value ? `builtin:${mark.value}` : null, title: heading.value.trim() });
  }

  fill() {
    this.dialog.close();
    this.studio.words.fillFrom(this.batch);
  }

  alike() {
    this.dialog.close();
    this.studio.connection.send({ type: "alike", source: `file:${this.batch}` });
  }
}

/**
 * @param {HTMLSelectElement} field
 * @param {string} none
 * @param {Column[]} columns
 * @param {Column | undefined} chosen
 */
function choose(field, none, columns, chosen) {
  field.replaceChildren(h("option", { value: "" }, none), ...columns.map((one) => h("option", { value: one.name, selected: one === chosen }, one.name)));
}
