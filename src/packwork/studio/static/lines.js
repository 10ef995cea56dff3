// @ts-check
/** Lines that words follow: limbs or the edge of the container, texts round it as on a badge. */

import { h, openList } from "./dom.js";
import { kindOf } from "./kinds.js";

/** @typedef {"limbs" | "edge"} Along */

const LINES = /** @type {const} */ ([["", "where there is room"], ["limbs", "along what is long and thin"], ["edge", "along the edge"]]);

export class Lines {
  /** @param {import("./words.js").Words} words */
  constructor(words) {
    this.words = words;
    const change = () => this.change();
    this.along = h("select", { onchange: change, onkeydown: openList }, ...LINES.map(([value, label]) => h("option", { value }, label)));
    const text = (/** @type {string} */ label, /** @type {string} */ example) => h("input", { type: "text", maxlength: "200", placeholder: example, "aria-label": label, onchange: change });
    this.ring = [text("Round the top of the container", "Round the top"), text("Round the bottom of the container", "Round the bottom")];
    this.element = h("section", {}, h("label", { class: "row" }, "Words lie", this.along), ...this.ring.map((one) => h("div", { class: "row" }, one)));
    this.shown = "";
  }

  /** @returns {{along: Along | null, ring: string[]}} */
  get asked() {
    if (this.element.hidden) return { along: null, ring: [] };
    return { along: /** @type {Along} */ (this.along.value) || null, ring: this.ring.map((one) => one.value.trim()).filter(Boolean) };
  }

  /** Have no such texts round the edge. @param {Set<string>} texts */
  leaveOut(texts) {
    this.refresh();
    for (const one of this.ring) if (texts.has(one.value.trim())) one.value = "";
    this.change();
  }

  /** Have the words that are there set so; others come so. */
  change() {
    const { studio, list, font } = this.words;
    if (list.things.length) studio.connection.send({ type: "lines", ...this.asked, font: font.value });
  }

  /** Show what there is, unless something is asked for. */
  refresh() {
    this.element.hidden = !kindOf(this.words.studio.collage).edge;
    const { along = null, ring = [] } = this.words.studio.collage.scene ?? {};
    const now = JSON.stringify([this.words.studio.document, along, ring]);
    if (now === this.shown || this.element.contains(document.activeElement?.closest("input:focus") ?? null)) return;
    this.shown = now;
    this.along.value = along ?? "";
    this.ring.forEach((one, k) => (one.value = ring[k] ?? ""));
  }
}
