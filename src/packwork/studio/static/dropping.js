// @ts-check
/** Files and folders that are dropped or chosen, on their way to the studio. */

import { byId, h } from "./dom.js";
import { tell } from "./toasts.js";

/** @typedef {import("./connection.js").Connection} Connection */

const AT_ONCE = 4;
const MOST = 1000;
const MOST_TOLD = 3;

export class Dropping {
  /** @param {Connection} connection */
  constructor(connection) {
    this.connection = connection;
    this.veil = byId("drop");
    this.field = h("input", { type: "file", multiple: true, class: "unseen", tabindex: "-1", "aria-hidden": "true",
      accept: ".svg,.svgz,image/*", onchange: () => this.chosen() });
    document.body.append(this.field);
    /** @type {(batch: string) => void} */
    this.then = (batch) => this.bring(batch);
    this.depth = 0;
    /** Whether what comes takes the place of all that is there. */
    this.replaces = false;
    addEventListener("dragenter", (event) => this.entered(event, 1));
    addEventListener("dragleave", (event) => this.entered(event, -1));
    addEventListener("dragover", (event) => event.preventDefault());
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
  async dropped(event) {
    event.preventDefault();
    this.depth = 0;
    this.veil.hidden = true;
    const target = event.target instanceof Element ? event.target.closest("[data-drops=room]") : null;
    const files = await filesOf(event.dataTransfer);
    if (files.length) await this.send(files, target ? (batch) => this.fill(batch) : (batch) => this.bring(batch));
  }

  /**
   * Ask for files.
   * @param {boolean} [isRoom] whether one is to become the container
   */
  choose(isRoom = false) {
    this.then = isRoom ? (batch) => this.fill(batch) : (batch) => this.bring(batch);
    this.field.multiple = !isRoom;
    this.field.value = "";
    this.field.click();
  }

  chosen() {
    if (this.field.files?.length) this.send([...this.field.files], this.then);
  }

  /** @param {string} batch */
  bring(batch) {
    const source = `file:${batch}`;
    if (!this.replaces) return this.connection.send({ type: "bring", sources: [source] });
    this.connection.send({ type: "fill", use: "items", source });
    this.replaces = false;
  }

  /** @param {string} batch */
  fill(batch) {
    this.connection.send({ type: "room", source: `file:${batch}` });
  }

  /**
   * @param {File[]} files
   * @param {(batch: string) => void} then
   */
  async send(files, then) {
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
