// @ts-check
/** The panel in which a text becomes words that fill the container. */

import { h } from "./dom.js";
import { tell } from "./toasts.js";

const EXAMPLE = "Paste a text here, or a table: a word and its weight on each line, as\nhope, 12\njoy, 7";

/**
 * @param {HTMLElement} body
 * @param {import("./studio.js").Studio} studio
 */
export function fillWords(body, studio) {
  const text = h("textarea", { id: "text", rows: "10", placeholder: EXAMPLE, "aria-label": "Text or table of words", spellcheck: "false" });
  text.value = studio.text;
  text.oninput = () => (studio.text = text.value);
  const count = h("input", { type: "number", id: "words-count", min: "1", max: "1000", value: "80", "aria-label": "How many words at most" });
  const fill = h("button", { type: "submit", class: "primary" }, "Fill with words");
  const form = h("form", { class: "stack", onsubmit: (/** @type {Event} */ event) => {
    event.preventDefault();
    if (text.value.trim()) send(studio, text.value, Number(count.value) || 80);
  } }, text, h("label", { class: "row" }, "Words at most", count), fill);
  body.replaceChildren(h("p", { class: "hint" }, "Words are as large as they are often there. They take the place of what is on the sheet; undo brings that back."), form);
}

/**
 * @param {import("./studio.js").Studio} studio
 * @param {string} text
 * @param {number} count
 */
async function send(studio, text, count) {
  const { connection, dropping } = studio;
  const isTable = text.trim().split("\n").every((line) => /[,;\t]\s*[0-9.]+\s*$/.test(line));
  const lines = isTable ? `word,weight\n${text.trim().replace(/[;\t]/g, ",")}\n` : text;
  try {
    const { batch } = await (await connection.ask("/files", { method: "POST" })).json();
    await dropping.sendOne(new File([lines], isTable ? "words.csv" : "words.txt"), batch);
    connection.send({ type: "fill", use: "words", source: `file:${batch}`, count });
  } catch (error) {
    tell(/** @type {Error} */ (error).message, { isError: true });
  }
}
