// @ts-check
/** The panels at the side, and the one of containers. */

import { byId, button, h, icon, openList, vector } from "./dom.js";
import { FontField } from "./fonts.js";
import { ItemList } from "./items.js";
import { kindOf } from "./kinds.js";
import { Look } from "./look.js";
import { fillOptions, refreshOptions } from "./options.js";
import { tell } from "./toasts.js";
import { Repeating } from "./repeating.js";
import { Words } from "./words.js";

/** Sheets by the names that the command line has. */
const SHEETS = ["A3", "A4", "A4-landscape", "A5", "A6", "letter", "letter-landscape", "600x600px"];
const OTHER = "other";

/** @typedef {import("./studio.js").Studio} Studio */

export const PANELS = /** @type {const} */ ([
  ["room", "shape", "Container"], ["items", "items", "Items"], ["words", "words", "Words"], ["options", "options", "Options"], ["more", "more", "Variants"], ["look", "colour", "Colours"],
]);

export class Panels {
  /** @param {Studio} studio */
  constructor(studio) {
    this.studio = studio;
    this.panel = byId("panel");
    this.current = "";
    /** @type {any} */
    this.choices = null;
    this.items = new ItemList(studio);
    this.words = new Words(studio);
    this.look = new Look(studio);
    this.repeating = new Repeating(studio);
    this.roomFont = new FontField(studio, "Font");
    for (const [id, name, label] of PANELS) {
      byId("tabs").append(h("button", { type: "button", id: `tab-${id}`, "aria-pressed": "false", title: label, onclick: () => this.toggle(id) }, icon(name), h("span", {}, label)));
    }
  }

  /**
   * Open a panel and give it the focus; close it if it has it.
   * @param {string} id
   */
  async goTo(id) {
    if (this.current !== id || this.panel.contains(document.activeElement)) await this.toggle(id);
    const fields = /** @type {NodeListOf<HTMLElement> | undefined} */ (this.body?.querySelectorAll("button, input, select, textarea"));
    const first = this.current ? [...(fields ?? [])].find((one) => one.checkVisibility()) : this.studio.canvas;
    first?.focus();
  }

  /** @param {string} id */
  async toggle(id) {
    this.current = this.current === id ? "" : id;
    for (const [one] of PANELS) byId(`tab-${one}`).setAttribute("aria-pressed", String(one === this.current));
    this.panel.hidden = !this.current;
    document.body.classList.toggle("with-panel", Boolean(this.current));
    await this.fill();
    this.studio.resized();
  }

  /** What was asked for last is not to be had: sliders show what there is. */
  refused() {
    for (const slider of [this.words.mixing.slider, this.look.mosaic.likeness]) slider.refused();
    this.items.refused();
    this.words.font.refused();
    this.words.list.listed = "";
    this.studio.dropping.sheet = null;
    this.refresh();
  }

  async fill() {
    if (!this.current) return;
    const label = PANELS.find(([id]) => id === this.current)?.[2] ?? "";
    const close = button("close", "Close the panel", () => this.toggle(this.current), { class: "close" });
    this.body = h("div", { class: "body" });
    this.panel.replaceChildren(h("div", { class: "head" }, h("h2", {}, label), close), this.body);
    await this.fillBody(this.body);
  }

  /**
   * What is there at once is shown at once; what is bundled follows into its place, so that the focus stays.
   * @param {HTMLElement} body
   */
  async fillBody(body) {
    if (this.current === "room") this.fillRoom(body);
    if (this.current === "items") this.items.fill(body);
    if (this.current === "words") this.words.fill(body);
    if (this.current === "options") fillOptions(body, this.studio, (await this.load())?.options ?? []);
    if (this.current === "more") this.studio.variants.fill(body);
    if (this.current === "look") this.look.fill(body);
  }

  /** What is bundled, and what can be asked for; asked of the studio once. */
  async load() {
    try {
      this.choices ??= await (await this.studio.connection.ask("/choices")).json();
      return this.choices;
    } catch (error) {
      // While the studio is gone a banner says so.
      if (this.studio.connection.isOpen) tell(/** @type {Error} */ (error).message, { isError: true });
      return null;
    }
  }

  /** Bring the panel up to what there is. */
  refresh() {
    if (this.current === "items") this.items.refresh();
    this.studio.forces.refresh();
    if (this.current === "options" && this.body) refreshOptions(this.body, this.studio, this.choices?.options ?? []);
    if (this.current === "words") this.words.refresh();
    if (this.current === "look") this.look.refresh();
    const name = this.studio.collage.scene?.name;
    if (this.current === "room") {
      this.repeating.refresh();
      for (const one of this.panel.querySelectorAll(".of-edges")) one.toggleAttribute("hidden", !kindOf(this.studio.collage).edge);
      const sheet = /** @type {HTMLSelectElement | null} */ (this.panel.querySelector("[aria-label=Sheet]"));
      if (sheet) {
        sheet.options[0].textContent = this.sheets()[0][1];
        // A size of one's own is shown once it is there.
        sheet.value = SHEETS.find((one) => one === this.studio.dropping.sheet) ?? "";
      }
      this.panel.querySelector(".edit-room")?.setAttribute("aria-pressed", String(this.studio.room.isOn));
      for (const one of this.panel.querySelectorAll(".grid .choice")) one.setAttribute("aria-pressed", String(one.getAttribute("aria-label") === name));
    }
  }

  /** Sheets that can be asked for, that of now first. @returns {[string, string][]} */
  sheets() {
    const scene = this.studio.collage.scene;
    const round = (/** @type {number} */ side) => Number(side.toPrecision(4));
    const now = scene ? `${round(scene.width)} × ${round(scene.height)} ${scene.unit}` : "as it is";
    return [["", now], ...SHEETS.map((one) => /** @type {[string, string]} */ ([one, one.replace("-", " ")])), [OTHER, "another size …"]];
  }

  /**
   * Have the container on another sheet.
   * @param {string} asked
   */
  resheet(asked) {
    const size = asked === OTHER ? prompt("Width and height with a unit, as 300x200mm or 12x9in", "300x200mm") : asked;
    if (!size) return this.refresh();
    this.studio.dropping.sheet = size;
    this.repeating.opened();
    const tile = this.repeating.now;
    this.studio.connection.send({ type: "room", source: tile ? "page" : "same", canvas: size, tile });
  }

  /** @param {HTMLElement} body */
  fillRoom(body) {
    const { connection, dropping } = this.studio;
    const word = h("input", { type: "text", id: "word", maxlength: "60", placeholder: "HELLO", "aria-label": "Word to fill" });
    const fill = () => word.value.trim() && connection.send({ type: "room", source: `text:${word.value.trim()}`, font: this.roomFont.value, canvas: dropping.sheet });
    const grid = h("div", { class: "grid" });
    const names = h("input", { type: "checkbox", checked: dropping.names, title: "Of a map in GeoJSON, or titles or ids of the shapes of an SVG", onchange: () => (dropping.names = names.checked) });
    const edit = h("button", { type: "button", class: "edit-room", "aria-pressed": String(this.studio.room.isOn), onclick: () => this.studio.editRoom() }, icon("shape"), "Edit its outline");
    const draw = (/** @type {string} */ label, /** @type {boolean} */ isHole) => h("button", { type: "button", onclick: () => this.studio.sketch.begin(isHole) }, icon("pencil"), label);
    const sheet = h("select", { "aria-label": "Sheet", onchange: () => this.resheet(sheet.value), onkeydown: openList }, ...this.sheets().map(([value, label]) => h("option", { value }, label)));
    body.replaceChildren(
      h("div", { class: "drop-here", "data-drops": "room" }, h("p", {}, "Drop an SVG or a picture on the page, or choose one. Dark is inside."),
        h("button", { type: "button", onclick: () => dropping.chooseRoom() }, "Choose a file"),
        h("label", { class: "row center" }, names, "Write the names of its parts")),
      h("div", { class: "row of-edges" }, edit), h("div", { class: "row halves of-edges" }, draw("Draw one", false), draw("A hole", true)),
      h("label", { class: "row" }, "Sheet", sheet), ...this.repeating.elements,
      h("form", { onsubmit: (/** @type {Event} */ event) => { event.preventDefault(); fill(); } },
        h("div", { class: "row" }, word, h("button", { type: "submit" }, "Fill a word")), this.roomFont.element),
      h("h3", {}, "Bundled"), grid);
    this.roomFont.fill();
    this.load().then((choices) => {
      grid.replaceChildren(...(choices?.containers ?? []).map((/** @type {any} */ one) =>
        h("button", { type: "button", class: "choice", title: one.name, "aria-label": one.name, onclick: () => connection.send({ type: "room", source: `builtin:${one.name}`, canvas: dropping.sheet }) }, picture(one))));
      this.refresh();
    });
    this.refresh();
  }
}

/** @param {{path: string, box: number[]}} one */
function picture(one) {
  const [left, top, right, bottom] = one.box;
  return vector(`${left} ${top} ${right - left} ${bottom - top}`, one.path);
}
