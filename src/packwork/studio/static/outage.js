// @ts-check
/** The banner while nothing of the studio is to be reached: what has happened, and what to do. */

import { byId, h } from "./dom.js";

/** How long it is waited whether the studio comes back by itself, ms: a reload takes less. */
const GRACE = 1500;

export class Outage {
  constructor() {
    this.element = byId("outage");
    this.timer = 0;
    this.isStranger = false;
  }

  /**
   * @param {boolean} isStranger whether something answers at this address that is not the studio of this page
   * @param {boolean} isTaken whether the studio is there, and another person in it
   */
  tell(isStranger, isTaken) {
    if (isTaken) return this.over();
    const isNews = isStranger !== this.isStranger;
    this.isStranger = isStranger;
    if (!this.element.hidden && isNews) this.show();
    this.timer ||= setTimeout(() => this.show(), GRACE);
  }

  show() {
    const lines = this.isStranger
      ? ["This page is not of the studio that runs here", "Open the address that ", "packwork studio", " has printed in its terminal."]
      : ["The studio has stopped", "What you did is kept. Start it again with ", "packwork studio --again", ", or with the file that you had opened: this page then goes on by itself."];
    const [title, before, command, after] = lines;
    this.element.replaceChildren(h("strong", {}, title), h("p", {}, before, h("code", {}, command), after));
    this.element.hidden = false;
  }

  over() {
    clearTimeout(this.timer);
    this.timer = 0;
    this.element.hidden = true;
  }
}
