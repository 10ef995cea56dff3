// @ts-check
/** All that can be asked for by button, key, menu and palette: each stands here once. */

import { kindOf } from "./kinds.js";
import { PANELS } from "./panels.js";

/** @typedef {import("./dom.js").IconName} IconName */
/**
 * @typedef {{id: string, label: string, keys: string[], run: () => void, icon?: IconName,
 *   group: "Edit" | "Choose" | "Items" | "View" | "File", when?: () => boolean, repeats?: boolean, isNative?: boolean}} Action
 * `isNative`: its keys are the browser's own, which tells of them by another event.
 */

/** How far an arrow key moves, as a share of the canvas; with shift. */
const NUDGE = 0.004;
const NUDGE_FAR = 0.04;
/** Degrees that a key turns. */
const TURN = 5;
/** Factor by which a key makes larger. */
const LARGER = 1.08;

/**
 * @param {import("./studio.js").Studio} studio
 * @returns {Action[]}
 */
export function actionsOf(studio) {
  return [...edits(studio), ...choosing(studio), ...items(studio), ...lines(studio), ...nudges(studio), ...views(studio), ...files(studio)];
}

/** @param {import("./studio.js").Studio} studio @returns {Action[]} */
function edits(studio) {
  const { connection, collage } = studio;
  return [
    { id: "undo", group: "Edit", label: "Undo", keys: ["Mod+Z"], icon: "undo", repeats: true,
      when: () => Boolean(collage.state?.can_undo), run: () => connection.leap("undo") },
    { id: "redo", group: "Edit", label: "Redo", keys: ["Mod+Shift+Z", "Mod+Y"], icon: "redo", repeats: true,
      when: () => Boolean(collage.state?.can_redo), run: () => connection.leap("redo") },
    { id: "pour", group: "Edit", label: "Pour anew", keys: ["R"], icon: "pour",
      when: () => collage.hasPoses, run: () => studio.pour() },
    { id: "stop", group: "Edit", label: "Stop what takes long", keys: ["Shift+Escape"],
      when: () => Boolean(collage.state?.can_stop), run: () => connection.send({ type: "stop" }) },
  ];
}

/** @param {import("./studio.js").Studio} studio @returns {Action[]} */
function choosing(studio) {
  const { choice, collage } = studio;
  return [
    { id: "next", group: "Choose", label: "Choose the next item", keys: ["N"], repeats: true, run: () => studio.chooseNext(1) },
    { id: "previous", group: "Choose", label: "Choose the previous item", keys: ["P"], repeats: true, run: () => studio.chooseNext(-1) },
    { id: "all", group: "Choose", label: "Choose all", keys: ["Mod+A"], run: () => choice.set(collage.items.map((item) => item.id)) },
    { id: "alike", group: "Choose", label: "Choose all of the same name", keys: ["A"], when: () => choice.ids.size > 0,
      run: () => studio.chooseAlike() },
    { id: "lasso", group: "Choose", label: "Choose by a line drawn round them", keys: ["Q"], when: () => collage.hasPoses, run: () => studio.lasso.begin() },
    { id: "lasso-more", group: "Choose", label: "Choose more by a line", keys: ["Shift+Q"], when: () => choice.ids.size > 0, run: () => studio.lasso.begin(true) },
    { id: "find", group: "Choose", label: "Find items by name", keys: ["/"], run: () => studio.find() },
    { id: "none", group: "Choose", label: "Choose nothing, or leave off", keys: ["Escape"], icon: "close", run: () => studio.escape() },
  ];
}

/** @param {import("./studio.js").Studio} studio @returns {Action[]} */
function items(studio) {
  const { choice } = studio;
  const when = () => choice.ids.size > 0;
  const moves = () => kindOf(studio.collage).moves;
  const turns = () => (when() && moves()) || studio.room.isOn;
  const orders = () => studio.collage.hasPoses && kindOf(studio.collage).orders;
  const grows = () => when() && kindOf(studio.collage).grows;
  const edge = () => studio.collage.hasPoses && kindOf(studio.collage).edge;
  const sizes = () => (when() && kindOf(studio.collage).sizes) || studio.room.isOn;
  return [
    { id: "edit-room", group: "Items", label: "Edit the container, or leave off", keys: ["C"], icon: "shape", when: edge, run: () => studio.editRoom() },
    { id: "hold", group: "Items", label: "Hold", keys: ["H"], icon: "pin", when: () => when() && moves() && !studio.areHeld, run: () => studio.hold(true) },
    { id: "release", group: "Items", label: "Release", keys: ["Shift+H"], icon: "release", when: () => studio.anyHeld, run: () => studio.hold(false) },
    { id: "duplicate", group: "Items", label: "Duplicate", keys: ["Mod+D", "D"], icon: "copy", when: grows, run: () => studio.duplicate() },
    { id: "copy", group: "Items", label: "Copy", keys: ["Mod+C"], isNative: true, when, run: () => studio.clipboard.ask("copy") },
    { id: "cut", group: "Items", label: "Cut", keys: ["Mod+X"], isNative: true, when, run: () => studio.clipboard.ask("cut") },
    { id: "paste", group: "Items", label: "Paste", keys: ["Mod+V"], isNative: true, when: () => studio.collage.hasPoses && kindOf(studio.collage).grows, run: () => studio.clipboard.askPaste() },
    { id: "middle", group: "Items", label: "Put it in the middle", keys: ["M"], when: () => choice.ids.size === 1 && moves(), run: () => studio.toMiddle() },
    { id: "inspect", group: "Items", label: "Its numbers: place, size and angle", keys: ["I"], icon: "options", when, run: () => studio.inspect() },
    { id: "flip", group: "Items", label: "Flip left and right", keys: ["Shift+F"], icon: "flip", when: () => when() && moves(), run: () => studio.flip("horizontal") },
    { id: "flip-down", group: "Items", label: "Flip top and bottom", keys: ["Shift+V"], icon: "flipDown", when: () => when() && moves(), run: () => studio.flip("vertical") },
    { id: "crop", group: "Items", label: "Move the photograph in its frame, or keep it", keys: ["Enter"], icon: "crop", when: () => studio.crops, run: () => studio.crop() },
    { id: "keep", group: "Items", label: "Keep the photograph so", keys: [], icon: "check", when: () => studio.cropping.isOn, run: () => studio.crop() },
    { id: "replace", group: "Items", label: "Replace …", keys: ["Shift+R"], icon: "replace", when: () => when() && moves(), run: () => studio.replacing.open() },
    { id: "picture", group: "Items", label: "Show a picture by their colours …", keys: ["Shift+P"], when: orders, run: () => studio.dropping.choosePicture() },
    { id: "order", group: "Items", label: "Put them in an order …", keys: ["O"], when: orders, run: () => studio.ordering.open() },
    { id: "like", group: "Items", label: "Like beside like, by a table of vectors …", keys: ["L"], when: orders, run: () => studio.ordering.chooseVectors() },
    { id: "like-by-text", group: "Items", label: "Words that stand together in the text beside each other", keys: ["Shift+L"], when: () => studio.collage.items.some((item) => item.is_word), run: () => studio.ordering.byText() },
    { id: "group", group: "Items", label: "Group: they keep their places to each other", keys: ["Mod+G"], icon: "group", when: () => choice.ids.size > 1 && kindOf(studio.collage).groups, run: () => studio.group(true) },
    { id: "ungroup", group: "Items", label: "Ungroup", keys: ["Mod+Shift+G"], icon: "ungroup", when: () => studio.groups.length > 0, run: () => studio.group(false) },
    { id: "exchange", group: "Items", label: "Exchange the two", keys: ["X"], icon: "swap", when: () => choice.ids.size === 2 && moves(), run: () => studio.exchange() },
    { id: "remove", group: "Items", label: "Remove", keys: ["Delete", "Backspace"], icon: "bin", when, run: () => studio.remove() },
    { id: "larger", group: "Items", label: "Larger", keys: ["+", "="], repeats: true, when: sizes, run: () => studio.resize(LARGER) },
    { id: "smaller", group: "Items", label: "Smaller", keys: ["-"], repeats: true, when: sizes, run: () => studio.resize(1 / LARGER) },
    { id: "clockwise", group: "Items", label: "Turn clockwise", keys: ["."], repeats: true, when: turns, run: () => studio.turn(TURN) },
    { id: "anticlockwise", group: "Items", label: "Turn anticlockwise", keys: [","], repeats: true, when: turns, run: () => studio.turn(-TURN) },
  ];
}

/** What several items are lined up by, with the key beside alt. */
const EDGES = /** @type {const} */ ([["left", "A", "Align left edges"], ["center", "H", "Align middles across"], ["right", "D", "Align right edges"],
  ["top", "W", "Align top edges"], ["middle", "V", "Align middles down"], ["bottom", "S", "Align bottom edges"]]);
const WAYS = /** @type {const} */ ([["horizontal", "H", "Even out distances across", "across"], ["vertical", "V", "Even out distances down", "down2"]]);
export const LINES = [...EDGES.map(([to]) => `align-${to}`), ...WAYS.map(([way]) => `distribute-${way}`)];

/** @param {import("./studio.js").Studio} studio @returns {Action[]} */
function lines(studio) {
  const { choice, connection } = studio;
  const chosen = () => [...choice.ids];
  return [
    ...EDGES.map(([to, key, label]) => ({ id: `align-${to}`, group: /** @type {const} */ ("Items"), label, keys: [`Alt+${key}`], icon: to,
      when: () => choice.ids.size > 1 && kindOf(studio.collage).moves, run: () => connection.do({ kind: "align", items: chosen(), to }) })),
    ...WAYS.map(([direction, key, label, icon]) => ({ id: `distribute-${direction}`, group: /** @type {const} */ ("Items"), label, keys: [`Alt+Shift+${key}`], icon,
      when: () => choice.ids.size > 2 && kindOf(studio.collage).moves, run: () => connection.do({ kind: "distribute", items: chosen(), direction }) })),
  ];
}

/** @param {import("./studio.js").Studio} studio @returns {Action[]} */
function nudges(studio) {
  const ways = [["Left", -1, 0], ["Right", 1, 0], ["Up", 0, -1], ["Down", 0, 1]];
  return ways.flatMap(([name, x, y]) => [["", NUDGE], ["Shift+", NUDGE_FAR]].map(([shift, far]) => ({
    id: `nudge${shift}${name}`, group: /** @type {const} */ ("Items"),
    label: `Move ${String(name).toLowerCase()}${shift ? ", far" : ""}`, keys: [`${shift}Arrow${name}`], repeats: true,
    run: () => studio.nudge(Number(x) * Number(far), Number(y) * Number(far)),
  })));
}

/** @param {import("./studio.js").Studio} studio @returns {Action[]} */
function views(studio) {
  const { view } = studio;
  const edge = () => studio.collage.hasPoses && kindOf(studio.collage).edge;
  const middle = () => /** @type {const} */ ([view.size.width / 2, view.size.height / 2]);
  return [
    { id: "fit", group: "View", label: "Show all", keys: ["0", "Mod+0"], icon: "fit", run: () => view.fit(!studio.isCalm) },
    { id: "closer", group: "View", label: "Zoom in", keys: ["Mod+="], icon: "plus", repeats: true, run: () => view.zoomAt(1.25, ...middle()) },
    { id: "farther", group: "View", label: "Zoom out", keys: ["Mod+-"], icon: "minus", repeats: true, run: () => view.zoomAt(0.8, ...middle()) },
    { id: "chosen", group: "View", label: "Show what is chosen", keys: ["F"], when: () => studio.choice.ids.size > 0, run: () => studio.showChosen() },
    ...PANELS.map(([id, , label], k) => ({ id: `panel-${id}`, group: /** @type {const} */ ("View"), label: `Panel: ${label}`, keys: [String(k + 1)], run: () => studio.panels.goTo(id) })),
    { id: "draw", group: "View", label: "Draw the container freehand", keys: ["K"], when: edge, run: () => studio.sketch.begin(false) },
    { id: "draw-hole", group: "View", label: "Draw a hole in the container", keys: ["Shift+K"], when: edge, run: () => studio.sketch.begin(true) },
    { id: "force", group: "View", label: "Draw a force as an arrow", keys: ["G"], when: () => edge() && kindOf(studio.collage).moves, run: () => studio.forces.begin() },
    { id: "tiles", group: "View", label: "Show three by three tiles, or one", keys: ["Shift+T"], when: () => Boolean(studio.collage.tiling.repeat), run: () => studio.panels.repeating.show(!studio.collage.tiling.isPreview) },
    { id: "faults", group: "View", label: "Show what is free, covered and overlapping", keys: ["V"], icon: "layers", run: () => studio.toggleFaults() },
    { id: "theme", group: "View", label: "Light or dark", keys: ["T"], icon: "theme", run: () => studio.toggleTheme() },
    { id: "onward", group: "View", label: "To the next part of the page", keys: ["F6"], run: () => studio.goRound(1) },
    { id: "back", group: "View", label: "To the part of the page before", keys: ["Shift+F6"], run: () => studio.goRound(-1) },
    { id: "keys", group: "View", label: "All actions and their keys", keys: ["?", "Mod+K"], icon: "help", run: () => studio.palette.open() },
  ];
}

/** @param {import("./studio.js").Studio} studio @returns {Action[]} */
function files(studio) {
  return [
    { id: "export", group: "File", label: "Export", keys: ["Mod+E"], icon: "export", when: () => studio.collage.hasPoses, run: () => studio.exporting.open() },
    { id: "new", group: "File", label: "New, or a recent one", keys: ["Shift+N"], run: () => studio.start.open() },
    { id: "rename", group: "File", label: "Rename …", keys: ["F2"], when: () => studio.collage.hasPoses, run: () => studio.rename() },
    { id: "save", group: "File", label: "Save a copy as a session", keys: ["Mod+S"], when: () => studio.collage.hasPoses, run: () => studio.exporting.download("packwork", {}) },
    { id: "add", group: "File", label: "Open or add files", keys: ["Mod+O"], icon: "file", run: () => studio.dropping.choose() },
    { id: "folder", group: "File", label: "Add a folder", keys: ["Mod+Shift+O"], run: () => studio.dropping.chooseFolder() },
    { id: "room", group: "File", label: "Take a file as the container", keys: ["Shift+O"], run: () => studio.dropping.chooseRoom() },
  ];
}
