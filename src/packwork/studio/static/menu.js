// @ts-check
/** The menu at the pointer. */

import { h } from "./dom.js";
import { shownKey } from "./keys.js";

/** @typedef {import("./actions.js").Action} Action */

const OF_ITEMS = ["inspect", "hold", "release", "middle", "copy", "cut", "paste", "duplicate", "flip", "flip-down", "crop", "replace", "exchange", "remove", "alike", "chosen"];
const OF_FILES = ["new", "add", "folder", "rename", "save", "export"];
const OF_NOTHING = ["paste", "add", "folder", "room", "all", "lasso", "pour", "fit", "export"];

export class Menu {
  /** @param {Map<string, Action>} actions */
  constructor(actions) {
    this.actions = actions;
    // Closed by itself: an "auto" popover that opens at a press is closed by the letting go.
    this.element = h("div", { class: "menu", role: "menu", popover: "manual", "aria-label": "What can be done",
      onkeydown: (/** @type {KeyboardEvent} */ event) => this.key(event) });
    document.body.append(this.element);
    /** What has the focus again when the menu closes. @type {Element | null} */
    this.before = null;
    this.element.addEventListener("beforetoggle", () => this.passFocus());
    addEventListener("pointerdown", (event) => {
      if (!event.composedPath().includes(this.element)) this.element.hidePopover();
    }, true);
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {boolean} isOfItems
   */
  open(x, y, isOfItems) {
    this.show(isOfItems ? OF_ITEMS : OF_NOTHING, x, y);
  }

  /**
   * Open with what can be done with documents.
   * @param {number} x
   * @param {number} y
   */
  openFiles(x, y) {
    this.show(OF_FILES, x, y);
  }

  /**
   * @param {string[]} ids
   * @param {number} x
   * @param {number} y
   */
  show(ids, x, y) {
    const actions = ids.map((id) => /** @type {Action} */ (this.actions.get(id)));
    this.element.replaceChildren(...actions.filter((one) => !one.when || one.when()).map((one) => this.row(one)));
    this.element.showPopover();
    const { offsetWidth, offsetHeight } = this.element;
    this.element.style.left = `${Math.max(Math.min(x, innerWidth - offsetWidth - 8), 8)}px`;
    this.element.style.top = `${Math.max(Math.min(y, innerHeight - offsetHeight - 8), 8)}px`;
    /** @type {HTMLElement | null} */ (this.element.firstElementChild)?.focus();
  }

  /** @param {Action} action */
  row(action) {
    return h("button", { type: "button", role: "menuitem", onclick: () => { this.element.hidePopover(); action.run(); } },
      h("span", {}, action.label), h("kbd", {}, shownKey(action.keys[0])));
  }

  /** Keep what has the focus as the menu opens, and give it back as it closes. */
  passFocus() {
    const focused = document.activeElement;
    if (!this.element.contains(focused)) this.before = focused;
    else if (this.before instanceof HTMLElement) this.before.focus();
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    if (event.key === "Escape" || event.key === "Tab") this.element.hidePopover();
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const rows = [...this.element.querySelectorAll("button")];
    const at = rows.indexOf(/** @type {HTMLButtonElement} */ (document.activeElement));
    rows[(at + step + rows.length) % rows.length].focus();
  }
}
