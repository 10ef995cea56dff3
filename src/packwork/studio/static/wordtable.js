// @ts-check
/** The table of the words that are there: counted, coloured, upright, left out. */

import { button, colourField, h } from "./dom.js";
import { together } from "./hand.js";
import { isTypedIn } from "./keys.js";
import { kindOf } from "./kinds.js";
import { tell } from "./toasts.js";

/** @typedef {import("./wire.js").Thing} Thing */

/** Rows at most. */
const MOST = 400;

/**
 * What gives the focus back to a list that is made anew: to its row, or what comes in its place.
 * @param {HTMLElement} list
 */
function heldFocus(list) {
  const active = document.activeElement;
  const row = active?.closest("li");
  if (!row || !list.contains(row)) return () => {};
  const across = [...row.children].indexOf(/** @type {Element} */ (active)), down = [...list.children].indexOf(row);
  const nameOf = (/** @type {Element} */ one) => one.querySelector(".name")?.textContent;
  return () => {
    const rows = [...list.children];
    const now = rows.find((one) => nameOf(one) === nameOf(row)) ?? rows[Math.min(down, rows.length - 1)];
    /** @type {HTMLElement | undefined} */ (now?.children[across])?.focus();
  };
}

export class WordTable {
  /** @param {import("./words.js").Words} words */
  constructor(words) {
    this.words = words;
    this.studio = words.studio;
    this.list = h("ul", { class: "words", "aria-label": "Words that are there" });
    this.out = h("div", { class: "chips", role: "group", "aria-label": "Words left out" });
    this.word = h("input", { type: "text", maxlength: "100", placeholder: "Leave out another word", "aria-label": "Leave out another word",
      onchange: () => this.leaveOut(this.word.value.trim()) });
    this.element = h("section", {}, this.list, this.out, this.word);
    /** Words left out: how often they were there, whether they have gone by now. @type {Map<string, {count: number, isGone: boolean}>} */
    this.without = new Map();
    this.listed = "";
  }

  /** The most frequent first, each once. */
  get things() {
    /** @type {Map<string, Thing>} */
    const found = new Map();
    for (const item of this.studio.collage.items) if (item.is_word && !found.has(item.name)) found.set(item.name, item);
    const things = [...found.values()];
    const areCounted = things.every((one) => one.count !== null);
    return things.sort((a, b) => (areCounted ? Number(b.count) - Number(a.count) : b.weight - a.weight));
  }

  refresh() {
    const { things } = this;
    this.list.hidden = !things.length;
    const there = new Set(things.map(({ name }) => name));
    for (const [name, count] of Object.entries(this.studio.collage.scene?.left_out ?? {})) this.without.set(name, { count, isGone: true });
    for (const [name, one] of this.without) {
      // What was undone is there again.
      if (there.has(name) && one.isGone) this.without.delete(name);
      else one.isGone ||= !there.has(name);
    }
    const key = JSON.stringify([things.map(({ id, name, held }) => [id, name, held[1], this.countOf(name, things), this.studio.collage.colour(id)]), [...this.without.keys()]]);
    const field = document.activeElement;
    if (key === this.listed || (field instanceof HTMLInputElement && this.list.contains(field) && isTypedIn(field))) return;
    this.listed = key;
    const leave = heldFocus(this.list);
    this.list.replaceChildren(...things.slice(0, MOST).map((thing) => this.row(thing, things)));
    leave();
    this.out.replaceChildren(...[...this.without.keys()].map((name) => h("button", { type: "button", title: "Bring it back", onclick: () => this.bringBack(name) }, h("s", {}, name), " ×")));
  }

  /**
   * How often a word was counted; of words that tell no counts their weight, up to 100.
   * @param {string} name
   * @param {Thing[]} things
   */
  countOf(name, things) {
    const thing = things.find((one) => one.name === name);
    if (things.every((one) => one.count !== null)) return thing?.count ?? 1;
    return Number(((100 * (thing?.weight ?? 1)) / things[0].weight).toPrecision(3));
  }

  /** @param {Thing} thing @param {Thing[]} things */
  row(thing, things) {
    const { connection, collage, choice } = this.studio;
    const { id, name, held } = thing;
    const count = h("input", { type: "number", min: "0.01", step: "any", value: String(this.countOf(name, things)), "aria-label": `How often: ${name}`,
      onchange: () => Number(count.value) > 0 && this.tell(new Map([[name, Number(count.value)]])) });
    const own = collage.colour(id);
    const colour = colourField({ value: own ?? "#2d3748", "aria-label": `Colour of ${name}` }, (value) => connection.do({ kind: "recolour", items: [id], colour: value }));
    const upright = button("upright", `${name} stays upright`, () => connection.do(held[1]
      ? { kind: "release", items: [id], properties: ["angle"] }
      : together([{ kind: "turn", item: id, angle: 0 }, { kind: "hold", items: [id], properties: ["angle"] }])), { "aria-pressed": String(held[1]) });
    upright.hidden = !kindOf(collage).moves;
    return h("li", {}, button("eye", `Leave ${name} out`, () => this.leaveOut(name)),
      h("button", { type: "button", class: "name", dir: "auto", onclick: () => choice.set([id]) }, name), count, colour, upright);
  }

  /** Leave words out, unless no other would be left. @param {string[]} names */
  leaveOut(...names) {
    this.word.value = "";
    const { things } = this;
    const gone = names.filter(Boolean);
    if (!gone.length) return;
    if (things.length && things.every((one) => gone.includes(one.name))) return tell("nothing would be left; keep one word at least", { isError: true });
    for (const name of gone) this.without.set(name, { count: this.countOf(name, things), isGone: false });
    if (things.some((one) => gone.includes(one.name))) this.tell(new Map(gone.map((name) => [name, 0])));
    else this.refresh();
  }

  /** @param {string} name */
  bringBack(name) {
    const count = this.without.get(name)?.count ?? 1;
    this.without.delete(name);
    this.tell(new Map([[name, count]]));
    this.refresh();
  }

  /**
   * Have the words that there are, but for some.
   * @param {Map<string, number>} changed how often these are to be there; 0 for not at all
   */
  tell(changed) {
    const { things } = this;
    if (!things.length) return;
    const counts = new Map(things.map(({ name }) => [name, this.countOf(name, things)]));
    for (const [name, count] of changed) counts.set(name, count);
    const words = [...counts].filter(([, count]) => count > 0);
    this.studio.connection.send({ type: "words", words, font: this.words.font.value });
  }
}
