// @ts-check
/** Files and folders that are dropped or chosen, on their way to the studio. */

import { byId, h } from "./dom.js";
import { tell } from "./toasts.js";

/** @typedef {import("./connection.js").Connection} Connection */

const DRAWINGS = ".svg,.svgz,.dxf,image/*";
const MAPS = `${DRAWINGS},.geojson`;
const ANY = `${MAPS},.packwork,.toml,.csv,.tsv,.xlsx,.txt,.md,.ttf,.otf,.ttc,.otc`;
const AT_ONCE = 4;
const MOST = 1000;
const MOST_TOLD = 3;

export class Dropping {
  /**
   * @param {Connection} connection
   * @param {import("./collage.js").Collage} collage
   */
  constructor(connection, collage) {
    this.connection = connection;
    this.collage = collage;
    /** Files that were sent last. */
    this.count = 0;
    this.veil = byId("drop");
    const asks = { type: "file", class: "unseen", tabindex: "-1", "aria-hidden": "true" };
    this.field = h("input", { ...asks, multiple: true, onchange: () => this.chosen(this.field) });
    this.folder = h("input", { ...asks, multiple: true, webkitdirectory: true, onchange: () => this.chosen(this.folder) });
    document.body.append(this.field, this.folder);
    /** What is done with files of no stated purpose. @type {(files: File[]) => unknown} */
    this.takes = (files) => this.send(files, (batch) => this.bring(batch));
    /** What is done with those asked for last. @type {((files: File[]) => unknown) | null} */
    this.asked = null;
    /** Sheet that containers come on; null of that of now. @type {string | null} */
    this.sheet = null;
    /** Whether the names of a container's parts are written on them. */
    this.names = false;
    this.depth = 0;
    /** What files come in as. @type {"beside" | "items" | "photos"} */
    this.as = "beside";
    addEventListener("dragenter", (event) => this.entered(event, 1));
    addEventListener("dragleave", (event) => this.entered(event, -1));
    addEventListener("dragover", (event) => this.over(event));
    addEventListener("drop", (event) => this.dropped(event));
  }

  /** @param {DragEvent} event @param {number} step */
  entered(event, step) {
    if (!event.dataTransfer?.types.includes("Files")) return;
    event.preventDefault();
    this.depth = Math.max(this.depth + step, 0);
    this.veil.hidden = this.depth === 0;
  }

  /** @param {DragEvent} event */
  over(event) {
    event.preventDefault();
    const target = placeOf(event);
    for (const place of this.veil.children) place.classList.toggle("over", place === target);
  }

  /** @param {DragEvent} event */
  async dropped(event) {
    event.preventDefault();
    this.depth = 0;
    this.veil.hidden = true;
    const isRoom = placeOf(event)?.getAttribute("data-drops") === "room";
    const files = await filesOf(event.dataTransfer);
    if (files.length) await (isRoom ? this.send(files, (batch) => this.fill(batch)) : this.takes(files));
  }

  /** Ask for files of any kind. */
  choose() {
    this.question(ANY, true, this.takes);
  }

  /** Ask for a folder of them. */
  chooseFolder() {
    this.asked = null;
    this.folder.value = "";
    this.folder.click();
  }

  /**
   * Ask for one drawing or picture.
   * @param {(batch: string) => void} then told of the batch it is in
   */
  chooseOne(then) {
    this.ask(DRAWINGS, false, then);
  }

  /** Ask for the container's file: a drawing, a picture or a map. */
  chooseRoom() {
    this.ask(MAPS, false, (batch) => this.fill(batch));
  }

  /**
   * Ask for files.
   * @param {string} accept endings and kinds
   * @param {boolean} isMany
   * @param {(batch: string) => void} then told of the batch they are in
   */
  ask(accept, isMany, then) {
    this.question(accept, isMany, (files) => this.send(files, then));
  }

  /** Ask for one file. @param {string} accept @param {(batch: string, name: string) => void} then told of its batch and its name */
  askFile(accept, then) {
    this.question(accept, false, ([file]) => this.send([file], (batch) => then(batch, file.name)));
  }

  /**
   * @param {string} accept
   * @param {boolean} isMany
   * @param {(files: File[]) => unknown} asked
   */
  question(accept, isMany, asked) {
    this.asked = asked;
    this.field.accept = accept;
    this.field.multiple = isMany;
    this.field.value = "";
    this.field.click();
  }

  /** @param {HTMLInputElement} field */
  chosen(field) {
    const files = [...(field.files ?? [])].filter((file) => !file.name.startsWith("."));
    if (files.length) (this.asked ?? this.takes)(files);
  }

  /** Ask for a picture, by default one that the items come to show. @param {import("./mosaic.js").Purpose} [purpose] */
  choosePicture(purpose = "mosaic") {
    this.ask("image/*", false, (batch) => this.show(batch, purpose));
  }

  /** @param {string} batch of one picture @param {import("./mosaic.js").Purpose} purpose */
  show(batch, purpose) {
    this.connection.send({ type: "picture", source: `file:${batch}`, purpose });
  }

  /** Bring files beside what is there. @param {string} batch */
  add(batch) {
    this.connection.send({ type: "bring", sources: [`file:${batch}`] });
  }

  /** @param {string} batch */
  bring(batch) {
    const source = `file:${batch}`;
    if (this.as === "beside") this.add(batch);
    else this.connection.send({ type: "fill", use: this.as, source, ...(this.as === "items" ? { count: this.many() } : {}) });
  }

  /** As many items as there were, so that the container stays full; no fewer than files. */
  many() {
    return Math.max(this.count, this.collage.items.length, 1);
  }

  /** @param {string} batch */
  fill(batch) {
    this.connection.send({ type: "room", source: `file:${batch}`, canvas: this.sheet, names: this.names });
  }

  /**
   * @param {File[]} files
   * @param {(batch: string) => void} then
   */
  async send(files, then) {
    this.count = Math.min(files.length, MOST);
    try {
      const { batch } = await (await this.connection.ask("/files", { method: "POST" })).json();
      if (await this.sendAll(files.slice(0, MOST), batch)) then(batch);
    } catch (error) {
      tell(String(/** @type {Error} */ (error).message), { isError: true });
    }
    if (files.length > MOST) tell(`the first ${MOST} of ${files.length} files were taken`, { isError: true });
  }

  /**
   * Send files, several at once; how many came through.
   * @param {File[]} files
   * @param {string} batch
   */
  async sendAll(files, batch) {
    const waiting = [...files];
    /** @type {string[]} */
    const refused = [];
    const work = async () => {
      for (let file = waiting.shift(); file; file = waiting.shift()) {
        try {
          await this.sendOne(file, batch);
        } catch (error) {
          refused.push(/** @type {Error} */ (error).message);
        }
      }
    };
    await Promise.all(Array.from({ length: AT_ONCE }, work));
    for (const line of refused.slice(0, MOST_TOLD)) tell(line, { isError: true });
    if (refused.length > MOST_TOLD) tell(`and ${refused.length - MOST_TOLD} more`, { isError: true });
    return files.length - refused.length;
  }

  /** @param {File} file @param {string} batch */
  sendOne(file, batch) {
    const headers = { "x-name": encodeURIComponent(file.name), "content-type": "application/octet-stream" };
    return this.connection.ask(`/files/${batch}`, { method: "POST", headers, body: file });
  }
}

/**
 * The element that says what files dropped there become.
 * @param {DragEvent} event
 */
function placeOf(event) {
  return event.target instanceof Element ? event.target.closest("[data-drops]") : null;
}

/**
 * All files of what was dropped, those of folders too.
 * @param {DataTransfer | null} dropped
 * @returns {Promise<File[]>}
 */
async function filesOf(dropped) {
  const entries = [...(dropped?.items ?? [])].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
  if (!entries.length) return [...(dropped?.files ?? [])];
  const found = await Promise.all(entries.map((entry) => filesIn(/** @type {FileSystemEntry} */ (entry))));
  return found.flat().filter((file) => !file.name.startsWith("."));
}

/** @param {FileSystemEntry} entry @returns {Promise<File[]>} */
async function filesIn(entry) {
  if (entry.isFile) return [await new Promise((done, fail) => /** @type {FileSystemFileEntry} */ (entry).file(done, fail))];
  const reader = /** @type {FileSystemDirectoryEntry} */ (entry).createReader();
  /** @type {File[]} */
  const found = [];
  for (;;) {
    /** @type {FileSystemEntry[]} */
    const some = await new Promise((done, fail) => reader.readEntries(done, fail));
    if (!some.length || found.length > MOST) return found;
    found.push(...(await Promise.all(some.map(filesIn))).flat());
  }
}
