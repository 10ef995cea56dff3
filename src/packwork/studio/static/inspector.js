// @ts-check
/** The inspector: numbers, name, weight and colour of what is chosen, each to be typed or dragged. */

import { LINES } from "./actions.js";
import { colourField, h, showAgain, showNumber } from "./dom.js";
import { together } from "./hand.js";
import { kindOf } from "./kinds.js";

/** @typedef {import("./wire.js").Thing} Thing */
/** @typedef {"x" | "y" | "width" | "height" | "angle"} Quantity */

/** What fields say, what screen readers hear. @type {[Quantity, string, string][]} */
const NUMBERS = [["x", "X", "X of the middle"], ["y", "Y", "Y of the middle"], ["angle", "∠", "Angle in degrees"], ["width", "W", "Width"], ["height", "H", "Height"]];
/** Digits behind the point by unit. @type {Record<string, number>} */
const DIGITS = { px: 1, pt: 1, mm: 2, cm: 3, in: 3 };
/** Degrees that a label turns when it is dragged by one px. */
const TURN = 0.5;
/** Steps of an arrow key with shift. */
const FAR = 10;
/** Time between two looks at where things are while they move, ms. */
const PAUSE = 100;

export class Inspector {
  /** @param {import("./studio.js").Studio} studio */
  constructor(studio) {
    this.studio = studio;
    /** @type {Thing[]} */
    this.items = [];
    /** Numbers of the commands by which fields were asked for. @type {Map<HTMLInputElement, number>} */
    this.sent = new Map();
    this.timer = 0;
    this.numbers = new Map(NUMBERS.map(([name, label, title]) => [name, this.number(name, label, title)]));
    this.name = h("input", { type: "text", maxlength: "200", "aria-label": "Name", onchange: () => this.rename() });
    this.weight = h("input", { type: "number", min: "0.01", step: "any", onchange: () => this.weigh() });
    this.colour = colourField({ value: "#1f6f78" }, (colour, ids) => studio.recolour(colour, ids), () => this.ids);
    this.unit = h("span", { class: "unit" });
    this.lines = h("div", { class: "lines", role: "group", "aria-label": "Line up", hidden: true }, ...LINES.map((id) => studio.bar.button(id)));
    const fields = [...this.numbers.values()].map((field) => /** @type {HTMLElement} */ (field.parentElement));
    this.element = h("div", { class: "editor", role: "group", "aria-label": "What is chosen" },
      h("div", { class: "row" }, this.name, this.unit, ...["hold", "release"].map((id) => studio.bar.button(id))),
      h("div", { class: "numbers" }, ...fields, h("div", { class: "row" }, ...["flip", "flip-down"].map((id) => studio.bar.button(id)))),
      this.lines,
      h("div", { class: "row" }, h("label", {}, "Weight", this.weight), h("label", { class: "colour" }, h("span", { class: "unseen" }, "Colour"), this.colour),
        h("button", { type: "button", onclick: () => studio.replacing.open() }, "Replace …")));
  }

  /**
   * A field for a number, with a label that can be dragged.
   * @param {Quantity} name
   * @param {string} label
   * @param {string} title
   */
  number(name, label, title) {
    const field = h("input", { type: "number", step: "any", "aria-label": title, "data-number": name,
      onchange: () => this.ask(name, field.valueAsNumber), onkeydown: (/** @type {KeyboardEvent} */ event) => this.step(event, field) });
    const handle = h("span", { title: `${title}: drag to change it`, "aria-hidden": "true" }, label);
    handle.addEventListener("pointerdown", (event) => this.scrub(event, name, handle));
    h("div", { class: "number" }, handle, field);
    return field;
  }

  /** Numbers of what is shown and still there. */
  get ids() {
    return this.items.map((item) => item.id).filter((id) => this.studio.collage.rows.has(id));
  }

  get digits() {
    return DIGITS[this.studio.collage.scene?.unit ?? "px"] ?? 1;
  }

  /** @param {Thing[]} items those chosen */
  show(items) {
    if (items.length !== this.items.length || items.some((one, k) => one.id !== this.items[k].id)) this.leave();
    this.items = items;
    this.element.hidden = !items.length;
    const [first] = items;
    if (!first) return;
    const { collage } = this.studio;
    const own = collage.colour(first.id);
    const colour = own ?? this.colour.value;
    this.colour.classList.toggle("mixed", !own);
    this.lines.hidden = items.length < 2;
    this.name.placeholder = `${items.length} items`;
    this.unit.textContent = collage.scene?.unit ?? "";
    const { sizes } = kindOf(collage);
    for (const field of [this.field("width"), this.field("height")]) field.disabled = !sizes;
    /** @type {HTMLElement} */ (this.weight.parentElement).hidden = !sizes;
    showNumber(this.name, same(items.map((one) => one.name)) ?? "");
    showNumber(this.colour, colour);
    this.follow();
  }

  /** Others are chosen: what is typed is asked for, of those that it was typed for. */
  leave() {
    const field = document.activeElement;
    if (field instanceof HTMLInputElement && this.element.contains(field)) field.blur();
    this.sent.clear();
  }

  /** Whether what a field asked for is not done yet: it keeps it till then. @param {HTMLInputElement} field */
  awaits(field) {
    return (this.sent.get(field) ?? 0) > this.studio.collage.done;
  }

  /** Ask for what a field says. @param {HTMLInputElement} field @param {object} command */
  send(field, command) {
    field.dataset.shown = field.value;
    this.sent.set(field, this.studio.connection.do(command));
  }

  /** @param {Quantity} name */
  field(name) {
    return /** @type {HTMLInputElement} */ (this.numbers.get(name));
  }

  /** Bring the numbers up to where things are. */
  follow() {
    if (!this.element.isConnected || this.element.hidden) return;
    const now = this.now();
    if (!this.awaits(this.weight)) showNumber(this.weight, shown(this.items[0].weight));
    for (const [name, field] of this.numbers) {
      const value = now?.[name];
      const text = value === null || value === undefined ? "" : String(Number(value.toFixed(this.digits)));
      if (!this.awaits(field)) showNumber(field, text);
    }
  }

  /** The same a little later, and no more often: nobody reads faster, and each change lays the page out anew. */
  followSoon() {
    this.timer ||= setTimeout(() => {
      this.timer = 0;
      this.follow();
    }, PAUSE);
  }

  /**
   * The numbers of what is chosen: of several the middle of all, and what they have in common.
   * @returns {Record<Quantity, number | null> | null}
   */
  now() {
    const { collage } = this.studio;
    const poses = this.items.map((item) => collage.target(item.id)).filter((pose) => pose !== null);
    if (poses.length !== this.items.length || !poses.length) return null;
    const middle = poses.length === 1 ? poses[0] : this.middle();
    const sizes = this.items.map((item, k) => sizeOf(collage.look(item), item.stretch, poses[k].scale));
    const precise = (/** @type {number[]} */ values) => same(values.map((value) => Number(value.toFixed(this.digits))));
    return { x: middle.x, y: middle.y, width: precise(sizes.map(([width]) => width)), height: precise(sizes.map(([, height]) => height)),
      angle: precise(poses.map((pose) => degreesOf(pose.angle))) };
  }

  /** The middle of the box about what is chosen. */
  middle() {
    const [left, top, right, bottom] = this.studio.collage.box(this.ids) ?? [0, 0, 0, 0];
    return { x: (left + right) / 2, y: (top + bottom) / 2 };
  }

  /**
   * Have a number, as one command.
   * @param {Quantity} name
   * @param {number} value
   */
  ask(name, value) {
    const [now, field] = [this.now(), this.field(name)];
    /** @type {object[]} */
    const commands = !now || !Number.isFinite(value) ? [] : this.items.flatMap((item) => {
      const pose = /** @type {import("./collage.js").Pose} */ (this.studio.collage.target(item.id));
      return this.asked(name, value, now, item, pose) ?? [];
    });
    if (commands.length) this.send(field, together(commands));
    else showAgain(field);
  }

  /**
   * The command that gives an item a number.
   * @param {Quantity} name
   * @param {number} value
   * @param {Record<Quantity, number | null>} now
   * @param {Thing} item
   * @param {import("./collage.js").Pose} pose
   */
  asked(name, value, now, { id: item, shape, stretch }, pose) {
    if (name === "angle") return { kind: "turn", item, angle: value };
    if (name === "x" || name === "y") return { kind: "move", item, x: pose.x, y: pose.y, [name]: value + (pose[name] - (now[name] ?? 0)) };
    const look = /** @type {import("./collage.js").Look} */ (this.studio.collage.looks.get(shape));
    const field = this.field(name);
    const size = this.awaits(field) ? Number(field.dataset.shown) : sizeOf(look, stretch, pose.scale)[name === "width" ? 0 : 1];
    return value > 0 ? { kind: "scale", item, factor: Math.min(Math.max(value / size, 0.01), 100) } : null;
  }

  /** @param {KeyboardEvent} event @param {HTMLInputElement} field */
  step(event, field) {
    const steps = { ArrowUp: FAR, ArrowDown: -FAR }[event.key];
    if (!steps || !event.shiftKey) return;
    event.preventDefault();
    field.value = String((field.valueAsNumber || 0) + steps);
    field.dispatchEvent(new Event("change"));
  }

  /**
   * Follow a label that is dragged, as a drag of the items.
   * @param {PointerEvent} event
   * @param {Quantity} name
   * @param {HTMLElement} handle
   */
  scrub(event, name, handle) {
    const { hand, choice, view } = this.studio;
    const from = event.clientX;
    const middle = this.items.length === 1 ? this.studio.collage.pose(this.ids[0]) : this.middle();
    const width = this.now()?.[name] ?? 1;
    if (!middle || hand.isFull || this.field(name).disabled) return;
    event.preventDefault();
    handle.setPointerCapture(event.pointerId);
    /** @param {PointerEvent} moved */
    const follow = (moved) => {
      const far = moved.clientX - from;
      if (!hand.isFull && far) hand.grab(this.ids);
      choice.isBusy = true;
      if (!hand.isFull) return;
      if (name === "angle") hand.turn((far * TURN * Math.PI) / 180, middle);
      else if (name === "x" || name === "y") hand.move(name === "x" ? far / view.zoom : 0, name === "y" ? far / view.zoom : 0);
      else hand.scale(Math.max(1 + far / view.zoom / width, 0.05), middle);
      this.studio.redraw();
    };
    const over = () => {
      handle.removeEventListener("pointermove", follow);
      this.studio.gestures.end();
    };
    handle.addEventListener("pointermove", follow);
    handle.addEventListener("lostpointercapture", over, { once: true });
  }

  rename() {
    const name = this.name.value.trim();
    if (name && this.ids.length) this.studio.connection.do(together(this.ids.map((item) => ({ kind: "rename", item, name }))));
  }

  weigh() {
    const weight = Number(this.weight.value);
    if (weight > 0 && this.ids.length) this.send(this.weight, { kind: "weigh", items: this.ids, weight });
    else showAgain(this.weight);
  }

  /** Put the cursor into the first number. */
  focus() {
    this.field("x").focus();
    this.field("x").select();
  }
}

/**
 * The value that all have; null where they differ.
 * @template T
 * @param {T[]} values
 * @returns {T | null}
 */
function same(values) {
  return values.every((value) => value === values[0]) ? values[0] : null;
}

/**
 * Width and height of an item's outline before it is turned, canvas units.
 * @param {import("./collage.js").Look} look
 * @param {number} stretch
 * @param {number} scale
 */
function sizeOf(look, stretch, scale) {
  const root = Math.sqrt(stretch);
  return [look.size[0] * scale * root, (look.size[1] * scale) / root];
}

/** @param {number} radians */
function degreesOf(radians) {
  return (radians * 180) / Math.PI - 360 * Math.round(radians / (2 * Math.PI));
}

/** @param {number} weight */
function shown(weight) {
  return String(Number(weight.toPrecision(4)));
}
