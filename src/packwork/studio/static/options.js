// @ts-check
/** The panel of numbers for all items, drawn from the fields that the studio tells of. */

import { h } from "./dom.js";
import { kindOf } from "./kinds.js";

/** @typedef {{name: string, help: string, choices: string[], range: number[], default: any}} Question */

/** Characters of an explanation that is shown without being asked for. */
const SHORT = 90;
const LABELS = /** @type {Record<string, string>} */ ({ padding: "Gap", sizes: "Sizes", size_ratio: "Size ratio", rotate: "Turns", evenness: "Evenness" });

/**
 * @param {HTMLElement} body
 * @param {import("./studio.js").Studio} studio
 * @param {Question[]} questions
 */
export function fillOptions(body, studio, questions) {
  const now = studio.collage.scene?.options ?? {};
  const set = (/** @type {string} */ name, /** @type {any} */ value) => studio.connection.send({ type: "set", options: { [name]: value } });
  const { settings } = kindOf(studio.collage);
  body.dataset.of = subject(studio);
  const asked = questions.filter((one) => !settings || settings.has(one.name));
  body.replaceChildren(...asked.map((one) => (one.choices.length ? choiceOf(one, now, set) : sliderOf(one, now, set, studio))),
    ...(kindOf(studio.collage).edge && kindOf(studio.collage).moves ? [studio.forces.element] : []), h("p", { class: "hint" }, "Pour anew (R) fills again with these."));
  studio.forces.refresh();
}

/**
 * Bring the fields up to what holds now, as after undo; what is being changed stays.
 * @param {HTMLElement} body
 * @param {import("./studio.js").Studio} studio
 * @param {Question[]} questions
 */
export function refreshOptions(body, studio, questions) {
  if (questions.length && body.dataset.of !== subject(studio)) return fillOptions(body, studio, questions);
  for (const [name, value] of Object.entries(studio.collage.scene?.options ?? {})) {
    const field = body.querySelector(`#ask-${name}`);
    const isOther = (field instanceof HTMLInputElement || field instanceof HTMLSelectElement) && field.value !== String(value);
    if (!isOther || field.matches(":active")) continue;
    if (field instanceof HTMLSelectElement && ![...field.options].some((one) => one.value === String(value))) field.append(choice(String(value)));
    else if (field instanceof HTMLInputElement) field.max = String(Math.max(Number(field.max), Number(value)));
    field.value = String(value);
    const shown = field.parentElement?.querySelector("output");
    if (shown) shown.textContent = `${value}${unitOf(name, studio)}`;
  }
}

/** What the questions depend on: kind of document and unit. @param {import("./studio.js").Studio} studio */
function subject(studio) {
  return `${studio.collage.scene?.kind} ${studio.collage.scene?.unit}`;
}

/** @param {string} name @param {import("./studio.js").Studio} studio */
function unitOf(name, studio) {
  return name === "padding" ? ` ${studio.collage.scene?.unit ?? ""}` : "";
}

/** @param {Question} one @param {Record<string, any>} now @param {(name: string, value: any) => void} set */
function choiceOf(one, now, set) {
  const value = String(now[one.name] ?? one.default);
  const choices = one.choices.includes(value) ? one.choices : [...one.choices, value];
  const field = h("select", { onchange: (/** @type {Event} */ event) => set(one.name, /** @type {HTMLSelectElement} */ (event.target).value) },
    ...choices.map(choice));
  field.value = value;
  return labelled(one, field);
}

/** @param {string} value */
function choice(value) {
  return h("option", { value }, /^\d+$/.test(value) ? `within ${value}°` : value);
}

/**
 * @param {Question} one
 * @param {Record<string, any>} now
 * @param {(name: string, value: any) => void} set
 * @param {import("./studio.js").Studio} studio
 */
function sliderOf(one, now, set, studio) {
  const value = Number(now[one.name] ?? one.default);
  const [least, most, step] = one.range;
  const unit = unitOf(one.name, studio);
  const shown = h("output", {}, `${value}${unit}`);
  const field = h("input", { type: "range", min: least, max: Math.max(most, value), step, value: String(value),
    oninput: (/** @type {Event} */ event) => (shown.textContent = `${/** @type {HTMLInputElement} */ (event.target).value}${unit}`),
    onchange: (/** @type {Event} */ event) => set(one.name, Number(/** @type {HTMLInputElement} */ (event.target).value)) });
  return labelled(one, field, shown);
}

/** @param {Question} one @param {HTMLElement} field @param {HTMLElement} [shown] */
function labelled(one, field, shown) {
  field.id = `ask-${one.name}`;
  const help = one.help.length > SHORT
    ? h("details", {}, h("summary", {}, "What it does"), h("p", { class: "hint" }, one.help))
    : h("p", { class: "hint" }, one.help);
  return h("div", { class: "question" }, h("label", { for: field.id }, h("span", { class: "asked" }, h("strong", {}, LABELS[one.name] ?? one.name), shown), field), help);
}
