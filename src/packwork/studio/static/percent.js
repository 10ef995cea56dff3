// @ts-check
/** A slider of a share, which asks once it is still and shows what then comes of it. */

import { h } from "./dom.js";

/** How long it is still until it asks, ms: each step of a key would be a run. */
const STILL_MS = 250;

export class Percent {
  /**
   * @param {string} id
   * @param {string} label
   * @param {[number, number]} range least and most, percent
   * @param {(share: number) => void} ask
   */
  constructor(id, label, range, ask) {
    /** Of what is asked for once the slider is still; 0 where nothing is. */
    this.timer = 0;
    /** What was asked for and is not there yet, percent. @type {number | null} */
    this.wanted = null;
    this.shown = h("output", {});
    const changed = () => {
      clearTimeout(this.timer);
      const wanted = (this.wanted = Number(this.field.value));
      this.timer = setTimeout(() => {
        this.timer = 0;
        ask(wanted / 100);
      }, STILL_MS);
    };
    this.field = h("input", { type: "range", id, "aria-label": label, min: range[0], max: range[1], step: "5", onchange: changed,
      oninput: () => (this.shown.textContent = `${this.field.value} %`) });
    this.element = h("label", { for: id }, h("span", { class: "asked" }, h("strong", {}, label), this.shown), this.field);
  }

  /** What was asked for is not to be had; what was not asked for yet is not meant. */
  refused() {
    if (!this.timer) this.wanted = null;
  }

  /** Show what there is, unless something else was asked for just now. @param {number} share */
  show(share) {
    const percent = Math.round(100 * share);
    if (this.timer || this.field.matches(":active") || (this.wanted !== null && percent !== this.wanted)) return;
    this.wanted = null;
    this.field.value = String(percent);
    this.shown.textContent = `${percent} %`;
  }
}
