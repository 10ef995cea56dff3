// @ts-check
/** Lines for people: shown for a while, and read out. */

import { byId, h } from "./dom.js";

/** Seconds that a line stays: at least, and more for each letter, so that it can be read; at most. */
const [LEAST, A_LETTER, LONGEST] = [4, 0.05, 12];
const MOST = 4;

/**
 * Show a line, for as long as it takes to read it, in place of any other about the same; it stays
 * while pointer or focus is on it (WCAG 2.2.1), as its button may be what they are about to press.
 * @param {string} text
 * @param {{isError?: boolean, act?: {label: string, run: () => void}, about?: string}} [more]
 */
export function tell(text, { isError = false, act, about = text } = {}) {
  hush(about);
  const toast = h("div", { class: isError ? "toast error" : "toast", role: isError ? "alert" : "status", "data-about": about }, h("span", {}, text));
  if (act) toast.append(h("button", { type: "button", onclick: () => { act.run(); toast.remove(); } }, act.label));
  toast.append(h("button", { type: "button", class: "close", "aria-label": "Close", onclick: () => toast.remove() }, "×"));
  const list = byId("toasts");
  list.append(toast);
  while (list.children.length > MOST) (list.querySelector(".toast:not(.error, :hover, :focus-within)") ?? list.children[0]).remove();
  const seconds = Math.min(LEAST + A_LETTER * text.length, LONGEST) + (act ? LEAST : 0);
  const end = () => {
    if (toast.matches(":hover, :focus-within")) setTimeout(end, 1000 * LEAST);
    else toast.remove();
  };
  setTimeout(end, 1000 * seconds);
}

/**
 * Take back a line about something, if it is still shown.
 * @param {string} about
 */
export function hush(about) {
  [...byId("toasts").children].find((toast) => toast.getAttribute("data-about") === about)?.remove();
}

/**
 * Say something to screen readers alone.
 * @param {string} text
 */
export function say(text) {
  byId("said").textContent = text;
}
