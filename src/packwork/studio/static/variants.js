// @ts-check
/** More like this: the same items from other first places, as pictures to be picked from. */

import { h } from "./dom.js";
import { matrixOf } from "./collage.js";

/** @typedef {import("./wire.js").Variant} Variant */

const SIDE = 240;

export class Variants {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    /** @type {Variant[]} */
    this.found = [];
    this.grid = h("div", { class: "grid variants" });
  }

  /** @param {HTMLElement} body */
  fill(body) {
    const ask = h("button", { type: "button", class: "primary", onclick: () => this.ask() }, "Try six others");
    body.replaceChildren(h("p", { class: "hint" }, "The same items in other places. What is held stays. Undo brings the old one back."), h("div", { class: "row" }, ask), this.grid);
  }

  /** Offer none: those that were found are of another document, or others are asked for. */
  clear() {
    this.found = [];
    this.grid.replaceChildren();
  }

  ask() {
    this.clear();
    this.studio.connection.send({ type: "more", seed: Math.floor(Math.random() * 2 ** 29) });
  }

  /** @param {Variant} variant */
  add(variant) {
    this.found.push(variant);
    const share = `${Math.round(1000 * variant.covered) / 10} %`;
    const picture = h("canvas", { width: SIDE, height: SIDE });
    const pick = h("button", { type: "button", class: "choice", "aria-label": `Take number ${this.found.length}, ${share} covered`, onclick: () => this.studio.connection.do(variant.command) }, picture, h("span", {}, share));
    this.grid.append(pick);
    this.draw(picture, variant);
  }

  /** @param {HTMLCanvasElement} picture @param {Variant} variant */
  draw(picture, variant) {
    const { collage, sprites } = this.studio;
    const scene = collage.scene;
    const pen = picture.getContext("2d");
    if (!scene || !pen) return;
    const zoom = SIDE / Math.max(scene.width, scene.height);
    const base = new DOMMatrix().translate((SIDE - zoom * scene.width) / 2, (SIDE - zoom * scene.height) / 2).scale(zoom);
    pen.setTransform(base);
    pen.fillStyle = this.studio.stage.colours.paper;
    pen.fill(new Path2D(scene.outline), "evenodd");
    sprites.begin();
    variant.command.items.forEach((id, k) => {
      const item = collage.item(id);
      if (!item) return;
      const [x, y, degrees, scale] = variant.command.poses[k];
      const look = collage.look(item);
      const [left, top, right, bottom] = look.box;
      pen.setTransform(base.multiply(matrixOf({ x, y, angle: (degrees * Math.PI) / 180, scale }, item.stretch)));
      const sprite = sprites.of(look, look.extent * scale * zoom);
      if (sprite) pen.drawImage(sprite, left, top, right - left, bottom - top);
    });
  }
}
