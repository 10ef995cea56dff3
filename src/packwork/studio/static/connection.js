// @ts-check
/** The one way to the studio: a socket for messages and frames, requests for files. */

import { hex, provenToken } from "./proof.js";

/** @typedef {import("./wire.js").Said} Said */
/** @typedef {import("./wire.js").Told} Told */
/** @typedef {{number: number, version: number, done: number, moving: boolean, poses: Float32Array}} Frame */

const HEAD = 16;
const SHORTEST_WAIT = 250;
const LONGEST_WAIT = 4000;
/** Code with which the studio closes a socket while another person is at the desk. */
const TAKEN = 4409;

/**
 * What is inside the bytes of a frame.
 * @param {ArrayBuffer} data
 * @returns {Frame}
 */
export function frameOf(data) {
  const [number, version, done, flags] = new Uint32Array(data, 0, 4);
  return { number, version, done, moving: (flags & 1) === 1, poses: new Float32Array(data, HEAD) };
}

const NO_ANSWER = "the studio does not answer";

export class Connection {
  /**
   * @param {{said: (message: Said) => void, frame: (frame: Frame) => void,
   *          changed: (isOpen: boolean, isStranger: boolean) => void, taken: (isTaken: boolean) => void}} hears
   */
  constructor(hears) {
    this.hears = hears;
    /** Known once the studio has proved to be ours. */
    this.token = "";
    this.isProving = false;
    /** @type {() => void} */
    this.begun = () => {};
    this.hasBegun = new Promise((begun) => (this.begun = () => begun(null)));
    /** @type {WebSocket | null} */
    this.socket = null;
    this.wait = SHORTEST_WAIT;
    this.timer = 0;
    this.count = 0;
    /** Whose pages these are: all tabs of a browser's profile are one person's. */
    this.person = localStorage.getItem("person") ?? newPerson();
    this.isTaken = false;
    for (const event of ["online", "focus", "pageshow"]) addEventListener(event, () => this.hurry());
  }

  /** Open the socket, once what listens there has proved to be the studio. */
  async open() {
    if (this.isProving) return;
    this.isProving = true;
    const token = await provenToken().catch(() => null);
    this.isProving = false;
    this.token = token ?? "";
    if (this.token) this.connect();
    else this.openLater(token !== null);
  }

  connect() {
    const joins = sessionStorage.getItem("joins") !== null;
    const socket = new WebSocket(`ws://${location.host}/socket`, ["packwork", `token.${this.token}`, `${joins ? "join" : "person"}.${this.person}`]);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.begun();
      this.hears.changed(true, false);
    };
    socket.onmessage = (event) => this.heard(event.data);
    socket.onclose = (event) => this.lost(socket, event.code);
    this.socket = socket;
  }

  /** @param {string | ArrayBuffer} data */
  heard(data) {
    this.wait = SHORTEST_WAIT;
    this.take(false);
    if (typeof data === "string") this.hears.said(JSON.parse(data));
    else this.hears.frame(frameOf(data));
  }

  /** @param {WebSocket} socket @param {number} code */
  lost(socket, code) {
    if (this.socket !== socket) return;
    this.socket = null;
    if (code === TAKEN) this.take(true);
    this.openLater();
  }

  /** @param {boolean} [isStranger] whether what is there is not the studio that this page knows */
  openLater(isStranger = false) {
    this.hears.changed(false, isStranger);
    this.timer = setTimeout(() => this.open(), this.wait);
    this.wait = Math.min(2 * this.wait, LONGEST_WAIT);
  }

  /** @param {boolean} isTaken whether another person is at the desk */
  take(isTaken) {
    if (isTaken !== this.isTaken) this.hears.taken(isTaken);
    this.isTaken = isTaken;
  }

  /** Work beside whoever is at the desk, for as long as this tab lives. */
  join() {
    sessionStorage.setItem("joins", "yes");
    this.hurry();
  }

  /** Do not wait for the next try: the machine has woken up. */
  hurry() {
    if (this.socket) return;
    clearTimeout(this.timer);
    this.open();
  }

  get isOpen() {
    return this.socket !== null && this.socket.readyState === WebSocket.OPEN;
  }

  /**
   * Whether a message was sent.
   * @param {Told} message
   */
  send(message) {
    if (!this.isOpen) return false;
    /** @type {WebSocket} */ (this.socket).send(JSON.stringify(message));
    return true;
  }

  /**
   * Have a command done; its number, which a later frame says to be known, 0 if it was not sent.
   * @param {object} command
   */
  do(command) {
    const n = ++this.count;
    return this.send(/** @type {Told} */ ({ type: "do", n, command })) ? n : 0;
  }

  /**
   * Go through the history; counted as commands are.
   * @param {"undo" | "redo"} to
   */
  leap(to) {
    this.send({ type: "leap", n: ++this.count, to });
  }

  /**
   * An answer of the studio; what it refuses is thrown as its one line.
   * @param {string} path
   * @param {RequestInit} [asked]
   */
  async ask(path, asked = {}) {
    await this.hasBegun;
    if (!this.isOpen) throw new Error(NO_ANSWER);
    const headers = { ...asked.headers, "x-packwork-token": this.token };
    const answer = await fetch(path, { ...asked, headers }).catch(() => { throw new Error(NO_ANSWER); });
    if (!answer.ok) throw new Error((await answer.text()).trim() || NO_ANSWER);
    return answer;
  }
}

/** A name for whoever has this browser; no secret. */
function newPerson() {
  const person = hex(crypto.getRandomValues(new Uint8Array(8)));
  localStorage.setItem("person", person);
  return person;
}
