// @ts-check
/** Small pictures of items. */

import { h, vector } from "./dom.js";

/** @typedef {{key: string, svg: string, ink: string, fill: string, box: number[]}} Drawn */

const SIDE = 40;

/** @type {Map<string, string>} */
const URLS = new Map();

/** @param {string[]} keys of looks that are not there any more */
export function forgetThumbs(keys) {
  for (const key of keys) {
    URL.revokeObjectURL(URLS.get(key) ?? "");
    URLS.delete(key);
  }
}

/**
 * A small picture of an item: never markup in our own document.
 * @param {Drawn} look
 */
export function thumbOf(look) {
  const [left, top, right, bottom] = look.box;
  if (!look.svg) {
    const drawn = vector(`${left} ${top} ${right - left} ${bottom - top}`, look.ink);
    drawn.classList.add("thumb");
    drawn.querySelector("path")?.setAttribute("fill", look.fill);
    return drawn;
  }
  if (!URLS.has(look.key)) URLS.set(look.key, URL.createObjectURL(new Blob([look.svg], { type: "image/svg+xml" })));
  return h("img", { class: "thumb", src: URLS.get(look.key), alt: "", width: SIDE, height: SIDE, loading: "lazy" });
}
