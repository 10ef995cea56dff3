// @ts-check
/** The picture that items show from afar: its likeness, and the question what a picture is for. */

import { h } from "./dom.js";
import { kindOf } from "./kinds.js";
import { Percent } from "./percent.js";

/** @typedef {"mosaic" | "colours" | "behind"} Purpose */

export class Mosaic {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.likeness = new Percent("likeness", "Likeness", [0, 100], (tint) => studio.connection.do({ kind: "mosaic", tint }));
    this.choose = h("button", { type: "button", onclick: () => studio.dropping.choosePicture() });
    this.slider = h("div", { class: "question" },
      this.likeness.element,
      h("p", { class: "hint" }, "How far items take on the colours of the picture where they lie. Pour anew (R) puts each where it shows it best; their own colours, below, end the mosaic."));
    this.element = h("section", { "aria-label": "Mosaic" }, h("h3", {}, "Mosaic"), h("div", { class: "row" }, this.choose), this.slider);
  }

  /** How far items take on the picture's colours; null without one. */
  get now() {
    return this.studio.collage.scene?.likeness ?? null;
  }

  get isOn() {
    return this.now !== null;
  }

  /** Show how things are. */
  refresh() {
    const { collage } = this.studio;
    const likeness = this.now;
    this.element.hidden = !kindOf(collage).orders;
    this.slider.hidden = likeness === null;
    this.choose.textContent = likeness === null ? "Show a picture by their colours …" : "Another picture …";
    if (likeness !== null) this.likeness.show(likeness);
  }
}

/** What becomes of one picture that was dropped: asked of the person. */
export class PictureQuestion {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.title = h("h2", {});
    /** @type {File[]} */
    this.files = [];
    this.dialog = h("dialog", { class: "asking", "aria-label": "What the picture is for" }, this.title,
      h("div", { class: "stack" },
        this.answer("A photograph", "one item more among the others", (batch) => studio.dropping.bring(batch), "primary"),
        this.answer("The picture of a mosaic", "the items show it from afar", (batch) => studio.dropping.show(batch, "mosaic")),
        this.answer("Its colours", "as a palette, on all items", (batch) => studio.dropping.show(batch, "colours")),
        this.answer("The background", "it covers the sheet behind all", (batch) => studio.dropping.show(batch, "behind"))),
      h("div", { class: "row end" }, h("button", { type: "button", onclick: () => this.dialog.close() }, "Cancel")));
    document.body.append(this.dialog);
  }

  /** @param {string} label @param {string} what @param {(batch: string) => void} then @param {string} [look] */
  answer(label, what, then, look = "") {
    const act = () => {
      this.dialog.close();
      this.studio.dropping.send(this.files, then);
    };
    return h("button", { type: "button", class: look, onclick: act }, h("strong", {}, label), h("span", {}, what));
  }

  /** Ask, of a picture beside what is there. @param {File} file */
  ask(file) {
    this.files = [file];
    this.title.textContent = `What is ${file.name}?`;
    this.dialog.showModal();
  }
}

/** Whether a file is a picture that may be for several things. @param {File} file */
export function isPicture(file) {
  return file.type.startsWith("image/") && !file.type.includes("svg");
}
