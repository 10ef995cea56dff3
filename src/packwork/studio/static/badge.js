// @ts-check
/** The one badge that tells how things stand: at work, or ready. */

import { byId, h, icon } from "./dom.js";
import { say } from "./toasts.js";

/** @typedef {import("./wire.js").State} State */

/** How long nothing has to be at work until it is called ready, ms: what is shown is a fiftieth of its way from rest by then. */
const CALM = 150;

export class Badge {
  /** @param {{show: (ids: number[]) => void, stop: () => void}} hears */
  constructor(hears) {
    this.hears = hears;
    this.lamp = h("span", { class: "lamp", "aria-hidden": "true" });
    this.share = h("strong", {}, "–");
    this.word = h("span", { class: "word" }, "connecting");
    this.bar = h("span", { class: "progress", "aria-hidden": "true" });
    this.button = h("button", { type: "button", id: "badge", "data-is": "lost", title: "How things stand", onclick: () => this.open() },
      this.lamp, this.share, this.word, this.bar);
    this.stop = h("button", { type: "button", id: "stop", hidden: true, onclick: () => hears.stop() }, "Stop");
    this.why = h("div", { id: "why", popover: "auto" });
    byId("foot").append(h("div", { class: "badge-row" }, this.button, this.stop), this.why);
    /** @type {State | null} */
    this.state = null;
    this.told = "";
    this.timer = 0;
  }

  /**
   * Show work at once, and that it is over when it has been for a moment.
   * @param {State} state
   */
  show(state) {
    this.state = state;
    const isOver = this.button.dataset.is === "working" && !state.busy;
    if (!isOver) this.paint();
    else this.timer ||= setTimeout(() => this.paint(), CALM);
  }

  paint() {
    clearTimeout(this.timer);
    this.timer = 0;
    const state = /** @type {State} */ (this.state);
    const word = this.wordOf(state);
    this.button.classList.toggle("polishing", state.polishing);
    this.button.dataset.is = state.busy ? "working" : state.certified ? "certified" : "broken";
    this.share.textContent = state.busy ? "Working" : state.covered > 0 ? `${Math.round(1000 * state.covered) / 10} %` : "–";
    this.word.textContent = word;
    this.bar.style.transform = state.progress ? `scaleX(${state.progress})` : "";
    this.stop.hidden = !state.can_stop;
    if (!state.busy && word !== this.told) say(`${this.share.textContent} ${word}`);
    // What was in the way is no longer.
    if (state.certified && word !== this.told && this.why.matches(":popover-open")) this.why.hidePopover();
    this.told = word;
  }

  /** @param {State} state */
  wordOf(state) {
    if (state.busy) return state.busy.toLowerCase() + (state.progress ? ` · ${Math.round(100 * state.progress)} %` : "");
    const unmet = Object.keys(state.unmet).length;
    const without = state.unplaced.length ? ` · ${state.unplaced.length} left out` : unmet ? ` · ${unmet} not as asked` : state.advice.length ? " · a hint" : "";
    if (state.certified) return `covered · certified${without}`;
    const count = state.in_the_way.length;
    return count ? `${count} in the way` : "nothing there";
  }

  open() {
    const state = this.state;
    if (!state) return;
    const lines = state.busy
      ? [h("p", {}, `${this.wordOf(state)}: what comes of it is checked when all lies.`)]
      : state.certified ? [h("p", {}, icon("check"), "Nothing overlaps, nothing sticks out, all gaps are as asked: checked in exact geometry.")]
        : [h("p", {}, "What is in the way:"), h("ul", {}, ...state.in_the_way.map((line) => h("li", {}, line)))];
    const shows = state.entangled.length && h("button", { type: "button", onclick: () => this.hears.show(state.entangled) }, "Show them");
    if (state.unplaced.length) lines.push(h("p", {}, "Left out:"), h("ul", {}, ...state.unplaced.map(({ name, reason }) => h("li", {}, `${name}: ${reason}`))));
    const unmet = Object.values(state.unmet);
    if (unmet.length) lines.push(h("p", {}, "Asked for, and not had:"), h("ul", {}, ...unmet.map((line) => h("li", {}, line))));
    if (state.polishing) lines.push(h("p", {}, "Gaps are closed while you touch nothing, and all stays certified meanwhile."));
    lines.push(...state.advice.map((line) => h("p", {}, line)));
    this.why.replaceChildren(...lines, shows || "");
    this.why.togglePopover?.();
  }

  /** @param {boolean} isOpen */
  connected(isOpen) {
    if (isOpen) return;
    clearTimeout(this.timer);
    this.timer = 0;
    this.button.dataset.is = "lost";
    this.share.textContent = "–";
    this.bar.style.transform = "scaleX(0)";
    this.stop.hidden = true;
    this.word.textContent = "not connected";
  }
}
