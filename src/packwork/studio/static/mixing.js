// @ts-check
/** Words among other items, and the share that they have. */

import { h } from "./dom.js";
import { kindOf } from "./kinds.js";
import { Percent } from "./percent.js";

/** Share of words that is offered first, percent. */
const FIRST = "40";
/** Told before anything is put elsewhere. */
const ANEW = "All are poured anew for it, but what you have put somewhere by hand, or hold (H).";

export class Mixing {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.where = h("select", { "aria-label": "Where the words come", onchange: () => this.refresh() },
      h("option", { value: "" }, "in place of these"), h("option", { value: "beside" }, "beside these"));
    this.share = h("input", { type: "number", id: "words-share", min: "5", max: "95", step: "5", value: FIRST });
    this.asked = h("div", {}, h("label", { class: "row" }, "Share of words, %", this.share), h("p", { class: "hint" }, ANEW));
    this.choice = h("div", {}, h("label", { class: "row" }, "They come", this.where), this.asked);
    this.slider = new Percent("share-of-words", "Share of words", [5, 95], (share) => this.mix(share, {}));
    this.element = h("div", { class: "question" }, this.slider.element, h("p", { class: "hint" }, ANEW));
  }

  /** Weights of words and of all else. */
  get weights() {
    const { items } = this.studio.collage;
    const sum = (/** @type {boolean} */ isWord) => items.reduce((total, one) => total + (one.is_word === isWord ? one.weight : 0), 0);
    return [sum(true), sum(false)];
  }

  /** Whether the next words come beside what is there. */
  get isBeside() {
    return this.where.value === "beside" && this.weights[1] > 0;
  }

  /** Show how things are. */
  refresh() {
    const { collage } = this.studio;
    const [words, others] = this.weights;
    this.choice.hidden = !(kindOf(collage).orders && others);
    this.asked.hidden = !this.isBeside;
    this.element.hidden = !(kindOf(collage).orders && words && others);
    this.slider.show(words / (words + others));
  }

  /** @param {Record<string, any>} words that come more */
  send(words) {
    this.mix(Math.min(Math.max(Number(this.share.value) || Number(FIRST), 1), 99) / 100, words);
  }

  /** @param {number} share @param {Record<string, any>} words */
  mix(share, words) {
    this.studio.connection.send({ type: "mix", share, ...words });
  }
}
