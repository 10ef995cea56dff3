// @ts-check
/** The panels at the side: container and items. */

import { byId, button, h, icon, vector } from "./dom.js";
import { fillOptions } from "./options.js";
import { tell } from "./toasts.js";
import { fillWords } from "./words.js";

/** @typedef {import("./studio.js").Studio} Studio */
/** @typedef {import("./wire.js").Thing} Thing */

const PANELS = /** @type {const} */ ([
  ["room", "shape", "Container"], ["items", "items", "Items"], ["words", "words", "Words"], ["options", "options", "Options"], ["more", "more", "More"],
]);
/** Rows of a list at most. */
const MOST = 400;
const THUMB = 40;

export class Panels {
  /** @param {Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.panel = byId("panel");
    this.current = "";
    /** @type {any} */
    this.choices = null;
    this.listed = "";
    for (const [id, name, label] of PANELS) {
      byId("tabs").append(h("button", { type: "button", id: `tab-${id}`, "aria-pressed": "false", title: label, onclick: () => this.toggle(id) }, icon(name), h("span", {}, label)));
    }
  }

  /** @param {string} id */
  async toggle(id) {
    this.current = this.current === id ? "" : id;
    for (const [one] of PANELS) byId(`tab-${one}`).setAttribute("aria-pressed", String(one === this.current));
    this.panel.hidden = !this.current;
    document.body.classList.toggle("with-panel", Boolean(this.current));
    this.listed = "";
    await this.fill();
    this.studio.resized();
  }

  async fill() {
    if (!this.current) return;
    const label = PANELS.find(([id]) => id === this.current)?.[2] ?? "";
    const close = button("close", "Close the panel", () => this.toggle(this.current), { class: "close" });
    this.body = h("div", { class: "body" });
    this.panel.replaceChildren(h("div", { class: "head" }, h("h2", {}, label), close), this.body);
    this.fillBody(this.body);
    if (this.choices) return;
    this.choices = await this.load();
    if (this.body.isConnected) this.fillBody(this.body);
  }

  /** @param {HTMLElement} body */
  fillBody(body) {
    if (this.current === "room") this.fillRoom(body);
    if (this.current === "items") this.fillItems(body);
    if (this.current === "words") fillWords(body, this.studio);
    if (this.current === "options") fillOptions(body, this.studio, this.choices?.options ?? []);
    if (this.current === "more") this.studio.variants.fill(body);
  }

  async load() {
    try {
      return await (await this.studio.connection.ask("/choices")).json();
    } catch (error) {
      tell(/** @type {Error} */ (error).message, { isError: true });
      return null;
    }
  }

  /** @param {HTMLElement} body */
  fillRoom(body) {
    const { connection, dropping } = this.studio;
    const word = h("input", { type: "text", id: "word", maxlength: "60", placeholder: "HELLO", "aria-label": "Word to fill" });
    const fill = () => word.value.trim() && connection.send({ type: "room", source: `text:${word.value.trim()}` });
    const grid = (this.choices?.containers ?? []).map((/** @type {any} */ one) =>
      h("button", { type: "button", class: "choice", title: one.name, "aria-label": one.name, onclick: () => connection.send({ type: "room", source: `builtin:${one.name}` }) }, picture(one)));
    body.replaceChildren(
      h("div", { class: "drop-here", "data-drops": "room" }, h("p", {}, "Drop an SVG or a picture here: dark is inside."),
        h("button", { type: "button", onclick: () => dropping.choose(true) }, "Choose a file")),
      h("form", { class: "row", onsubmit: (/** @type {Event} */ event) => { event.preventDefault(); fill(); } }, word, h("button", { type: "submit" }, "Fill a word")),
      h("h3", {}, "Bundled"), h("div", { class: "grid" }, ...grid));
  }

  /** @param {HTMLElement} body */
  fillItems(body) {
    const { connection, dropping } = this.studio;
    this.list = h("ul", { class: "items", "aria-label": "Items of the collage" });
    this.counter = h("input", { type: "number", id: "count", min: "1", max: "10000", "aria-label": "How many items in all",
      onchange: (/** @type {Event} */ event) => connection.send({ type: "count", count: Number(/** @type {HTMLInputElement} */ (event.target).value) || 1 }) });
    const grid = (this.choices?.items ?? []).map((/** @type {any} */ one) =>
      h("button", { type: "button", class: "choice", title: one.name, "aria-label": `Add ${one.name}`, onclick: () => connection.send({ type: "bring", sources: [`builtin:${one.name}`] }) }, thumbOf(one)));
    body.replaceChildren(
      h("div", { class: "drop-here" }, h("p", {}, "Drop drawings, pictures or folders anywhere."),
        h("button", { type: "button", onclick: () => dropping.choose() }, "Choose files"),
        h("label", { class: "tick" }, h("input", { type: "checkbox", checked: dropping.replaces, onchange: (/** @type {Event} */ event) => (dropping.replaces = /** @type {HTMLInputElement} */ (event.target).checked) }), "in place of what is there")),
      h("label", { class: "row" }, "In all", this.counter),
      this.list, h("details", {}, h("summary", {}, "Add bundled ones"), h("div", { class: "grid small" }, ...grid)));
    this.listed = "";
    this.refresh();
  }

  /** Bring the list of items up to what there is. */
  refresh() {
    if (this.current !== "items" || !this.list || !this.list.isConnected) return;
    const { collage, choice } = this.studio;
    const groups = grouped(collage.items);
    const key = JSON.stringify([...groups.values()].map((group) => [group[0].shape, group[0].name, group.map((one) => one.id)]));
    if (key !== this.listed) {
      this.listed = key;
      this.list.replaceChildren(...[...groups.values()].slice(0, MOST).map((group) => this.row(group)));
      if (groups.size > MOST) this.list.append(h("li", { class: "hint" }, `and ${groups.size - MOST} more`));
      if (document.activeElement !== this.counter && this.counter) this.counter.value = String(collage.items.length);
    }
    for (const row of this.list.querySelectorAll("button.item")) {
      const ids = /** @type {HTMLElement} */ (row).dataset.ids?.split(" ").map(Number) ?? [];
      row.setAttribute("aria-pressed", String(ids.some((id) => choice.has(id))));
    }
  }

  /** @param {Thing[]} group */
  row(group) {
    const { connection, choice, collage } = this.studio;
    const [first] = group;
    const ids = group.map((one) => one.id);
    const less = button("minus", `One ${first.name} less`, () => connection.do({ kind: "remove", items: [ids[ids.length - 1]] }));
    const more = button("plus", `One ${first.name} more`, () => connection.do({ kind: "duplicate", item: first.id }));
    less.disabled = collage.items.length < 2;
    const held = group.some((one) => one.held.some(Boolean));
    return h("li", {},
      h("button", { type: "button", class: "item", "data-ids": ids.join(" "), "aria-pressed": "false", onclick: () => choice.set(ids) },
        thumbOf(collage.look(first)), h("span", { class: "name" }, first.name), held && icon("pin")),
      h("span", { class: "stepper" }, less, h("span", { "aria-label": `${group.length} of them` }, String(group.length)), more));
  }
}

/**
 * Items by their look and name, in the order of names.
 * @param {Thing[]} items
 */
function grouped(items) {
  /** @type {Map<string, Thing[]>} */
  const groups = new Map();
  for (const item of items) {
    const key = `${item.name}\n${item.shape}`;
    groups.set(key, [...(groups.get(key) ?? []), item]);
  }
  return new Map([...groups].sort(([a], [b]) => a.localeCompare(b)));
}

/** @param {{path: string, box: number[]}} one */
function picture(one) {
  const [left, top, right, bottom] = one.box;
  return vector(`${left} ${top} ${right - left} ${bottom - top}`, one.path);
}

/** @type {Map<string, string>} */
const URLS = new Map();

/**
 * A small picture of an item: never markup in our own document.
 * @param {{key: string, svg: string, ink: string, fill: string, box: number[]}} look
 */
function thumbOf(look) {
  const [left, top, right, bottom] = look.box;
  if (!look.svg) {
    const drawn = vector(`${left} ${top} ${right - left} ${bottom - top}`, look.ink);
    drawn.classList.add("thumb");
    drawn.querySelector("path")?.setAttribute("fill", look.fill);
    return drawn;
  }
  if (!URLS.has(look.key)) URLS.set(look.key, URL.createObjectURL(new Blob([look.svg], { type: "image/svg+xml" })));
  return h("img", { class: "thumb", src: URLS.get(look.key), alt: "", width: THUMB, height: THUMB, loading: "lazy" });
}
