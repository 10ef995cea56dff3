// @ts-check
/** All actions with their keys, to be searched and done. */

import { h } from "./dom.js";
import { shownKey } from "./keys.js";

/** @typedef {import("./actions.js").Action} Action */

export class Palette {
  /** @param {Action[]} actions */
  constructor(actions) {
    this.actions = actions.filter((action) => !action.id.startsWith("nudgeShift"));
    this.field = h("input", { type: "search", placeholder: "What would you like to do?", "aria-label": "Search actions",
      autocomplete: "off", role: "combobox", "aria-expanded": "true", "aria-controls": "palette-list",
      oninput: () => this.fill(), onkeydown: (/** @type {KeyboardEvent} */ event) => this.key(event) });
    this.list = h("div", { id: "palette-list", role: "listbox", "aria-label": "Actions" });
    this.dialog = h("dialog", { class: "palette", "aria-label": "All actions and their keys" }, this.field, this.list);
    this.dialog.addEventListener("click", (event) => event.target === this.dialog && this.dialog.close());
    document.body.append(this.dialog);
    /** @type {Action[]} */
    this.found = [];
    this.at = 0;
  }

  open() {
    if (this.dialog.open) return;
    this.field.value = "";
    this.fill();
    this.dialog.showModal();
    this.field.focus();
  }

  fill() {
    const asked = this.field.value.trim().toLowerCase();
    this.found = this.actions.filter(({ label, group }) => `${group} ${label}`.toLowerCase().includes(asked));
    this.at = Math.max(this.found.findIndex(isPossible), 0);
    const groups = [...new Set(this.found.map((action) => action.group))];
    this.list.replaceChildren(
      ...groups.flatMap((group) => [
        h("h3", { role: "presentation" }, group),
        ...this.found.filter((action) => action.group === group).map((action) => this.row(action)),
      ]),
    );
    if (!this.found.length) this.list.append(h("p", { class: "hint" }, "Nothing is called that."));
    this.mark();
  }

  /** @param {Action} action */
  row(action) {
    const keys = h("span", { class: "keys" }, ...action.keys.map((key) => h("kbd", {}, shownKey(key))));
    return h("div", { role: "option", id: `do-${action.id}`, "aria-disabled": String(!isPossible(action)), onclick: () => this.act(action) },
      h("span", {}, action.label), keys);
  }

  mark() {
    for (const row of this.list.querySelectorAll("[role=option]")) row.setAttribute("aria-selected", "false");
    const action = this.found[this.at];
    const row = action && document.getElementById(`do-${action.id}`);
    row?.setAttribute("aria-selected", "true");
    row?.scrollIntoView({ block: "nearest" });
    this.field.setAttribute("aria-activedescendant", action ? `do-${action.id}` : "");
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step && this.found.length) {
      this.at = (this.at + step + this.found.length) % this.found.length;
      this.mark();
    } else if (event.key === "Enter" && this.found[this.at]) this.act(this.found[this.at]);
    else return;
    event.preventDefault();
  }

  /** @param {Action} action */
  act(action) {
    if (!isPossible(action)) return;
    // What is hidden may keep the focus until the next frame, and with it the keys.
    this.field.blur();
    this.dialog.close();
    action.run();
  }
}

/** @param {Action} action */
function isPossible(action) {
  return !action.when || action.when();
}
