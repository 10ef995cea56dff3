// @ts-check
/** The canvas: container, items, and what is marked on them. */

import { Backdrop } from "./backdrop.js";
import { matrixOf } from "./collage.js";
import { coloursOf } from "./colours.js";
import { Cropping } from "./cropping.js";
import { Snapping } from "./snapping.js";
import { kindOf } from "./kinds.js";
import { distance } from "./rings.js";

/** @typedef {import("./collage.js").Collage} Collage */
/** @typedef {import("./view.js").View} View */
/** @typedef {import("./sprites.js").Sprites} Sprites */
/** @typedef {import("./choice.js").Choice} Choice */
/** @typedef {{at: [number, number], kind: "scale" | "turn", corner: number, isSide?: boolean}} Handle */

/** Distance of the turning handle from its corner, and half a handle, px. */
const TURN_AWAY = 22;
const HALF = 5;
/** Characters of path data from which on a drawing is a sprite and not a path. */
const LONG = 6000;
/** Opacity of the picture that a mosaic shows, under its items. */
const FAINT = 0.3;
/** How near a side of the frame is enough, and the reach of what is no finger, px. */
const SIDE = 4, MOST_REACH = 10;
/** Half a handle of the smallest items, px. */
const LEAST_HALF = 2.5;
/** Radius of a pin, px. */
const PIN = 9;
/** Width over height from which an item may be letters: its pin is before its left end, where it covers none. */
const WORDLIKE = 1.5;

export class Stage {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Collage} collage
   * @param {View} view
   * @param {Sprites} sprites
   * @param {Choice} choice
   */
  constructor(canvas, collage, view, sprites, choice) {
    this.canvas = canvas;
    /** @type {CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D} */
    this.pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", { alpha: false }));
    this.backdrop = new Backdrop(collage);
    this.collage = collage;
    this.view = view;
    this.sprites = sprites;
    this.choice = choice;
    this.snapping = new Snapping(collage, view);
    this.outline = { text: "", path: new Path2D() };
    /** Notes by their items. @type {{of: unknown, by: Map<number | null, import("./wire.js").DrawnNote[]>}} */
    this.noted = { of: null, by: new Map() };
    /** @type {WeakMap<import("./wire.js").DrawnNote, Path2D>} */
    this.notePaths = new WeakMap();
    /** Whether silhouettes are shown in place of drawings: free, covered, covered twice. */
    this.showsFaults = false;
    /** @type {import("./forces.js").Forces | null} */
    this.forces = null;
    /** @type {import("./sketch.js").Sketch | null} */
    this.sketch = null;
    /** @type {import("./lasso.js").Lasso | null} */
    this.lasso = null;
    /** The container in the hand. @type {import("./room.js").Room | null} */
    this.room = null;
    /** A photograph in the hand within its frame. @type {Cropping | null} */
    this.cropping = null;
    /** @type {null | [number, number, number, number]} */
    this.marquee = null;
    this.colours = coloursOf(canvas);
    this.ratio = 1;
    /** Where the image of an item lies that is drawn. @type {import("./tiling.js").Shift} */
    this.shift = [0, 0];
    /** The same of the one found last. @type {import("./tiling.js").Shift} */
    this.hit = [0, 0];
  }

  /** Take over the colours of the theme. */
  recolour() {
    this.colours = coloursOf(this.canvas);
  }

  resize() {
    this.ratio = Math.min(devicePixelRatio || 1, 2);
    const { clientWidth, clientHeight } = this.canvas;
    this.canvas.width = Math.round(clientWidth * this.ratio);
    this.canvas.height = Math.round(clientHeight * this.ratio);
  }

  /**
   * Draw all; whether another picture would be the same.
   * @param {boolean} isMoving what moves is drawn faster, not as finely
   */
  draw(isMoving = false) {
    const { collage, view, backdrop } = this;
    const { width, height } = this.canvas;
    if (!width || !height) return true;
    const key = [view.zoom, view.x, view.y, width, height, this.ratio, collage.scene, this.colours, this.room?.preview, this.showsFaults, collage.tiling.isPreview];
    const found = collage.hasPoses ? backdrop.look(key, isMoving, view.zoom * this.ratio) : "new";
    if (found === "new") this.drawGround(() => true, isMoving);
    else {
      if (found === "stale") this.drawBackdrop(width, height);
      this.pen.resetTransform();
      this.pen.drawImage(/** @type {OffscreenCanvas} */ (backdrop.picture), 0, 0);
      this.pen.imageSmoothingQuality = "low";
      if (isMoving) this.drawItems((k) => backdrop.loose[k] === 1);
    }
    this.drawMarks();
    return found !== "new" || !collage.hasPoses;
  }

  /**
   * Draw what lies still to a picture of its own.
   * @param {number} width
   * @param {number} height
   */
  drawBackdrop(width, height) {
    const { backdrop, pen, sprites } = this;
    this.pen = backdrop.pen(width, height);
    sprites.lacks = false;
    for (const part of backdrop.regions?.map((one) => this.whole(one)) ?? [undefined]) {
      this.pen.save();
      if (part) this.clip(part);
      this.drawGround((k) => backdrop.isStale(k, part), false);
      this.pen.restore();
    }
    this.pen = pen;
    backdrop.done(!sprites.lacks);
  }

  /** A box made larger to whole pixels: along half of one, what is drawn twice would shine through. @param {import("./backdrop.js").Box} box @returns {import("./backdrop.js").Box} */
  whole([left, top, right, bottom]) {
    const { view, ratio } = this;
    const [from, to] = [view.toScreen(left, top), view.toScreen(right, bottom)];
    const [a, b] = [view.toCanvas(Math.floor(ratio * from.x) / ratio, Math.floor(ratio * from.y) / ratio), view.toCanvas(Math.ceil(ratio * to.x) / ratio, Math.ceil(ratio * to.y) / ratio)];
    return [a.x, a.y, b.x, b.y];
  }

  /** Have nothing drawn but in a box. @param {number[]} box canvas units */
  clip([left, top, right, bottom]) {
    const path = new Path2D();
    path.rect(left, top, right - left, bottom - top);
    this.toCanvas();
    this.pen.clip(path);
  }

  /**
   * Draw desk, container, and some items.
   * @param {(k: number) => boolean} isDrawn
   * @param {boolean} isFast
   */
  drawGround(isDrawn, isFast) {
    const { pen } = this;
    pen.imageSmoothingQuality = isFast ? "low" : "high";
    pen.resetTransform();
    pen.fillStyle = this.colours.desk;
    pen.fillRect(0, 0, this.canvas.width, this.canvas.height);
    if (!this.collage.scene) return;
    this.drawContainer(this.collage.scene);
    if (this.collage.hasPoses) this.drawItems(isDrawn);
  }

  /** @param {import("./wire.js").Scene} scene */
  drawContainer(scene) {
    const { pen, colours } = this;
    const { tiling } = this.collage;
    const { x: left, y: top, width, height } = tiling.whole;
    const text = tiling.repeat ? `M${left} ${top}h${width}v${height}h${-width}Z` : this.room?.path ?? scene.outline;
    if (this.outline.text !== text) this.outline = { text, path: new Path2D(text) };
    this.toCanvas();
    // Letters are made to be read on paper.
    const ground = scene.ground || (scene.notes?.length ? colours.paper : "");
    pen.fillStyle = ground || colours.paper;
    if (ground) pen.fillRect(left, top, width, height);
    if (this.showsFaults || !ground) pen.fill(this.outline.path, "evenodd");
    for (const shift of tiling.sheets) for (const one of scene.under ?? []) this.drawUnder(one, shift);
    this.toCanvas();
    if (this.showsFaults) pen.fillStyle = colours.free;
    if (this.showsFaults) pen.fill(this.outline.path, "evenodd");
    pen.strokeStyle = colours.edge;
    pen.lineWidth = 1.25 / this.view.zoom;
    if (scene.is_lined) pen.stroke(this.outline.path);
    // A sheet of paper has edges that matter.
    if (scene.unit !== "px") pen.strokeRect(left, top, width, height);
    for (const note of this.notes.get(null) ?? []) this.drawNote(note, new DOMMatrix());
  }

  /** A picture behind all; that of a mosaic faintly, in the container. @param {import("./wire.js").Underlay} one @param {import("./tiling.js").Shift} shift */
  drawUnder({ shape, matrix, faint }, shift) {
    const look = this.collage.looks.get(shape);
    if (!look) return;
    const { pen, ratio, view } = this;
    pen.save();
    if (faint) pen.clip(this.outline.path, "evenodd");
    pen.globalAlpha = faint ? FAINT : 1;
    pen.translate(...shift);
    pen.transform(...matrix);
    const size = look.extent * Math.hypot(matrix[0], matrix[1]) * view.zoom * ratio;
    this.drawLook(look, size, this.sprites);
    pen.restore();
  }

  /** Letters and keys, by the item that they are on; null for what stands beside. */
  get notes() {
    const notes = this.collage.scene?.notes ?? [];
    if (this.noted.of !== notes) {
      this.noted = { of: notes, by: new Map() };
      for (const note of notes) this.noted.by.set(note.item, [...(this.noted.by.get(note.item) ?? []), note]);
    }
    return this.noted.by;
  }

  /**
   * @param {import("./wire.js").DrawnNote} note
   * @param {DOMMatrix} moved what its item did since it was put there
   */
  drawNote(note, moved) {
    const { zoom, x, y } = this.view;
    const r = this.ratio;
    this.pen.setTransform(new DOMMatrix([r * zoom, 0, 0, r * zoom, r * x, r * y]).multiply(moved).multiply(new DOMMatrix([...note.matrix])));
    this.pen.fillStyle = note.fill;
    const path = this.notePaths.get(note) ?? new Path2D(note.path);
    this.notePaths.set(note, path);
    this.pen.fill(path, "evenodd");
  }

  toCanvas() {
    const { zoom, x, y } = this.view;
    const r = this.ratio;
    this.pen.setTransform(r * zoom, 0, 0, r * zoom, r * x, r * y);
  }

  /** @param {number} k @param {import("./wire.js").Thing} item */
  toItem(k, item) {
    const { shown } = this.collage;
    const { view, ratio } = this;
    const [angle, scale] = [shown[4 * k + 2], shown[4 * k + 3]];
    const [root, wide] = [Math.sqrt(item.stretch), ratio * view.zoom];
    const [cos, sin] = [wide * scale * Math.cos(angle), wide * scale * Math.sin(angle)];
    const [x, y] = [wide * (shown[4 * k] + this.shift[0]) + ratio * view.x, wide * (shown[4 * k + 1] + this.shift[1]) + ratio * view.y];
    this.pen.setTransform(cos * root, sin * root, -sin / root, cos / root, x, y);
    return scale;
  }

  /** @param {(k: number) => boolean} isDrawn */
  drawItems(isDrawn) {
    const { collage, sprites } = this;
    const perUnit = this.view.zoom * this.ratio;
    const last = collage.hand;
    const late = [];
    this.pen.save();
    if (collage.tiling.repeat) this.clip(collage.tiling.box);
    // Under all of them, as in files.
    if (!this.showsFaults) collage.items.forEach((item, k) => item.halo && isDrawn(k) && this.atImages(k, () => this.drawHalo(k, item)));
    for (let k = 0; k < collage.items.length; k++) {
      if (!isDrawn(k)) continue;
      if (last.has(collage.items[k].id)) late.push(k);
      else this.atImages(k, () => this.drawItem(k, perUnit, sprites));
    }
    for (const k of late) this.atImages(k, () => this.drawItem(k, perUnit, sprites));
    this.pen.restore();
  }

  /** Draw something of an item wherever it is seen. @param {number} k @param {() => void} draw */
  atImages(k, draw) {
    for (this.shift of this.collage.tiling.shifts(k)) draw();
    this.shift = [0, 0];
  }

  /** @param {number} k @param {import("./wire.js").Thing} item */
  drawHalo(k, item) {
    const look = this.collage.looks.get(item.shape);
    if (!look || this.isOutOfSight(k)) return;
    const scale = this.toItem(k, item);
    this.pen.strokeStyle = item.halo;
    this.pen.lineWidth = (2 * (this.collage.scene?.rim ?? 0)) / Math.max(scale, 1e-9);
    this.pen.lineJoin = "round";
    this.pen.stroke(look.inkPath ?? look.outlinePath);
  }

  /**
   * @param {number} k
   * @param {number} perUnit
   * @param {Sprites} sprites
   */
  drawItem(k, perUnit, sprites) {
    const item = this.collage.items[k];
    const look = this.collage.looks.get(item.shape);
    if (!look || this.isOutOfSight(k)) return;
    const scale = this.toItem(k, item);
    if (this.showsFaults) return this.drawSilhouette(look);
    this.drawLook(look, look.extent * scale * perUnit * Math.sqrt(Math.max(item.stretch, 1 / item.stretch)), sprites);
    for (const note of this.notes.get(item.id) ?? []) {
      const [x, y, , before] = note.pose;
      const { shown } = this.collage;
      this.drawNote(note, new DOMMatrix().translate(shown[4 * k], shown[4 * k + 1]).scale(scale / before).translate(-x, -y));
    }
  }

  /**
   * @param {import("./collage.js").Look} look
   * @param {number} size px
   * @param {Sprites} sprites
   */
  drawLook(look, size, sprites) {
    if (look.inkPath && look.ink.length < LONG) {
      this.pen.fillStyle = look.fill;
      this.pen.fill(look.inkPath, "evenodd");
      return;
    }
    const [left, top, right, bottom] = look.box;
    const sprite = sprites.of(look, size);
    if (sprite) this.pen.drawImage(sprite, left, top, right - left, bottom - top);
  }

  /** Two of them on one another are darker. @param {import("./collage.js").Look} look */
  drawSilhouette(look) {
    this.pen.globalAlpha = 0.45;
    this.pen.fillStyle = this.colours.taken;
    this.pen.fill(look.outlinePath, "evenodd");
    this.pen.globalAlpha = 1;
  }

  /** @param {number} k */
  isOutOfSight(k) {
    const [x, y] = this.collage.shown.subarray(4 * k, 4 * k + 2);
    const at = this.view.toScreen(x + this.shift[0], y + this.shift[1]);
    const reach = this.collage.reach(k) * this.view.zoom;
    const { width, height } = this.view.size;
    return at.x < -reach || at.y < -reach || at.x > width + reach || at.y > height + reach;
  }

  drawMarks() {
    const { collage, choice, colours } = this;
    const state = collage.state;
    if (!collage.hasPoses) return;
    if (state && !state.moving) for (const id of state.entangled) this.outlineOf(id, colours.bad, 2.5);
    if (choice.hovered !== null && !choice.has(choice.hovered)) this.outlineOf(choice.hovered, colours.hover, 1.5);
    for (const id of choice.ids) this.outlineOf(id, colours.accent, 2);
    for (const item of collage.items) if (item.held.some(Boolean)) this.drawPin(item.id);
    this.drawHandles();
    this.cropping?.draw(this.pen);
    this.room?.draw(this.pen);
    this.forces?.paint(this.pen);
    this.sketch?.paint(this.pen);
    this.lasso?.paint(this.pen);
    this.drawGuides();
    if (this.marquee) this.drawMarquee(this.marquee);
  }

  /**
   * @param {number} id
   * @param {string} colour
   * @param {number} width
   */
  outlineOf(id, colour, width) {
    const k = this.collage.rows.get(id);
    if (k === undefined) return;
    const { tiling } = this.collage;
    this.pen.save();
    if (tiling.repeat) this.clip(tiling.box);
    this.atImages(k, () => this.outlineImage(k, colour, width));
    this.pen.restore();
  }

  /** @param {number} k @param {string} colour @param {number} width */
  outlineImage(k, colour, width) {
    const item = this.collage.items[k];
    const scale = this.toItem(k, item);
    const path = this.collage.look(item).outlinePath;
    const pixel = 1 / (this.view.zoom * Math.max(scale, 1e-9));
    this.pen.lineJoin = "round";
    // A light rim under the line: no colour stands out from every drawing.
    for (const [ink, wide] of /** @type {const} */ ([[this.colours.handle, width + 2.5], [colour, width]])) {
      this.pen.strokeStyle = ink;
      this.pen.lineWidth = wide * pixel;
      this.pen.stroke(path);
    }
  }

  /** @param {number} id */
  drawPin(id) {
    const [item, pose] = [this.collage.item(id), this.collage.pose(id)];
    if (!item || !pose) return;
    const { pen, colours } = this;
    const [width, height] = this.collage.look(item).size;
    const [top, , , bottom] = this.collage.corners(id);
    const isRead = item.is_word || width > WORDLIKE * height;
    const middle = this.view.toScreen(pose.x, pose.y);
    const end = isRead ? this.view.toScreen((top[0] + bottom[0]) / 2, (top[1] + bottom[1]) / 2) : middle;
    const [across, down] = [end.x - middle.x, end.y - middle.y];
    // Before the first letter, and not on it.
    const out = PIN / Math.max(Math.hypot(across, down), 1);
    const [x, y] = [end.x + out * across, end.y + out * down];
    this.toWindow();
    pen.beginPath();
    pen.arc(x, y, PIN, 0, 2 * Math.PI);
    pen.fillStyle = colours.pin;
    pen.fill();
    pen.strokeStyle = colours.onPin;
    pen.lineWidth = 1.5;
    pen.stroke();
    pen.fillStyle = colours.onPin;
    pen.fill(new Path2D(`M${x - 3} ${y - 5}h6l-1 4 2.500 2.500h-9L${x - 2} ${y - 1}z`));
    pen.fillRect(x - 0.75, y + 1, 1.5, 4.5);
  }

  toWindow() {
    this.pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
  }

  /**
   * Handles of what is chosen: at the corners of its box, and one to turn it by.
   * @returns {Handle[]}
   */
  handles() {
    const frame = this.frame();
    if (!frame) return [];
    const [a, b, c, d] = frame;
    const [ux, uy] = unit(d, a);
    const top = [(a[0] + b[0]) / 2 + TURN_AWAY * ux, (a[1] + b[1]) / 2 + TURN_AWAY * uy];
    const corners = kindOf(this.collage).sizes ? [a, b, c, d] : [];
    if (!kindOf(this.collage).moves) return [];
    return [
      ...corners.map((at, corner) => ({ at, kind: /** @type {const} */ ("scale"), corner })),
      { at: /** @type {[number, number]} */ (top), kind: "turn", corner: -1 },
    ];
  }

  /**
   * Corners of the frame about what is chosen, px: of one item turned with it.
   * @returns {[number, number][] | null}
   */
  frame() {
    const { choice, collage, view } = this;
    if (!choice.ids.size || !collage.hasPoses) return null;
    const only = choice.ids.size === 1 ? [...choice.ids][0] : null;
    if (only !== null) {
      const corners = collage.corners(only);
      return corners.length ? corners.map(([x, y]) => point(view.toScreen(x, y))) : null;
    }
    const box = collage.box(choice.ids);
    if (!box) return null;
    const [left, top, right, bottom] = box;
    return [[left, top], [right, top], [right, bottom], [left, bottom]].map(([x, y]) => point(view.toScreen(x, y)));
  }

  drawHandles() {
    if (this.choice.isBusy || this.cropping?.isOn) return;
    const { pen, colours } = this;
    const frame = this.frame();
    const handles = this.handles();
    if (!frame || !handles.length) return;
    this.toWindow();
    pen.strokeStyle = colours.accent;
    pen.lineWidth = 1;
    pen.setLineDash([4, 3]);
    pen.beginPath();
    frame.forEach(([x, y], k) => (k ? pen.lineTo(x, y) : pen.moveTo(x, y)));
    pen.closePath();
    const [a, b] = frame;
    const turn = handles[handles.length - 1].at;
    pen.moveTo((a[0] + b[0]) / 2, (a[1] + b[1]) / 2);
    pen.lineTo(...turn);
    pen.stroke();
    pen.setLineDash([]);
    const half = Math.min(Math.max(Math.hypot(b[0] - a[0], b[1] - a[1]) / 8, LEAST_HALF), HALF);
    for (const { at, kind } of handles) this.drawHandle(at, kind, half);
  }

  /**
   * @param {[number, number]} at
   * @param {"scale" | "turn"} kind
   * @param {number} half
   */
  drawHandle([x, y], kind, half) {
    const { pen, colours } = this;
    pen.beginPath();
    if (kind === "turn") pen.arc(x, y, half + 0.5, 0, 2 * Math.PI);
    else pen.rect(x - half, y - half, 2 * half, 2 * half);
    pen.fillStyle = colours.handle;
    pen.fill();
    pen.strokeStyle = colours.accent;
    pen.lineWidth = 1.75;
    pen.stroke();
  }

  /** Lines that a drag has snapped to. */
  drawGuides() {
    const { pen, view, colours } = this;
    this.toWindow();
    pen.strokeStyle = colours.accent;
    pen.lineWidth = 1.25;
    for (const { axis, at, from, to } of this.snapping.guides) {
      const ends = [from, to].map((far) => point(axis ? view.toScreen(far, at) : view.toScreen(at, far)));
      pen.beginPath();
      pen.moveTo(...ends[0]);
      pen.lineTo(...ends[1]);
      pen.stroke();
    }
  }

  /** @param {[number, number, number, number]} box */
  drawMarquee([left, top, right, bottom]) {
    const { pen, colours } = this;
    this.toWindow();
    pen.fillStyle = colours.marquee;
    pen.fillRect(left, top, right - left, bottom - top);
    pen.strokeStyle = colours.accent;
    pen.lineWidth = 1;
    pen.strokeRect(left + 0.5, top + 0.5, right - left, bottom - top);
  }

  /**
   * The topmost item at a point of the window; near misses count for small ones.
   * @param {number} x
   * @param {number} y
   * @param {number} reach px
   * @returns {number | null}
   */
  itemAt(x, y, reach = 3) {
    const { collage, view } = this;
    if (!collage.hasPoses) return null;
    const at = view.toCanvas(x, y);
    for (let k = collage.items.length - 1; k >= 0; k--) {
      const found = collage.tiling.shifts(k).find(([dx, dy]) => this.isOn(k, { x: at.x - dx, y: at.y - dy }, reach));
      if (!found) continue;
      this.hit = found;
      return collage.items[k].id;
    }
    return null;
  }

  /** Whether a point lies on the item of a row, or near it. @param {number} k @param {{x: number, y: number}} at @param {number} reach px */
  isOn(k, at, reach) {
    const { collage, view } = this;
    const item = collage.items[k];
    const look = collage.looks.get(item.shape);
    if (!look) return false;
    const [x, y, angle, scale] = collage.shown.subarray(4 * k, 4 * k + 4);
    if (Math.hypot(at.x - x, at.y - y) > collage.reach(k) + reach / view.zoom) return false;
    const own = matrixOf({ x, y, angle, scale }, item.stretch).invertSelf().transformPoint(at);
    this.pen.resetTransform();
    this.pen.lineWidth = (2 * reach) / (view.zoom * scale);
    const path = look.outlinePath;
    return this.pen.isPointInPath(path, own.x, own.y) || this.pen.isPointInStroke(path, own.x, own.y);
  }

  /** The same, to be taken: that image of it which is there is the item from now on. @param {number} x @param {number} y @param {number} [reach] px */
  take(x, y, reach) {
    const { collage } = this;
    const id = this.itemAt(x, y, reach);
    if (id !== null) collage.tiling.move(collage.rows.get(id) ?? 0, this.hit);
    return id;
  }

  /**
   * The handle at a point of the window; a side of the frame is one too, but for fingers and where other items lie.
   * @param {number} x
   * @param {number} y
   * @param {number} reach px
   */
  handleAt(x, y, reach) {
    const frame = this.frame() ?? [];
    // Handles of what is small are all within reach of a finger on its middle, which drags it.
    const middle = [0, 1].map((axis) => frame.reduce((sum, at) => sum + at[axis] / frame.length, 0));
    const far = Math.min(reach, Math.hypot(middle[0] - x, middle[1] - y));
    const handles = this.handles();
    const sides = reach > MOST_REACH || handles.length < 4 ? [] : handles.slice(0, 4);
    const near = Math.min(SIDE, far / 4);
    const found = handles.find(({ at }) => Math.hypot(at[0] - x, at[1] - y) <= far);
    const side = found ? null : sides.find(({ at }, k) => distance([x, y], at, handles[(k + 1) % 4].at) <= near);
    const under = side ? this.itemAt(x, y, 1) : null;
    return side && (under === null || this.choice.has(under)) ? { ...side, isSide: true } : found ?? null;
  }
}

/** @param {{x: number, y: number}} at @returns {[number, number]} */
function point({ x, y }) {
  return [x, y];
}

/** @param {[number, number]} from @param {[number, number]} to @returns {[number, number]} */
function unit(from, to) {
  const [x, y] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(x, y) || 1;
  return [x / length, y / length];
}
