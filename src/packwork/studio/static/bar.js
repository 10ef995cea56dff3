// @ts-check
/** The bar above, and the one of what is chosen. */

import { button, byId, h, picker } from "./dom.js";
import { shownKey } from "./keys.js";

/** @typedef {import("./actions.js").Action} Action */

const LEFT = ["undo", "redo", "pour"];
/** Buttons whose drawing alone would be a riddle. */
const LABELLED = new Set(["pour"]);
const RIGHT = ["farther", "closer", "fit", "faults", "theme", "keys"];
const CHOSEN = ["inspect", "hold", "release", "duplicate", "crop", "replace", "group", "ungroup", "exchange", "remove"];
/** In their place while something is drawn, cropped or reshaped. */
const AT_WORK = ["keep", "none"];

export class Bar {
  /**
   * @param {Map<string, Action>} actions
   * @param {{recolour: (colour: string, ids: number[]) => void, chosen: () => number[], entitle: (title: string) => void, files: (x: number, y: number) => void}} hears
   */
  constructor(actions, { recolour, chosen, entitle, files }) {
    this.actions = actions;
    /** @type {Map<string, HTMLButtonElement[]>} */
    this.buttons = new Map();
    this.title = h("input", { id: "title", type: "text", maxlength: "200", "aria-label": "Name of the document", title: "Rename", spellcheck: "false",
      onchange: () => entitle(this.title.value.trim()), onkeydown: (/** @type {KeyboardEvent} */ event) => event.key === "Enter" && this.title.blur() });
    const menu = button("down", "Document: new, open, recent, save", () => {
      const box = menu.getBoundingClientRect();
      files(box.left, box.bottom + 4);
    }, { id: "files", "aria-haspopup": "menu" });
    this.saved = h("span", { id: "saved", hidden: true, title: "All you do is kept on this machine: packwork studio --again goes on with it" }, "saved");
    const share = /** @type {Action} */ (actions.get("export"));
    const leave = h("button", { type: "button", class: "primary", id: "export", title: hint(share), "aria-keyshortcuts": "Control+E", onclick: share.run }, "Export");
    this.buttons.set("export", [leave]);
    byId("bar").append(
      h("div", { class: "group" }, h("img", { src: String(new URL("icon.svg", import.meta.url)), alt: "", width: "26", height: "26" }), h("span", { class: "name" }, "Packwork"), this.title, menu, this.saved),
      h("div", { class: "group", role: "group", "aria-label": "History" }, ...LEFT.map((id) => this.button(id))),
      h("div", { class: "group end", role: "group", "aria-label": "View" }, ...RIGHT.map((id) => this.button(id)), leave),
    );
    this.name = h("span", { class: "chosen-name" });
    this.colour = picker("Give one colour", recolour, chosen);
    byId("choice").append(this.name, ...[...CHOSEN, ...AT_WORK].map((id) => this.button(id)), this.colour.element);
  }

  /** @param {string} id */
  button(id) {
    const action = /** @type {Action} */ (this.actions.get(id));
    const made = button(action.icon ?? "dots", action.label, () => action.run(), { title: hint(action), "data-do": id });
    if (LABELLED.has(id)) made.append(h("span", { class: "label", "aria-hidden": "true" }, action.label));
    this.buttons.set(id, [...(this.buttons.get(id) ?? []), made]);
    return made;
  }

  /**
   * Have a button say something else.
   * @param {string} id
   * @param {string} label
   */
  rename(id, label) {
    for (const one of this.buttons.get(id) ?? []) {
      one.setAttribute("aria-label", label);
      one.querySelector(".label")?.replaceChildren(label);
    }
  }

  /**
   * @param {string} title
   * @param {string} chosen
   * @param {boolean} isSaved
   * @param {string | null} colour of what is chosen, if it has one
   * @param {string} work what the hand is to do now, if that is something of its own
   */
  show(title, chosen, isSaved, colour, work) {
    const shown = work ? AT_WORK : CHOSEN;
    /** @type {HTMLElement} */ (this.colour.element).hidden = Boolean(work);
    this.colour.show(colour ?? "#1f6f78", !colour);
    if (document.activeElement !== this.title) this.title.value = title;
    this.title.size = Math.min(Math.max(title.length, 4), 24);
    this.saved.hidden = !isSaved;
    this.name.textContent = work || chosen;
    byId("choice").hidden = !(work || chosen);
    for (const [id, buttons] of this.buttons) {
      const when = this.actions.get(id)?.when;
      const can = !when || when();
      for (const one of buttons) {
        one.disabled = !can;
        if (one.parentElement?.id === "choice") one.hidden = !(can && shown.includes(id));
        else if (CHOSEN.includes(id)) one.hidden = !can;
      }
    }
  }
}

/** @param {Action} action */
function hint(action) {
  return action.keys.length ? `${action.label} (${shownKey(action.keys[0])})` : action.label;
}
