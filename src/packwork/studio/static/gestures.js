// @ts-check
/** Pointers, wheel and pinch on the canvas: mouse, pen and touch alike. */

import { kindOf } from "./kinds.js";

/** @typedef {import("./stage.js").Stage} Stage */
/** @typedef {import("./view.js").View} View */
/** @typedef {import("./choice.js").Choice} Choice */
/** @typedef {import("./hand.js").Hand} Hand */
/** @typedef {{x: number, y: number}} Point */

/** How far a pointer goes before it drags, px: of a finger more. */
const STILL = { mouse: 3, pen: 4, touch: 8 };
/** How near a handle is enough, px. */
const REACH = { mouse: 9, pen: 10, touch: 22 };
/** Time after which a finger that stays asks for the menu, ms. */
const LONG = 550;
/** Logarithm of the factor by which one turn of a wheel zooms at most. */
const NOTCH = 0.3;
/** Angles that are snapped to with shift, degrees. */
const SNAP = 15;

export class Gestures {
  /**
   * @param {Stage} stage
   * @param {View} view
   * @param {Choice} choice
   * @param {Hand} hand
   * @param {{changed: () => void, menu: (x: number, y: number) => void, stays: () => void}} hears
   */
  constructor(stage, view, choice, hand, hears) {
    this.stage = stage;
    this.view = view;
    this.choice = choice;
    this.hand = hand;
    this.hears = hears;
    this.isPanning = false;
    this.timer = 0;
    /** Whether a finger has stayed, and has the menu. */
    this.isLong = false;
    /** @type {Map<number, Point>} */
    this.pointers = new Map();
    /** @type {null | Doing} */
    this.doing = null;
    this.listen(stage.canvas);
  }

  /** @param {HTMLCanvasElement} canvas */
  listen(canvas) {
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.moved(event));
    canvas.addEventListener("pointerup", (event) => this.up(event));
    canvas.addEventListener("pointercancel", (event) => this.up(event));
    // The browser would press what of the menu lies under the finger that asked for it.
    canvas.addEventListener("touchend", (event) => this.isLong && event.preventDefault(), { passive: false });
    canvas.addEventListener("pointerleave", () => this.hover(null));
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    canvas.addEventListener("dblclick", (event) => this.stage.cropping?.begin(this.stage.itemAt(event.offsetX, event.offsetY)) && this.hears.changed());
    canvas.addEventListener("contextmenu", (event) => this.menu(event));
  }

  /** @param {PointerEvent} event */
  down(event) {
    const at = point(event);
    this.isLong = false;
    this.stage.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, at);
    if (this.pointers.size === 2) this.pinch();
    if (this.pointers.size > 1 || event.button === 2) return;
    const kind = pointerKindOf(event);
    const isPan = this.isPanning || event.button === 1;
    this.doing = isPan ? { act: "pan", from: at, at, kind } : this.begun(event, at, kind);
    if (kind === "touch") this.waitForMenu(at);
    this.pointer(at);
  }

  /**
   * @param {PointerEvent} event
   * @param {Point} at
   * @param {keyof typeof STILL} kind
   * @returns {Doing}
   */
  begun(event, at, kind) {
    if (this.drawer) return { act: "draw", from: at, at, kind };
    const room = this.stage.room;
    if (room?.isOn) {
      room.down(at, REACH[kind]);
      return { act: "room", from: at, at, kind };
    }
    const { cropping } = this.stage;
    if (cropping?.isOn) {
      if (this.stage.itemAt(at.x, at.y) === cropping.id) return { act: "crop", from: at, at, kind };
      // A finger beside it may be one of two that zoom.
      if (kind === "touch") return { act: "beside", from: at, at, kind };
      cropping.end(true);
    }
    const isMore = event.shiftKey || event.metaKey || event.ctrlKey;
    const handle = this.stage.handleAt(at.x, at.y, REACH[kind]);
    // Keys ask for what lies under a side of the frame.
    if (handle && !(handle.isSide && (isMore || event.altKey))) return { act: handle.kind, from: at, at, kind, about: this.about(handle), isSide: handle.isSide };
    const id = this.stage.take(at.x, at.y, kind === "touch" ? 8 : 3);
    if (id === null && event.altKey) {
      this.stage.lasso?.begin(event.shiftKey);
      return { act: "draw", from: at, at, kind };
    }
    if (id === null) return { act: kind === "touch" ? "pan" : "marquee", from: at, at, kind, adds: event.shiftKey };
    const was = this.choice.has(id);
    if (isMore) this.choice.toggle(id);
    else if (!was) this.choice.set([id]);
    return { act: "item", from: at, at, kind, id, single: was && !isMore, copies: event.altKey };
  }

  /** What the next drag draws: a force, an outline or a line round items. */
  get drawer() {
    const { forces, sketch, lasso } = this.stage;
    return [forces, sketch, lasso].find((one) => one?.isDrawing);
  }

  /**
   * The point that stays when a handle is pulled: the middle, or the corner across.
   * @param {import("./stage.js").Handle} handle
   */
  about(handle) {
    const frame = this.stage.frame() ?? [];
    const middle = { x: mean(frame.map(([x]) => x)), y: mean(frame.map(([, y]) => y)) };
    if (handle.kind === "turn" || this.choice.ids.size === 1) {
      const [id] = this.choice.ids;
      const pose = this.choice.ids.size === 1 ? this.stage.collage.pose(id) : null;
      return pose ? this.view.toScreen(pose.x, pose.y) : middle;
    }
    const [x, y] = frame[(handle.corner + 2) % 4];
    return { x, y };
  }

  /** @param {PointerEvent} event */
  moved(event) {
    const at = point(event);
    if (!this.pointers.has(event.pointerId)) return this.hover(at);
    const before = /** @type {Point} */ (this.pointers.get(event.pointerId));
    this.pointers.set(event.pointerId, at);
    if (this.pointers.size === 2) return this.pinched(event.pointerId, before);
    const doing = this.doing;
    if (!doing) return;
    const far = Math.hypot(at.x - doing.from.x, at.y - doing.from.y);
    if (!doing.moves && far < STILL[doing.kind]) return;
    clearTimeout(this.timer);
    if (!doing.moves) this.begin(doing);
    if (!this.doing) return;
    doing.moves = true;
    this.follow(doing, at, event.shiftKey, event.ctrlKey || event.metaKey);
    doing.at = at;
  }

  /** @param {Doing} doing */
  begin(doing) {
    if (doing.act === "item" && !kindOf(this.stage.collage).moves) {
      this.doing = null;
      return this.hears.stays();
    }
    if (doing.act === "item" || doing.act === "turn" || doing.act === "scale") {
      if (doing.id !== undefined && !this.choice.has(doing.id)) this.choice.set([doing.id]);
      this.choice.isBusy = true;
      if (doing.act === "item") this.stage.snapping.begin(this.choice.ids);
      this.hand.grab(this.choice.ids);
      if (doing.copies && kindOf(this.stage.collage).grows) this.hand.leaveCopies();
    }
  }

  /**
   * @param {Doing} doing
   * @param {Point} at
   * @param {boolean} snaps to an axis, or to round angles
   * @param {boolean} isFree whether no line draws what is dragged
   */
  follow(doing, at, snaps, isFree) {
    const { zoom } = this.view;
    const [x, y] = [at.x - doing.from.x, at.y - doing.from.y];
    if (doing.act === "pan") this.view.pan(at.x - doing.at.x, at.y - doing.at.y);
    else if (doing.act === "crop") this.stage.cropping?.drag(at.x - doing.at.x, at.y - doing.at.y);
    else if (doing.act === "marquee") this.marquee(doing, at);
    else if (doing.act === "room") this.stage.room?.move(doing.from, at, snaps);
    else if (doing.act === "draw") this.drawer?.draw(at, doing.from);
    else if (doing.act === "item") {
      const alongX = Math.abs(x) >= Math.abs(y);
      const way = snaps ? [alongX ? x : 0, alongX ? 0 : y] : [x, y];
      const snapped = this.stage.snapping.snapped(way[0] / zoom, way[1] / zoom);
      const [dx, dy] = isFree ? [way[0] / zoom, way[1] / zoom] : snapped;
      if (isFree) this.stage.snapping.guides = [];
      this.hand.move(snaps && !alongX ? 0 : dx, snaps && alongX ? 0 : dy);
    }
    else if (doing.act !== "beside") this.pull(doing, at, snaps);
    this.hears.changed();
  }

  /**
   * @param {Doing} doing
   * @param {Point} at
   * @param {boolean} snaps
   */
  pull(doing, at, snaps) {
    const about = /** @type {Point} */ (doing.about);
    const centre = this.view.toCanvas(about.x, about.y);
    const [from, to] = [doing.from, at].map((one) => ({ x: one.x - about.x, y: one.y - about.y }));
    if (doing.act === "scale") {
      const factor = Math.max(Math.hypot(to.x, to.y) / Math.max(Math.hypot(from.x, from.y), 1), 0.05);
      return this.hand.scale(factor, centre);
    }
    let angle = Math.atan2(to.y, to.x) - Math.atan2(from.y, from.x);
    if (snaps) angle = this.snapped(angle);
    this.hand.turn(angle, centre);
  }

  /** @param {number} angle */
  snapped(angle) {
    const [from] = this.hand.began.values();
    const step = (SNAP * Math.PI) / 180;
    const start = this.hand.began.size === 1 ? from.angle : 0;
    return step * Math.round((start + angle) / step) - start;
  }

  /**
   * @param {Doing} doing
   * @param {Point} at
   */
  marquee(doing, at) {
    const [xs, ys] = [[doing.from.x, at.x].sort((a, b) => a - b), [doing.from.y, at.y].sort((a, b) => a - b)];
    this.stage.marquee = [xs[0], ys[0], xs[1], ys[1]];
    const [a, b] = [this.view.toCanvas(xs[0], ys[0]), this.view.toCanvas(xs[1], ys[1])];
    doing.before ??= [...this.choice.ids];
    const { collage } = this.stage;
    const inside = collage.items.filter((_, k) => collage.tiling.places(k).some(([x, y]) => x >= a.x && x <= b.x && y >= a.y && y <= b.y));
    this.choice.set([...(doing.adds ? doing.before : []), ...inside.map((item) => item.id)]);
  }

  /** @param {PointerEvent} event */
  up(event) {
    clearTimeout(this.timer);
    this.pointers.delete(event.pointerId);
    const doing = this.doing;
    if (this.pointers.size || !doing) return;
    this.doing = null;
    this.stage.marquee = null;
    if (doing.act === "beside") this.stage.cropping?.end(true);
    else if (!doing.moves) this.clicked(doing);
    this.end();
    this.choice.changed();
  }

  /** @param {Doing} doing */
  clicked(doing) {
    const side = doing.isSide ? this.stage.take(doing.from.x, doing.from.y) : null;
    if (side !== null) this.choice.set([side]);
    else if (doing.act === "item" && doing.single && doing.id !== undefined) this.choice.set([doing.id]);
    else if ((doing.act === "marquee" && !doing.adds) || (doing.act === "pan" && doing.kind === "touch")) {
      this.choice.set([]);
    }
  }

  end() {
    this.stage.room?.drop();
    this.drawer?.drop();
    this.hand.drop();
    this.stage.snapping.end();
    this.choice.isBusy = false;
    this.hears.changed();
  }

  /** Have the next drag draw something, and nothing else. */
  draw() {
    this.cancel();
    this.stage.canvas.focus();
    this.stage.canvas.dataset.over = "draw";
  }

  /** Leave off what the pointer does; whether it did anything. */
  cancel() {
    if (this.drawer?.cancel() || this.leaveMarquee()) {
      this.choice.isBusy = false;
      this.doing = null;
      this.stage.canvas.dataset.over = "";
      this.hears.changed();
      return true;
    }
    if (this.stage.room?.grip) {
      this.stage.room.cancel();
      this.doing = null;
      this.hears.changed();
      return true;
    }
    if (!this.hand.isFull) return false;
    this.hand.cancel();
    this.doing = null;
    this.end();
    return true;
  }

  pinch() {
    clearTimeout(this.timer);
    if (this.hand.isFull) this.end();
    this.drawer?.clear();
    this.leaveMarquee();
    this.choice.isBusy = false;
    this.doing = null;
  }

  /** Leave off a frame that is drawn: what was chosen before is chosen again; whether one was. */
  leaveMarquee() {
    const { doing, stage } = this;
    const was = stage.marquee !== null;
    if (was) this.choice.set((doing?.before ?? []).filter((id) => stage.collage.rows.has(id)));
    stage.marquee = null;
    return was;
  }

  /** @param {number} id @param {Point} before */
  pinched(id, before) {
    const at = /** @type {Point} */ (this.pointers.get(id));
    const [other] = [...this.pointers].filter(([one]) => one !== id).map(([, where]) => where);
    const [was, now] = [before, at].map((one) => Math.max(Math.hypot(one.x - other.x, one.y - other.y), 1));
    if (this.stage.cropping?.isOn) {
      this.stage.cropping.zoom(now / was);
      return this.hears.changed();
    }
    this.view.pan((at.x - before.x) / 2, (at.y - before.y) / 2);
    this.view.zoomAt(now / was, (at.x + other.x) / 2, (at.y + other.y) / 2);
  }

  /** @param {WheelEvent} event */
  wheel(event) {
    event.preventDefault();
    const { x, y } = point(event);
    const lines = event.deltaMode === 1 ? 30 : 1;
    if (this.stage.cropping?.isOn) {
      this.stage.cropping.zoom(Math.exp(Math.min(Math.max((-lines * event.deltaY) / 500, -NOTCH), NOTCH)));
      return this.hears.changed();
    }
    const isZoom = event.ctrlKey || event.metaKey || !isTrackpad(event);
    // A pinch on a pad comes as a wheel with ctrl, in small steps.
    const step = (-lines * event.deltaY) / (event.ctrlKey && isTrackpad(event) ? 120 : 500);
    if (isZoom) this.view.zoomAt(Math.exp(Math.min(Math.max(step, -NOTCH), NOTCH)), x, y);
    else this.view.pan(-event.deltaX, -event.deltaY);
  }

  /** @param {MouseEvent} event */
  menu(event) {
    event.preventDefault();
    this.menuAt(point(event));
  }

  /** @param {Point} at */
  waitForMenu(at) {
    this.timer = setTimeout(() => {
      this.isLong = this.pointers.size === 1;
      if (this.isLong) this.menuAt(at);
    }, LONG);
  }

  /** @param {Point} at */
  menuAt(at) {
    const id = this.stage.take(at.x, at.y, 6);
    if (id !== null && !this.choice.has(id)) this.choice.set([id]);
    if (id === null) this.choice.set([]);
    this.hears.menu(at.x, at.y);
  }

  /** @param {Point | null} at */
  hover(at) {
    const id = at ? this.stage.itemAt(at.x, at.y) : null;
    if (at) this.pointer(at);
    if (id !== this.choice.hovered) {
      this.choice.hovered = id;
      this.hears.changed();
    }
  }

  /** @param {Point} at */
  pointer(at) {
    const { room } = this.stage;
    if (this.drawer) {
      this.stage.canvas.dataset.over = "draw";
      return;
    }
    if (room?.isOn) {
      const kind = room.gripAt(at, REACH.mouse)?.kind;
      this.stage.canvas.dataset.over = kind === "scale" || kind === "turn" ? kind : "item";
      return;
    }
    const handle = this.stage.handleAt(at.x, at.y, REACH.mouse);
    const over = handle ? (handle.kind === "turn" ? "turn" : "scale") : this.choice.hovered !== null ? "item" : "";
    this.stage.canvas.dataset.over = this.isPanning || this.doing?.act === "pan" ? "pan" : over;
  }
}

/**
 * @typedef {{act: "pan" | "draw" | "crop" | "beside" | "room" | "marquee" | "item" | "turn" | "scale", from: Point, at: Point,
 *   kind: keyof typeof STILL, id?: number, single?: boolean, adds?: boolean, copies?: boolean, before?: number[],
 *   about?: Point, moves?: boolean, isSide?: boolean}} Doing
 */

/** @param {MouseEvent} event @returns {Point} */
function point(event) {
  return { x: event.offsetX, y: event.offsetY };
}

/** @param {PointerEvent} event @returns {keyof typeof STILL} */
function pointerKindOf(event) {
  return event.pointerType === "touch" || event.pointerType === "pen" ? event.pointerType : "mouse";
}

/**
 * Whether a wheel is two fingers on a pad, as well as can be told: steps that are no whole clicks.
 * @param {WheelEvent} event
 */
function isTrackpad(event) {
  return event.deltaMode === 0 && (event.deltaX !== 0 || Math.abs(event.deltaY) < 50);
}

/** @param {number[]} values */
function mean(values) {
  return values.reduce((sum, value) => sum + value, 0) / Math.max(values.length, 1);
}
