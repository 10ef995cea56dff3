// @ts-check
/** The panel of items: what comes in, and a list of what is there, to be changed in place. */

import { button, h, icon, showAgain, showNumber } from "./dom.js";
import { Inspector } from "./inspector.js";
import { kindOf } from "./kinds.js";
import { isTypedIn } from "./keys.js";
import { thumbOf } from "./thumbs.js";

/** @typedef {import("./studio.js").Studio} Studio */
/** @typedef {import("./wire.js").Thing} Thing */

/** Rows of the list at most. */
const MOST = 400;
const AS = /** @type {const} */ ([["beside", "beside the others"], ["items", "in place of them"], ["photos", "in place of them, as whole photos"]]);

export class ItemList {
  /** @param {Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.inspector = new Inspector(studio);
    this.marked = "";
    this.list = h("ul", { class: "items", "aria-label": "Items of the collage" });
    this.counter = h("input", { type: "number", id: "count", min: "1", max: "10000",
      onchange: () => studio.connection.send({ type: "count", count: Number(this.counter.value) || 1 }), onblur: () => showAgain(this.counter) });
    this.orders = h("div", { class: "orders" },
      h("button", { type: "button", class: "wide", title: "Seen from afar, they are the picture", onclick: () => studio.dropping.choosePicture() }, "Show a picture by their colours"),
      h("button", { type: "button", class: "wide", title: "By a table of vectors, such as a model of pictures gives: a row an item, or a first column of names", onclick: () => studio.ordering.chooseVectors() }, "Like beside like, by a table"),
      studio.ordering.element);
    this.query = h("input", { type: "search", id: "find", placeholder: "Find by name", "aria-label": "Find items by name", spellcheck: "false",
      oninput: () => this.refresh(), onkeydown: (/** @type {KeyboardEvent} */ event) => this.step(event) });
    this.count = h("span", { class: "hint", role: "status" });
    /** Groups of which each item has a row. @type {Set<string>} */
    this.unfolded = new Set();
    this.listed = "";
  }

  /** Items by the name that is looked for, in the order of the list. */
  get found() {
    const text = this.query.value.trim().toLowerCase();
    return this.studio.collage.items.filter((one) => one.name.toLowerCase().includes(text)).sort((a, b) => a.name.localeCompare(b.name));
  }

  /** Choose what is found: all of it, or one after another. @param {KeyboardEvent} event */
  step(event) {
    const { choice, canvas } = this.studio;
    const ids = this.found.map((one) => one.id);
    const way = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (event.key === "Enter") {
      choice.set(ids);
      canvas.focus();
    }
    if (!way || !ids.length) return;
    event.preventDefault();
    const at = ids.findIndex((id) => choice.has(id));
    choice.set([ids[(at < 0 && way < 0 ? ids.length - 1 : at + way + ids.length) % ids.length]]);
  }

  /** @param {HTMLElement} body */
  fill(body) {
    const { connection, panels } = this.studio;
    const grid = h("div", { class: "grid small" });
    panels.load().then((choices) => grid.replaceChildren(...(choices?.items ?? []).map((/** @type {any} */ one) =>
      h("button", { type: "button", class: "choice", title: one.name, "aria-label": `Add ${one.name}`, onclick: () => connection.send({ type: "bring", sources: [`builtin:${one.name}`] }) }, thumbOf(one)))));
    body.replaceChildren(
      h("div", { class: "grows" }, this.incoming(), h("details", {}, h("summary", {}, "Add bundled ones"), grid)), this.orders,
      h("label", { class: "row grows" }, "Items in all", this.counter),
      h("div", { class: "row" }, this.query, this.count), this.list);
    body.after(this.inspector.element);
    this.listed = this.marked = "";
    this.refresh();
  }

  /** What files become, and buttons that ask for them. */
  incoming() {
    const { dropping } = this.studio;
    const choose = h("select", { "aria-label": "What files do", onchange: () => (dropping.as = /** @type {any} */ (choose.value)) },
      ...AS.map(([value, label]) => h("option", { value, selected: dropping.as === value }, label)));
    return h("div", { class: "drop-here" }, h("p", {}, "Drop drawings, pictures or folders anywhere, or"),
      h("div", { class: "row center" }, h("button", { type: "button", onclick: () => dropping.choose() }, "Choose files"),
        h("button", { type: "button", onclick: () => dropping.chooseFolder() }, "A folder")),
      h("label", { class: "row center wrap" }, "They come", choose));
  }

  /** Bring the list up to what there is. */
  refresh() {
    if (!this.list.isConnected) return;
    const { collage, choice } = this.studio;
    const { orders, grows } = kindOf(collage);
    this.orders.hidden = !orders;
    for (const one of this.list.parentElement?.querySelectorAll(".grows") ?? []) /** @type {HTMLElement} */ (one).hidden = !grows;
    const found = this.found;
    const groups = [...grouped(found).values()];
    this.count.textContent = found.length < collage.items.length ? `${found.length} of ${collage.items.length}` : "";
    const key = JSON.stringify([[...this.unfolded], kindOf(collage), groups.map((group) => [group[0].shape, group[0].name, group.map((one) => [one.id, one.held])])]);
    if (key !== this.listed) this.rewrite(groups);
    this.listed = key;
    showNumber(this.counter, String(collage.items.length));
    for (const row of this.list.querySelectorAll("button.item")) row.setAttribute("aria-pressed", String(idsOf(row).some((id) => choice.has(id))));
    this.showChosen();
  }

  /** What was asked for last is not to be had: the count of all is what it is. */
  refused() {
    if (!isTypedIn(this.counter)) showAgain(this.counter);
  }

  /** @param {Thing[][]} groups */
  rewrite(groups) {
    this.list.replaceChildren(...groups.slice(0, MOST).flatMap((group) => [this.row(group), ...(this.isUnfolded(group) ? group.map((one, k) => this.part(one, k)) : [])]));
    if (groups.length > MOST) this.list.append(h("li", { class: "hint" }, `and ${groups.length - MOST} more`));
  }

  /** Have what is chosen in the inspector, and its row in view. */
  showChosen() {
    const { choice, collage, gestures } = this.studio;
    this.inspector.show(collage.items.filter((one) => choice.has(one.id)));
    const marked = [...choice.ids].join(" ");
    // Nothing scrolls away under a hand that is at work on the canvas.
    if (marked === this.marked || gestures.pointers.size) return;
    this.marked = marked;
    this.list.querySelector('button.item[aria-pressed="true"]')?.closest("li")?.scrollIntoView({ block: "nearest" });
  }

  /** @param {Thing[]} group */
  isUnfolded(group) {
    return group.length > 1 && this.unfolded.has(keyOf(group[0]));
  }

  /**
   * The row of one item among those that look alike.
   * @param {Thing} item
   * @param {number} k
   */
  part(item, k) {
    return h("li", { class: "part" }, this.chooser([item.id], [h("span", { class: "name" }, `${item.name} #${k + 1}`), item.held.some(Boolean) && icon("pin")]));
  }

  /**
   * A button that chooses items; with shift or Ctrl beside what is chosen.
   * @param {number[]} ids
   * @param {(Node | false)[]} shown
   */
  chooser(ids, shown) {
    const { choice } = this.studio;
    const choose = (/** @type {MouseEvent} */ event) => {
      const isMore = event.shiftKey || event.ctrlKey || event.metaKey;
      const rest = [...choice.ids].filter((id) => !ids.includes(id));
      choice.set(!isMore ? ids : ids.every((id) => choice.has(id)) ? rest : [...rest, ...ids]);
    };
    return h("button", { type: "button", class: "item", "data-ids": ids.join(" "), "aria-pressed": "false", onclick: choose }, ...shown);
  }

  /** @param {Thing[]} group */
  unfold(group) {
    const key = keyOf(group[0]);
    if (!this.unfolded.delete(key)) this.unfolded.add(key);
    this.refresh();
    const row = [...this.list.querySelectorAll("button.each")].find((one) => one.getAttribute("data-key") === key);
    if (row instanceof HTMLElement) row.focus();
  }

  /** @param {Thing[]} group */
  row(group) {
    const { connection, collage } = this.studio;
    const [first] = group;
    const ids = group.map((one) => one.id);
    const { grows } = kindOf(collage);
    const less = button("minus", `One ${first.name} less`, () => connection.do({ kind: "remove", items: [ids[ids.length - 1]] }));
    const more = button("plus", `One ${first.name} more`, () => connection.do({ kind: "duplicate", item: first.id }));
    less.disabled = collage.items.length < 2;
    const held = group.some((one) => one.held.some(Boolean));
    return h("li", {},
      this.chooser(ids, [thumbOf(collage.look(first)), h("span", { class: "name" }, first.name), first.parts > 0 && icon("group"), held && icon("pin")]),
      group.length > 1 && button("down", `Each ${first.name}`, () => this.unfold(group), { class: "each", "aria-expanded": String(this.isUnfolded(group)), "data-key": keyOf(first) }),
      grows && h("span", { class: "stepper", role: "group", "aria-label": `${group.length} ${first.name}` }, less, h("span", {}, String(group.length)), more));
  }
}

/** @param {Element} row */
function idsOf(row) {
  return /** @type {HTMLElement} */ (row).dataset.ids?.split(" ").map(Number) ?? [];
}

/** @param {Thing} item */
function keyOf(item) {
  return `${item.name}\n${item.shape}`;
}

/**
 * Items by their look and name, in the order of names.
 * @param {Thing[]} items
 */
function grouped(items) {
  /** @type {Map<string, Thing[]>} */
  const groups = new Map();
  for (const item of items) {
    const key = keyOf(item);
    const group = groups.get(key);
    if (group) group.push(item);
    else groups.set(key, [item]);
  }
  return new Map([...groups].sort(([a], [b]) => a.localeCompare(b)));
}
