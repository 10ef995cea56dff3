// @ts-check
/** What a print shop asks for, of an export: marks, spot inks, the press. */

import { h } from "./dom.js";

const MARKS = /** @type {const} */ ([["none", "none"], ["crop", "where it is trimmed"], ["all", "and for registration"]]);
/** Formats that have more than a picture of the sheet. */
const OF_PRESSES = new Set(["pdf"]);

/**
 * Fields of them; grey, with the reason, what a format does not have.
 * @param {string} kind
 * @param {import("./dropping.js").Dropping} dropping
 */
export function printFields(kind, dropping) {
  const why = OF_PRESSES.has(kind) ? "" : "PDF alone has it";
  const disabled = Boolean(why);
  const profile = h("input", { type: "hidden", name: "icc", disabled });
  const press = h("button", { type: "button", disabled, onclick: () => dropping.askFile(".icc,.icm", (batch, file) => {
    [profile.value, press.textContent] = [`file:${batch}`, file];
  }) }, "Its profile …");
  const marks = h("select", { name: "marks", disabled }, ...MARKS.map(([value, label]) => h("option", { value }, label)));
  const spot = h("input", { type: "text", name: "spot", placeholder: "Gold=#b58b2a", spellcheck: "false", disabled });
  return h("details", { class: "printing" }, h("summary", {}, "More, for print"),
    field("Marks beside the sheet", marks, why), field("Spot inks", spot, why), field("Press (ICC)", h("span", {}, press, profile), why));
}

/** @param {string} label @param {HTMLElement} asked @param {string} why it is grey; empty where it is not */
function field(label, asked, why) {
  // A button in a label would be named by it.
  const tag = asked instanceof HTMLSpanElement ? "div" : "label";
  return h(tag, { class: why ? "asks grey" : "asks" }, h("span", {}, label, why && h("small", {}, why)), asked);
}
