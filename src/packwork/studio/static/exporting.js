// @ts-check
/** The dialog that makes files of the collage. */

import { h } from "./dom.js";
import { tell } from "./toasts.js";

/** @typedef {import("./connection.js").Connection} Connection */
/** @typedef {import("./collage.js").Collage} Collage */

const FILMED = /** @type {const} */ (["seconds", "film_pixels", "background", "show_container"]);

/** Formats: ending, name, what it is for, which options it has. */
const FORMATS = /** @type {const} */ ([
  ["svg", "SVG", "for the web, Illustrator, Inkscape", ["background", "show_container", "text", "flatten"]],
  ["pdf", "PDF", "for printing", ["background", "show_container", "bleed"]],
  ["png", "PNG", "a picture", ["pixels", "background", "show_container"]],
  ["jpg", "JPEG", "a smaller picture", ["pixels", "background", "show_container"]],
  ["webp", "WebP", "a small picture for the web", ["pixels", "background", "show_container"]],
  ["tif", "TIFF", "a picture for printers", ["pixels", "background", "show_container"]],
  ["dxf", "DXF", "for cutters and CAD, in mm", []],
  ["geojson", "GeoJSON", "outlines, to be measured or edited again", []],
  ["packwork", "Session", "all of it, with all that undo leads to", []],
  ["recipe", "Recipe", "a folder to run again, from the command line or Python", ["lines"]],
  ["film.gif", "Film, GIF", "how all came where it is", FILMED],
  ["film.mp4", "Film, MP4", "the same, for players and posts", FILMED],
  ["film.svg", "Film, SVG", "the same, sharp at any size", FILMED],
]);

export class Exporting {
  /**
   * @param {Connection} connection
   * @param {Collage} collage
   * @param {() => Promise<any>} offers what the studio offers, or null
   */
  constructor(connection, collage, offers) {
    this.connection = connection;
    this.offers = offers;
    this.collage = collage;
    this.kind = "svg";
    this.formats = h("div", { class: "formats", role: "radiogroup", "aria-label": "Format" });
    this.fields = h("div", { class: "fields" });
    this.note = h("p", { class: "note", role: "status" });
    this.go = h("button", { type: "submit", class: "primary" }, "Export");
    const form = h("form", { method: "dialog", onsubmit: (/** @type {Event} */ event) => this.submitted(event) },
      h("h2", {}, "Export"), this.formats, this.fields, this.note,
      h("div", { class: "row end" }, h("button", { type: "button", onclick: () => this.dialog.close() }, "Cancel"), this.go));
    this.dialog = h("dialog", { class: "export", "aria-label": "Export" }, form);
    document.body.append(this.dialog);
    for (const format of FORMATS) this.formats.append(this.choiceOf(format));
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
    this.fields.replaceChildren(...options.map((name) => FIELDS[name]()));
  }

  open() {
    this.choose(this.kind);
    this.note.textContent = this.worth;
    this.note.dataset.is = this.collage.state?.certified ? "good" : "bad";
    this.dialog.showModal();
    this.offers().then((offered) => Object.entries(offered?.missing ?? {}).forEach(([kind, reason]) => this.leaveOut(kind, reason)));
  }

  /** @param {string} kind @param {string} reason */
  leaveOut(kind, reason) {
    const field = this.formats.querySelector(`[value="${kind}"]`);
    if (!(field instanceof HTMLInputElement)) return;
    field.disabled = true;
    const said = field.parentElement?.querySelector("span");
    if (said) said.textContent = reason;
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
    const options = Object.fromEntries([.../** @type {NodeListOf<HTMLInputElement>} */ (this.fields.querySelectorAll("input, select"))].map((field) => [field.name, valueOf(field)]).filter(([, value]) => value !== null));
    this.go.disabled = true;
    [this.note.textContent, this.note.dataset.is] = ["Making the file …", "good"];
    const done = await this.download(this.kind, options);
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
      const body = JSON.stringify({ format: kind, options });
      const answer = await this.connection.ask("/export", { method: "POST", body, headers: { "content-type": "application/json" } });
      save(await answer.blob(), `${this.collage.scene?.title || "collage"}.${endingOf(kind)}`);
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
  film_pixels: () => h("label", {}, "Longer side, px", h("input", { type: "number", name: "film_pixels", value: "800", min: "16", max: "4096", step: "2" })),
  lines: () => h("p", { class: "note" }, "In the folder: ", h("code", {}, "packwork run recipe.toml -o collage.svg"), ", or in Python: ", h("code", {}, 'packwork.run("recipe.toml").save("collage.svg")')),
  pixels: () => h("label", {}, "Longer side, px", h("input", { type: "number", name: "pixels", value: "2400", min: "16", max: "12000", step: "1" })),
  background: () => h("label", {}, "Background", h("input", { type: "text", name: "background", placeholder: "none, white, #faf7f0 …", spellcheck: "false" })),
  show_container: () => h("label", { class: "tick" }, h("input", { type: "checkbox", name: "show_container" }), "Draw the container's line"),
  flatten: () => h("label", { class: "tick" }, h("input", { type: "checkbox", name: "flatten" }), "Repeat drawings in place, for tools that choke on <use>"),
  bleed: () => h("label", {}, "Bleed", h("input", { type: "text", name: "bleed", placeholder: "3mm" })),
};

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
