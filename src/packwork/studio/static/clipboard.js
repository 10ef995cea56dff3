// @ts-check
/** Copy, cut and paste: exactly within this studio, elsewhere as drawings that are read like any file. */

import { matrixOf } from "./collage.js";
import { isTyping } from "./keys.js";
import { tell } from "./toasts.js";

/** What other pages of ours know a copy by. */
const OURS = "application/x-packwork";
/** Drawings of another studio that are taken at most. */
const MOST = 200;
const SPACE = "http://www.w3.org/2000/svg";

export class Clipboard {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    /** Where the pointer is over the canvas, px. @type {{x: number, y: number} | null} */
    this.pointer = null;
    /** What this page has copied last. */
    this.last = { token: "", drawings: /** @type {[string, string][]} */ ([]) };
    studio.canvas.addEventListener("pointermove", (event) => (this.pointer = { x: event.offsetX, y: event.offsetY }));
    studio.canvas.addEventListener("pointerleave", () => (this.pointer = null));
    document.addEventListener("copy", (event) => this.copied(event));
    document.addEventListener("cut", (event) => this.copied(event) && studio.remove());
    document.addEventListener("paste", (event) => this.pasted(event));
  }

  /** Whether an event is about items: not about a field, a dialog or text that is marked. @param {Event} event */
  isOurs(event) {
    return !isTyping(event) && !document.querySelector("dialog[open]") && !String(getSelection());
  }

  /** @param {ClipboardEvent} event */
  copied(event) {
    const ids = [...this.studio.choice.ids];
    if (!this.isOurs(event) || !ids.length || !event.clipboardData) return false;
    event.preventDefault();
    const token = crypto.randomUUID();
    const { collage, connection } = this.studio;
    /** @type {[string, string][]} */
    const drawings = ids.map((id) => [collage.item(id)?.name ?? "item", this.drawing([id])]);
    this.last = { token, drawings };
    connection.send({ type: "copy", items: ids, token });
    if (collage.state) collage.state.clip = token;
    event.clipboardData.setData(OURS, JSON.stringify(this.last));
    event.clipboardData.setData("text/plain", this.drawing(ids));
    return true;
  }

  /** @param {ClipboardEvent} event */
  pasted(event) {
    const data = event.clipboardData;
    if (!this.isOurs(event) || !data) return;
    event.preventDefault();
    const files = [...data.files];
    if (files.length) return this.studio.dropping.takes(files);
    const copied = known(data.getData(OURS));
    if (copied.drawings.length) this.put(copied);
    else this.readText(data.getData("text/plain"));
  }

  /**
   * Put in what a page of ours has copied: as it was, where this studio holds it still.
   * @param {{token: string, drawings: [string, string][]}} copied
   */
  put({ token, drawings }) {
    if (token === this.studio.collage.state?.clip) this.paste();
    else this.read(drawings);
  }

  /** Put in what this studio holds: at the pointer, or where it was. */
  paste() {
    const { choice, connection, collage, view } = this.studio;
    choice.expect(collage.rows);
    const at = this.pointer && view.toCanvas(this.pointer.x, this.pointer.y);
    connection.send({ type: "paste", x: at?.x ?? null, y: at?.y ?? null });
  }

  /** Have the browser copy or cut, as its own menu does. @param {"copy" | "cut"} what */
  ask(what) {
    this.studio.canvas.focus();
    document.execCommand(what);
  }

  /** Paste what was asked for without keys. */
  async askPaste() {
    if (this.studio.collage.state?.clip) this.paste();
    else if (this.last.token) this.read(this.last.drawings);
    else this.readText(await navigator.clipboard.readText().catch(() => ""));
  }

  /** @param {string} text */
  readText(text) {
    if (/^\s*<(\?xml|svg)\b/.test(text)) this.read([["pasted", text]]);
    else tell("There is nothing to paste here: copy items, a picture, or the text of an SVG", { isError: true });
  }

  /** @param {[string, string][]} drawings names and SVG */
  read(drawings) {
    const { choice, collage, dropping } = this.studio;
    choice.expect(collage.rows);
    dropping.send(drawings.map(([name, svg]) => new File([svg], `${name}.svg`, { type: "image/svg+xml" })), (batch) => dropping.add(batch));
  }

  /**
   * A drawing of items as they lie.
   * @param {number[]} ids
   */
  drawing(ids) {
    const { collage } = this.studio;
    const [left, top, right, bottom] = collage.box(ids) ?? [0, 0, 1, 1];
    const whole = node("svg", { viewBox: `${left} ${top} ${right - left} ${bottom - top}`, width: right - left, height: bottom - top });
    for (const id of ids) {
      const [item, pose] = [collage.item(id), collage.target(id)];
      if (item && pose) whole.append(drawn(collage.look(item), matrixOf(pose, item.stretch)));
    }
    return new XMLSerializer().serializeToString(whole);
  }
}

/** @param {import("./collage.js").Look} look @param {DOMMatrix} matrix */
function drawn(look, { a, b, c, d, e, f }) {
  const group = node("g", { transform: `matrix(${a} ${b} ${c} ${d} ${e} ${f})` });
  if (!look.svg) group.append(node("path", { d: look.ink, fill: look.fill, "fill-rule": "evenodd" }));
  else {
    const [left, top, right, bottom] = look.box;
    const inner = document.importNode(new DOMParser().parseFromString(look.svg, "image/svg+xml").documentElement, true);
    for (const [name, value] of Object.entries({ x: left, y: top, width: right - left, height: bottom - top })) inner.setAttribute(name, String(value));
    group.append(inner);
  }
  return group;
}

/** @param {string} tag @param {Record<string, string | number>} given */
function node(tag, given) {
  const made = document.createElementNS(SPACE, tag);
  for (const [name, value] of Object.entries(given)) made.setAttribute(name, String(value));
  return made;
}

/**
 * What a page of ours has copied; anybody may have written it.
 * @param {string} text
 * @returns {{token: string, drawings: [string, string][]}}
 */
function known(text) {
  try {
    const { token, drawings } = JSON.parse(text);
    const sound = drawings.filter((/** @type {unknown} */ one) => Array.isArray(one) && one.length === 2 && one.every((part) => typeof part === "string"));
    return { token: String(token), drawings: sound.slice(0, MOST) };
  } catch {
    return { token: "", drawings: [] };
  }
}
