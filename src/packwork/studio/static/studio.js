// @ts-check
/** The page: its parts, and what passes between them. */

import { actionsOf } from "./actions.js";
import { Badge } from "./badge.js";
import { Bar } from "./bar.js";
import { Choice } from "./choice.js";
import { Clipboard } from "./clipboard.js";
import { Collage } from "./collage.js";
import { Connection } from "./connection.js";
import { Cropping } from "./cropping.js";
import { byId } from "./dom.js";
import { Dropping } from "./dropping.js";
import { Exporting } from "./exporting.js";
import { Forces } from "./forces.js";
import { Gestures } from "./gestures.js";
import { Hand, together } from "./hand.js";
import { Incoming } from "./incoming.js";
import { listenToKeys } from "./keys.js";
import { kindOf } from "./kinds.js";
import { Lasso } from "./lasso.js";
import { Menu } from "./menu.js";
import { Ordering } from "./ordering.js";
import { Outage } from "./outage.js";
import { Palette } from "./palette.js";
import { Panels } from "./panels.js";
import { Replacing } from "./replacing.js";
import { Room } from "./room.js";
import { Sketch } from "./sketch.js";
import { Sprites } from "./sprites.js";
import { Stage } from "./stage.js";
import { Start } from "./start.js";
import { forgetThumbs } from "./thumbs.js";
import { hush, say, tell } from "./toasts.js";
import { Variants } from "./variants.js";
import { View } from "./view.js";

/** @typedef {import("./wire.js").Said} Said */
/** @typedef {import("./connection.js").Frame} Frame */

/** Least width at which panels stand beside the canvas, px, as in studio.css. */
const WIDE = 700;
/** What is left free beside the canvas, and above it for the bar of what is chosen, px. */
const MARGIN = 28;
const ABOVE = 62;
/** What the focus can be on. */
const FOCUSABLE = ":is(button, input, select, textarea):not(:disabled)";
/** Subject of the line about what was asked for and not had. */
const MISSED = "not as asked";
/** Beginning and subject of lines about what was asked for and taken back. */
const BACK = "taken back";
/** Said where words on lines are dragged. */
const STAYS = "Words on lines lie where these have room for them; change the words, or the lines, on the Words panel.";

export class Studio {
  constructor() {
    this.isCalm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.canvas = /** @type {HTMLCanvasElement} */ (byId("canvas"));
    this.collage = new Collage();
    this.connection = new Connection({
      said: (message) => this.said(message),
      frame: (frame) => this.framed(frame),
      changed: (isOpen, isStranger) => this.connected(isOpen, isStranger),
      taken: (isTaken) => (byId("taken").hidden = !isTaken),
    });
    byId("join").addEventListener("click", () => this.connection.join());
    this.view = new View(() => this.redraw());
    this.choice = new Choice(() => this.chosen());
    this.sprites = new Sprites(() => this.redraw());
    this.stage = new Stage(this.canvas, this.collage, this.view, this.sprites, this.choice);
    this.room = this.stage.room = new Room(this.stage, this.connection);
    this.cropping = this.stage.cropping = new Cropping(this.stage, this.connection);
    this.hand = new Hand(this.collage, this.connection);
    this.gestures = new Gestures(this.stage, this.view, this.choice, this.hand, {
      changed: () => this.redraw(),
      stays: () => tell(STAYS, { about: STAYS }),
      menu: (x, y) => this.menu.open(x, y + this.canvas.getBoundingClientRect().top, this.choice.ids.size > 0),
    });
    this.dropping = new Dropping(this.connection, this.collage);
    this.clipboard = new Clipboard(this);
    this.ordering = new Ordering(this);
    this.exporting = new Exporting(this.connection, this.collage, this.dropping, () => this.panels.load());
    const actions = actionsOf(this);
    this.actions = new Map(actions.map((action) => [action.id, action]));
    this.bar = new Bar(this.actions, {
      recolour: (colour, ids) => this.recolour(colour, ids),
      chosen: () => [...this.choice.ids],
      entitle: (title) => this.connection.do({ kind: "entitle", title }),
      files: (x, y) => this.menu.openFiles(x, y),
    });
    this.outage = new Outage();
    this.badge = new Badge({ show: (ids) => this.showItems(ids), stop: () => this.connection.send({ type: "stop" }) });
    this.palette = new Palette(actions);
    this.menu = new Menu(this.actions);
    this.variants = new Variants(this);
    this.forces = this.stage.forces = new Forces(this);
    this.sketch = this.stage.sketch = new Sketch(this);
    this.lasso = this.stage.lasso = new Lasso(this);
    this.panels = new Panels(this);
    this.words = this.panels.words;
    this.incoming = new Incoming(this);
    this.start = new Start(this);
    /** Number of the document that is open, as the studio counts them. */
    this.document = 1;
    /** Whether templates were offered on this page, where nothing else was there. */
    this.wasOffered = false;
    /** What was told as asked for and not had. @type {Record<string, string>} */
    this.missed = {};
    this.back = "";
    this.dropping.takes = (files) => this.incoming.take(files);
    this.replacing = new Replacing(this);
    listenToKeys(actions, { pans: (isHeld) => (this.gestures.isPanning = isHeld) });
    /** Whether this person has once taken an item: then nothing has to be explained. */
    this.isKnown = localStorage.getItem("known") !== null;
    /** Whether what is shown is on its way to where it is. */
    this.isEasing = false;
    this.isDirty = false;
    this.shownWork = "";
    this.last = 0;
    this.listen();
  }

  listen() {
    addEventListener("resize", () => this.resized());
    new ResizeObserver(() => this.resized()).observe(this.canvas);
    const dark = matchMedia("(prefers-color-scheme: dark)");
    dark.addEventListener("change", () => this.themed());
    matchMedia("(prefers-reduced-motion: reduce)").addEventListener("change", (event) => (this.isCalm = event.matches));
  }

  begin() {
    const theme = localStorage.getItem("theme");
    if (theme) document.documentElement.dataset.theme = theme;
    this.themed();
    this.resized();
    this.connection.open();
    this.refresh();
    if (innerWidth >= 1000) this.panels.toggle("items");
  }

  /** @param {Said} message */
  said(message) {
    if (message.type === "shapes") this.shapes(message.shapes ?? [], message.gone ?? []);
    else if (message.type === "scene") this.changed(message);
    else if (message.type === "state") this.stated(message);
    else if (message.type === "variant") this.variants.add(message);
    else {
      if (message.is_error) this.panels.refused();
      tell(message.text, { isError: message.is_error });
    }
  }

  /** @param {import("./wire.js").Shape[]} added @param {string[]} gone keys of those that no scene has any more */
  shapes(added, gone) {
    this.collage.addShapes(added);
    for (const key of gone) this.collage.looks.delete(key);
    this.sprites.forget(gone);
    forgetThumbs(gone);
  }

  /** @param {import("./wire.js").Scene} scene */
  changed(scene) {
    const before = this.collage.scene;
    this.collage.setScene(scene);
    this.choice.keep(this.collage.rows);
    this.room.refresh();
    if (!before || before.width !== scene.width || before.height !== scene.height) this.dropping.sheet = null;
    this.seen();
    document.title = `${scene.title} – Packwork studio`;
    this.refresh();
  }

  /** Have all in view that is to be seen of the plane. */
  seen() {
    const { view, collage } = this;
    const [was, now] = [view.whole, collage.tiling.whole];
    if (was.x === now.x && was.width === now.width && was.height === now.height) return;
    view.whole = now;
    view.fit(false);
  }

  /** @param {import("./wire.js").State} state */
  stated(state) {
    const before = this.collage.state;
    // What was missed is told when gaps are closed: meanwhile it comes and goes.
    if (state.polishing && before && !before.busy) state = { ...state, unmet: before.unmet };
    this.collage.state = state;
    if (state.document !== this.document) this.opened(state.document ?? 0);
    if (state.fresh && !this.wasOffered) this.start.open();
    this.wasOffered = true;
    this.badge.show(state);
    if (!state.moving) this.tellMissed(state.unmet);
    const back = state.moving ? "" : state.advice.find((line) => line.startsWith(BACK)) ?? "";
    if (before && back && back !== this.back) {
      tell(back, { about: BACK });
      this.panels.refused();
    }
    this.back = back;
    if (!before || before.can_undo !== state.can_undo || before.can_redo !== state.can_redo || before.busy !== state.busy || before.saved !== state.saved) this.refresh();
    this.redraw();
  }

  /** Forget what is of no other document. @param {number} document its number */
  opened(document) {
    this.document = document;
    this.choice.set([]);
    this.variants.clear();
    this.forces.places.clear();
    this.words.opened();
    this.panels.repeating.opened();
  }

  /**
   * Tell what was asked for and not had: one line for all, as long as there is any.
   * @param {Record<string, string>} unmet
   */
  tellMissed(unmet) {
    const fresh = Object.keys(unmet).filter((number) => !(number in this.missed));
    const more = Object.keys(unmet).length - 1;
    const act = more > 0 ? { label: `And ${more} more`, run: () => this.badge.open() } : undefined;
    if (more < 0) hush(MISSED);
    else if (fresh.length) tell(unmet[fresh[0]], { about: MISSED, act });
    this.missed = unmet;
  }

  /** @param {Frame} frame */
  framed(frame) {
    const isFirst = !this.collage.hasPoses;
    const state = this.collage.state;
    this.collage.setFrame(frame);
    // What is said of the last layout is not true of this one.
    if (frame.moving && state && !state.moving) this.stated({ ...state, moving: true, busy: "Making room", polishing: false, certified: false, entangled: [] });
    this.isEasing = true;
    // The next one may come while this one is drawn: of several the newest is shown.
    this.connection.send({ type: "ack", frame: frame.number });
    if (isFirst) this.refresh();
    this.redraw();
  }

  /** @param {boolean} isOpen @param {boolean} isStranger */
  connected(isOpen, isStranger) {
    if (isOpen) this.outage.over();
    else this.outage.tell(isStranger, this.connection.isTaken);
    this.badge.connected(isOpen);
    if (!isOpen) this.lost();
  }

  /** Forget what the hand has: the studio may come back without it. */
  lost() {
    this.collage.state = null;
    this.hand.began.clear();
    this.panels.items.inspector.sent.clear();
    this.panels.look.ground.sent = 0;
    this.collage.hand.clear();
    this.gestures.cancel();
  }

  chosen() {
    const count = this.choice.ids.size;
    const [id] = this.choice.ids;
    if (count) this.learnt(count === 1 ? `${this.collage.item(id)?.name} chosen` : `${count} items chosen`);
    this.refresh();
  }

  /** @param {string} text what a screen reader says of it */
  learnt(text) {
    say(text);
    this.isKnown = true;
    localStorage.setItem("known", "yes");
  }

  /** Bring all but the canvas up to how things are. */
  refresh() {
    const count = this.choice.ids.size;
    const [id] = this.choice.ids;
    const name = count === 1 ? this.collage.item(id)?.name ?? "" : count ? `${count} items` : "";
    this.bar.show(this.collage.scene?.title ?? "", name, this.collage.state?.saved ?? false, this.collage.colour(id), this.work);
    this.bar.rename("pour", kindOf(this.collage).again);
    byId("empty").hidden = this.collage.hasPoses;
    byId("hint").hidden = !this.collage.hasPoses || count > 0 || this.room.isOn || this.isKnown || !kindOf(this.collage).moves;
    if (this.collage.scene) byId("empty-text").textContent = "Pouring …";
    this.panels.refresh();
    this.redraw();
  }

  /** What the hand is to do now, if that is something of its own; by fingers too it can be left off. */
  get work() {
    if (this.cropping.isOn) return "The picture in its frame";
    return this.gestures.drawer?.asks ?? (this.room.isOn ? "The container" : "");
  }

  redraw() {
    if (this.isDirty) return;
    this.isDirty = true;
    requestAnimationFrame((now) => this.draw(now));
  }

  /** @param {number} now */
  draw(now) {
    this.isDirty = false;
    if (this.shownWork !== this.work) this.refresh();
    this.shownWork = this.work;
    const passed = Math.min(now - this.last, 100);
    this.last = now;
    const moves = this.collage.hasPoses && this.collage.ease(passed, this.isCalm);
    this.isEasing &&= moves;
    const glides = this.view.step();
    const lacks = this.sprites.begin();
    const isMoving = moves || this.hand.isFull || Boolean(this.collage.state?.moving);
    // Gaps are closed in many small moves: all is drawn once, after the last.
    const isCoarse = isMoving || Boolean(this.collage.state?.polishing);
    const isLast = this.stage.draw(isCoarse);
    if (isCoarse) this.panels.items.inspector.followSoon();
    else this.panels.items.inspector.follow();
    if (moves || glides || lacks || this.sprites.left < 0 || !(isLast || isMoving)) this.redraw();
  }

  resized() {
    const box = this.canvas.getBoundingClientRect();
    const isWide = innerWidth >= WIDE;
    const panel = byId("panel").hidden ? { width: 0, height: 0 } : byId("panel").getBoundingClientRect();
    const size = { width: box.width, height: box.height, top: ABOVE };
    if (isWide) Object.assign(this.view.size, size, { left: 76 + (panel.width && panel.width + 44), right: MARGIN, bottom: 72 });
    else Object.assign(this.view.size, size, { left: 12, right: 12, bottom: 122 + (panel.height && panel.height + 16) });
    this.stage.resize();
    this.view.refit();
  }

  themed() {
    this.stage.recolour();
    this.redraw();
  }

  /** Show silhouettes in place of drawings, or drawings again. */
  toggleFaults() {
    this.stage.showsFaults = !this.stage.showsFaults;
    document.body.classList.toggle("with-faults", this.stage.showsFaults);
    say(this.stage.showsFaults ? "Orange is free, grey is covered, darker is covered twice" : "Drawings again");
    this.redraw();
  }

  toggleTheme() {
    const isDark = getComputedStyle(document.documentElement).colorScheme.startsWith("dark");
    const theme = isDark ? "light" : "dark";
    document.documentElement.dataset.theme = theme;
    localStorage.setItem("theme", theme);
    this.themed();
  }

  /** Ask for the document's name: a phone has no room for its field. */
  rename() {
    const title = prompt("Name of the document", this.collage.scene?.title ?? "")?.trim().slice(0, 200);
    if (title) this.connection.do({ kind: "entitle", title });
  }

  pour() {
    this.connection.send({ type: "pour", seed: Math.floor(Math.random() * 2 ** 31) });
  }

  /** Have the container in the hand, or no longer. */
  editRoom() {
    this.room.turnOn(!this.room.isOn);
    if (this.room.isOn) this.choice.set([]);
    say(this.room.isOn ? "The container's frame and points can be dragged; N and P choose a point, arrows move it" : "The items again");
    this.refresh();
  }

  /** Have the focus in the next part of the page. @param {number} step */
  goRound(step) {
    const parts = ["bar", "canvas", "choice", "tabs", "panel", "foot"].map(byId);
    const stops = parts.map((part) => (part === this.canvas ? [part] : [...part.querySelectorAll(FOCUSABLE)]).find((one) => one.checkVisibility({ visibilityProperty: true })));
    const there = parts.filter((_, k) => stops[k]);
    const at = there.findIndex((one) => one.contains(document.activeElement));
    const next = there[(at < 0 && step < 0 ? there.length - 1 : at + step + there.length) % there.length];
    const stop = stops[parts.indexOf(next)];
    if (stop instanceof HTMLElement) stop.focus();
  }

  /** @param {number} step */
  chooseNext(step) {
    const { items, rows } = this.collage;
    if (this.room.isOn) {
      say(this.room.next(step));
      return this.redraw();
    }
    if (!items.length) return;
    const [id] = this.choice.ids;
    const at = id === undefined ? (step > 0 ? -1 : 0) : rows.get(id) ?? 0;
    this.choice.set([items[(at + step + items.length) % items.length].id]);
  }

  chooseAlike() {
    const names = new Set([...this.choice.ids].map((id) => this.collage.item(id)?.name));
    this.choice.set(this.collage.items.filter((item) => names.has(item.name)).map((item) => item.id));
  }

  /** Have the photograph that is chosen in the hand within its frame, or keep it as it is there. */
  crop() {
    if (this.cropping.isOn) this.cropping.end(true);
    else this.cropping.begin([...this.choice.ids][0] ?? null);
    this.redraw();
  }

  /** Whether one photograph is chosen, or in the hand within its frame. */
  get crops() {
    const [id] = this.choice.ids;
    return this.cropping.isOn || (this.choice.ids.size === 1 && Boolean(this.collage.item(id)?.crop));
  }

  escape() {
    if (this.cropping.isOn) {
      this.cropping.end(false);
      return this.redraw();
    }
    if (this.gestures.cancel()) return;
    if (document.activeElement?.closest("#panel, #title")) this.canvas.focus();
    else if (this.room.isOn) this.editRoom();
    else this.choice.set([]);
  }

  /** Put what is chosen in the middle of the canvas. */
  toMiddle() {
    const [item] = this.choice.ids;
    const { x, y, width, height } = this.view.whole;
    this.connection.do({ kind: "move", item, x: x + width / 2, y: y + height / 2 });
  }

  get held() {
    return [...this.choice.ids].map((id) => this.collage.item(id)?.held.some(Boolean) ?? false);
  }

  get areHeld() {
    return this.held.length > 0 && this.held.every(Boolean);
  }

  get anyHeld() {
    return this.held.some(Boolean);
  }

  /** @param {boolean} isHeld */
  hold(isHeld) {
    this.connection.do({ kind: isHeld ? "hold" : "release", items: [...this.choice.ids] });
  }

  duplicate() {
    this.choice.expect(this.collage.rows);
    this.connection.do(together([...this.choice.ids].map((item) => ({ kind: "duplicate", item }))));
  }

  /** Groups among what is chosen. */
  get groups() {
    return [...this.choice.ids].filter((id) => this.collage.item(id)?.parts);
  }

  /** Make one item of what is chosen, or take groups apart. @param {boolean} isJoined */
  group(isJoined) {
    this.choice.expect(this.collage.rows);
    this.connection.do(isJoined ? { kind: "group", items: [...this.choice.ids] } : { kind: "ungroup", items: this.groups });
  }

  /** @param {"horizontal" | "vertical"} direction */
  flip(direction) {
    this.connection.do({ kind: "flip", items: [...this.choice.ids], direction });
  }

  /** Have the numbers of what is chosen under the cursor. */
  async inspect() {
    if (this.panels.current !== "items") await this.panels.toggle("items");
    this.panels.items.inspector.focus();
  }

  /** Look for items by name. */
  async find() {
    if (this.panels.current !== "items") await this.panels.toggle("items");
    this.panels.items.query.focus();
    this.panels.items.query.select();
  }

  exchange() {
    const [first, second] = this.choice.ids;
    this.connection.do({ kind: "exchange", first, second });
  }

  remove() {
    if (!kindOf(this.collage).moves) return this.words.leaveOut([...this.choice.ids]);
    this.connection.do({ kind: "remove", items: [...this.choice.ids] });
    this.choice.set([]);
  }

  /** @param {string} colour @param {number[]} ids */
  recolour(colour, ids) {
    const items = ids.filter((id) => this.collage.rows.has(id));
    if (items.length) this.connection.do({ kind: "recolour", items, colour });
  }

  /** @param {number} factor */
  resize(factor) {
    if (this.cropping.isOn) {
      this.cropping.zoom(factor);
      return this.redraw();
    }
    if (this.room.isOn) return this.room.change({ factor });
    this.connection.do(together([...this.choice.ids].map((item) => ({ kind: "scale", item, factor }))));
  }

  /** @param {number} degrees */
  turn(degrees) {
    if (this.room.isOn) return this.room.change({ angle: degrees });
    const turns = [...this.choice.ids].map((item) => {
      return { kind: "turn", item, angle: (this.collage.turned(item, (degrees * Math.PI) / 180) * 180) / Math.PI };
    });
    this.connection.do(together(turns));
  }

  /**
   * Move what is chosen by shares of the canvas, or else the canvas itself.
   * @param {number} x
   * @param {number} y
   */
  nudge(x, y) {
    const { width, height } = this.collage.scene ?? this.view.whole;
    const side = Math.max(width, height);
    if (this.cropping.isOn) {
      this.cropping.move(x, y);
      return this.redraw();
    }
    if (this.room.isOn) return this.room.nudge(side * x, side * y);
    if (!this.choice.ids.size) return this.view.pan(-10 * side * x * this.view.zoom, -10 * side * y * this.view.zoom);
    const moves = [...this.choice.ids].map((item) => {
      const row = 4 * (this.collage.rows.get(item) ?? 0);
      return { kind: "move", item, x: this.collage.poses[row] + side * x, y: this.collage.poses[row + 1] + side * y };
    });
    this.connection.do(together(moves));
  }

  showChosen() {
    this.showItems([...this.choice.ids]);
  }

  /** @param {number[]} ids */
  showItems(ids) {
    const box = this.collage.box(ids);
    if (box) this.view.show(box);
    this.choice.set(ids);
  }
}
