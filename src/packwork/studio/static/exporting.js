// @ts-check
/** The dialog that makes files of the collage. */

import { h } from "./dom.js";
import { grounds } from "./ground.js";
import { kindOf } from "./kinds.js";
import { printFields } from "./printing.js";
import { tell } from "./toasts.js";

/** @typedef {import("./connection.js").Connection} Connection */
/** @typedef {import("./collage.js").Collage} Collage */

const FILMED = /** @type {const} */ (["seconds", "film_ratio", "film_pixels", "loop", "background", "show_container"]);

/** Formats: ending, name, what it is for, which options it has. */
const FORMATS = /** @type {const} */ ([
  ["svg", "SVG", "for the web, Illustrator, Inkscape", ["tiles", "background", "margin", "show_container", "text", "flatten", "print"]],
  ["pdf", "PDF", "for printing", ["tiles", "background", "margin", "show_container", "text", "bleed", "print"]],
  ["png", "PNG", "a picture", ["pixels", "tiles", "background", "margin", "show_container", "print"]],
  ["packwork", "Session", "all of it, with all that undo leads to", []],
  ["jpg", "JPEG", "a smaller picture", ["pixels", "tiles", "background", "margin", "show_container"]],
  ["webp", "WebP", "a small picture for the web", ["pixels", "tiles", "background", "margin", "show_container"]],
  ["tif", "TIFF", "a picture for printers", ["pixels", "tiles", "background", "margin", "show_container", "print"]],
  ["dxf", "DXF", "for cutters and CAD, in mm", []],
  ["geojson", "GeoJSON", "outlines, to be measured or edited again", []],
  ["recipe", "Recipe", "a folder to run again, from the command line or Python", ["lines"]],
  ["film.gif", "Film, GIF", "how all came where it is", FILMED],
  ["film.mp4", "Film, MP4", "the same, for players and posts", FILMED],
  ["film.svg", "Film, SVG", "the same, sharp at any size", FILMED],
]);

/** Proportions of films. */
const RATIOS = [["canvas", "those of the canvas"], ["1:1", "1:1, a square"], ["4:5", "4:5, a post"], ["9:16", "9:16, a phone upright"], ["16:9", "16:9, a screen"]];

/** Those on nothing, where no background is asked for. */
const CLEAR = new Set(["svg", "pdf"]);

/** How many of them stand first; the others are a press away. */
const FIRST = 4;

/** Sizes of pictures by what they are for: longer side in pixels. */
const SIZES = /** @type {const} */ ([
  ["for the screen", 2400], ["Instagram, square", 1080], ["Story, 9 : 16", 1920], ["4K", 3840],
  ["A5, 300 dpi", 2480], ["A4, 300 dpi", 3508], ["A3, 300 dpi", 4961],
]);

/** Free edges all round, as shares of the longer side. */
const MARGINS = /** @type {const} */ ([["", "none"], ["2%", "narrow"], ["5%", "as of a print"], ["12%", "as of a passe-partout"]]);

/** How many tiles each way, of canvases that repeat. */
const TILES = /** @type {const} */ ([["", "one, which repeats by itself"], ["2", "2 × 2"], ["3", "3 × 3, as a preview"], ["5", "5 × 5"]]);

/** What has no meaning for some kinds of documents: places of parts on a sheet are a machine's, and a tile has no edge. @type {Record<string, Set<string>>} */
const NOT_OF = { nest: new Set(["margin"]), tile: new Set(["margin", "show_container", "flatten", "bleed"]) };

/** Formats of what has an edge. */
const OF_EDGES = ["dxf", "film.gif", "film.mp4", "film.svg"];

/** Longer side of the preview, in pixels; how long the form has to be still for a new one. */
const PREVIEW = 900, STILL_MS = 350;

export class Exporting {
  /**
   * @param {Connection} connection
   * @param {Collage} collage
   * @param {import("./dropping.js").Dropping} dropping
   * @param {() => Promise<any>} offers what the studio offers, or null
   */
  constructor(connection, collage, dropping, offers) {
    this.connection = connection;
    this.dropping = dropping;
    this.offers = offers;
    this.collage = collage;
    this.kind = "svg";
    this.asked = this.timer = 0;
    const [first, others] = [FORMATS.slice(0, FIRST), FORMATS.slice(FIRST)].map((some) => h("div", { class: "formats" }, ...some.map((format) => this.choiceOf(format))));
    this.more = h("details", {}, h("summary", {}, "More formats"), others);
    this.formats = h("div", { role: "radiogroup", "aria-label": "Format" }, first, this.more);
    this.fields = h("div", { class: "fields", oninput: () => this.changed() });
    this.preview = h("img", { alt: "The picture that is exported" });
    this.note = h("p", { class: "note", role: "status" });
    this.go = h("button", { type: "submit", class: "primary" }, "Export");
    const form = h("form", { method: "dialog", onsubmit: (/** @type {Event} */ event) => this.submitted(event) },
      h("h2", {}, "Export"), h("div", { class: "shown" }, this.preview), h("div", { class: "asked" }, this.formats, this.fields, this.note),
      h("div", { class: "row end" }, h("button", { type: "button", onclick: () => this.dialog.close() }, "Cancel"), this.go));
    this.dialog = h("dialog", { class: "export", "aria-label": "Export" }, form);
    document.body.append(this.dialog);
  }

  /** @param {typeof FORMATS[number]} format */
  choiceOf([ending, name, what]) {
    const field = h("input", { type: "radio", name: "format", value: ending, checked: ending === this.kind, onchange: () => this.choose(ending) });
    return h("label", { class: "format" }, field, h("strong", {}, name), h("span", {}, what));
  }

  /** @param {string} kind */
  choose(kind) {
    this.kind = kind;
    const options = FORMATS.find(([ending]) => ending === kind)?.[3] ?? [];
    const { kind: of = "collage" } = this.collage.scene ?? {};
    const shown = options.filter((name) => (name === "tiles") === (of === "tile") || !(name === "tiles" || NOT_OF[of]?.has(name)));
    this.fields.replaceChildren(...shown.map((name) => (name === "print" ? printFields(kind, this.dropping) : FIELDS[name]())));
    this.changed();
  }

  /** Show what is exported, once the form has been still for a moment. */
  changed() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.show(), this.preview.src ? STILL_MS : 0);
  }

  async show() {
    const asked = ++this.asked;
    // What is drawn on nothing, where no background is asked for, is shown so.
    const isClear = CLEAR.has(this.kind) && !this.collage.scene?.ground;
    const { background = isClear ? "none" : null, show_container = null, margin = null, tiles = null } = /** @type {Record<string, any>} */ (this.options);
    const options = Object.fromEntries(Object.entries({ background, show_container, margin, tiles, pixels: PREVIEW }).filter(([, value]) => value !== null));
    this.dialog.setAttribute("aria-busy", "true");
    const made = await this.make("png", options).catch(() => null);
    if (asked !== this.asked) return;
    this.dialog.removeAttribute("aria-busy");
    // What is wrong with the form is said when it is sent.
    if (!made || !this.dialog.open) return;
    URL.revokeObjectURL(this.preview.src);
    this.preview.src = URL.createObjectURL(made);
  }

  get options() {
    const fields = /** @type {NodeListOf<HTMLInputElement>} */ (this.fields.querySelectorAll("[name]"));
    return Object.fromEntries([...fields].filter((field) => !field.disabled).map((field) => [field.name, valueOf(field)]).filter(([, value]) => value !== null));
  }

  /** @param {string} kind @param {Record<string, any>} options */
  async make(kind, options) {
    const body = JSON.stringify({ format: kind, options });
    return (await this.connection.ask("/export", { method: "POST", body, headers: { "content-type": "application/json" } })).blob();
  }

  open() {
    // What it was before is no picture of it.
    URL.revokeObjectURL(this.preview.src);
    this.preview.removeAttribute("src");
    this.note.textContent = this.worth;
    this.note.dataset.is = this.collage.state?.certified ? "good" : "bad";
    this.dialog.showModal();
    /** @type {HTMLElement | null} */ (this.formats.querySelector(":checked"))?.focus();
    this.choose(this.kind);
    const has = kindOf(this.collage).edge;
    for (const kind of OF_EDGES) this.leaveOut(kind, has ? "" : "a tile goes on over its edge");
    this.offers().then((offered) => Object.entries(offered?.missing ?? {}).forEach(([kind, reason]) => this.leaveOut(kind, reason)));
  }

  /** @param {string} kind @param {string} reason empty where it may be asked for */
  leaveOut(kind, reason) {
    const field = this.formats.querySelector(`[value="${kind}"]`);
    if (!(field instanceof HTMLInputElement)) return;
    field.disabled = Boolean(reason);
    const said = field.parentElement?.querySelector("span");
    if (said) said.textContent = reason || (FORMATS.find(([ending]) => ending === kind)?.[2] ?? "");
  }

  get worth() {
    const state = this.collage.state;
    if (!state || state.moving) return "It is still settling; the file is made when it lies.";
    if (state.certified) return "Certified: nothing overlaps, nothing sticks out.";
    return `Not certified: ${state.in_the_way.slice(0, 3).join("; ")}`;
  }

  /** @param {Event} event */
  async submitted(event) {
    event.preventDefault();
    this.go.disabled = true;
    [this.note.textContent, this.note.dataset.is] = ["Making the file …", "good"];
    const done = await this.download(this.kind, this.options);
    this.go.disabled = false;
    if (done) this.dialog.close();
  }

  /**
   * Make a file and hand it to the person; whether that went well.
   * @param {string} kind
   * @param {Record<string, any>} options
   */
  async download(kind, options) {
    try {
      save(await this.make(kind, options), `${this.collage.scene?.title || "collage"}.${endingOf(kind)}`);
      tell(`${FORMATS.find(([ending]) => ending === kind)?.[1] ?? kind} exported`);
      return true;
    } catch (error) {
      const line = /** @type {Error} */ (error).message;
      if (this.dialog.open) [this.note.textContent, this.note.dataset.is] = [line, "bad"];
      else tell(line, { isError: true });
      return false;
    }
  }
}

/**
 * Ending of a file.
 * @param {string} kind
 */
function endingOf(kind) {
  return kind === "recipe" ? "zip" : kind.replace("film.", "");
}

const FIELDS = {
  text: () => h("label", {}, "Words", h("select", { name: "text" }, h("option", { value: "outlines" }, "as outlines"), h("option", { value: "live" }, "as text that can be selected"))),
  seconds: () => h("label", {}, "Seconds", h("input", { type: "number", name: "seconds", value: "5", min: "1", max: "60", step: "1" })),
  film_ratio: () => h("label", {}, "Proportions", h("select", { name: "film_ratio" }, ...RATIOS.map(([value, label]) => h("option", { value }, label)))),
  film_pixels: () => h("label", {}, "Longer side, px", h("input", { type: "number", name: "film_pixels", value: "800", min: "16", max: "4096", step: "2" })),
  lines: () => h("p", { class: "note" }, "In the folder: ", h("code", {}, "packwork run recipe.toml -o collage.svg"), ", or in Python: ", h("code", {}, 'packwork.run("recipe.toml").save("collage.svg")')),
  pixels: sizes,
  background: ground,
  tiles: () => h("label", {}, "Tiles side by side", h("select", { name: "tiles" }, ...TILES.map(([value, label]) => h("option", { value }, label)))),
  margin: () => h("label", {}, "Free edge", h("select", { name: "margin" }, ...MARGINS.map(([value, label]) => h("option", { value }, label)))),
  loop: () => h("label", {}, "At its end", h("select", { name: "loop" }, h("option", { value: "again" }, "it begins again"), h("option", { value: "back" }, "it goes back the way it came"), h("option", { value: "cycle" }, "it glides to its beginning"), h("option", { value: "once" }, "it stays"))),
  show_container: () => h("label", { class: "tick" }, h("input", { type: "checkbox", name: "show_container" }), "Draw the container's line"),
  flatten: () => h("label", { class: "tick" }, h("input", { type: "checkbox", name: "flatten" }), "Repeat drawings in place, for tools that choke on <use>"),
  bleed: () => h("label", {}, "Bleed", h("input", { type: "text", name: "bleed", placeholder: "3mm" })),
};

/** Longer side in pixels, by name or by number. */
function sizes() {
  const field = h("input", { type: "number", name: "pixels", value: String(SIZES[0][1]), min: "16", max: "12000", step: "1", "aria-label": "Longer side, px" });
  const named = h("select", { "aria-label": "Size by name", onchange: () => { if (named.value) field.value = named.value; } },
    ...SIZES.map(([name, pixels]) => h("option", { value: String(pixels) }, name)), h("option", { value: "" }, "another"));
  field.addEventListener("input", () => { named.value = SIZES.some(([, pixels]) => String(pixels) === field.value) ? field.value : ""; });
  return h("div", { class: "row" }, h("span", {}, "Longer side, px"), named, field);
}

function ground() {
  const field = h("input", { type: "text", name: "background", placeholder: "or any colour", spellcheck: "false", "aria-label": "Background" });
  const press = (/** @type {string} */ colour) => { field.value = colour; field.dispatchEvent(new Event("input", { bubbles: true })); };
  return h("div", { class: "row" }, h("span", {}, "Background"),
    ...grounds(press), field);
}

/** @param {HTMLInputElement} field */
function valueOf(field) {
  if (field.type === "checkbox") return field.checked || null;
  if (field.type === "number") return Number(field.value) || null;
  return field.value.trim() || null;
}

/** @param {Blob} blob @param {string} name */
function save(blob, name) {
  const link = h("a", { href: URL.createObjectURL(blob), download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}
