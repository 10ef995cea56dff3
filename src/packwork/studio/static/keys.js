// @ts-check
/** Keys to actions, and how keys are written. */

/** @typedef {import("./actions.js").Action} Action */

const IS_MAC = /Mac|iPhone|iPad/.test(navigator.platform);
/** Keys that mean nothing in a field, and do there what they do elsewhere; Escape leaves it as it was. */
const ANYWHERE = new Set(["Mod+E", "Mod+S", "F6", "Shift+F6", "Escape"]);
/** Keys of undo and redo. */
const LEAPS = new Set(["Mod+Z", "Mod+Shift+Z", "Mod+Y"]);
/** @type {Record<string, string>} */
const SHOWN = { ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓", Escape: "Esc", Delete: "Del" };

/**
 * A key as actions name it, `Mod+Shift+Z`.
 * @param {KeyboardEvent} event
 */
export function keyOf(event) {
  // With alt a Mac's keys write other letters.
  const key = event.altKey && event.code.startsWith("Key") ? event.code.slice(3) : event.key.length === 1 ? event.key.toUpperCase() : event.key;
  const isSign = key.length === 1 && !/[a-z0-9 ]/i.test(key);
  const parts = [];
  if (event.ctrlKey || event.metaKey) parts.push("Mod");
  if (event.altKey) parts.push("Alt");
  if (event.shiftKey && !isSign) parts.push("Shift");
  return [...parts, key].join("+");
}

/**
 * How people are shown a key.
 * @param {string} key
 */
export function shownKey(key) {
  const parts = key === "+" ? ["+"] : key.split(/\+(?=.)/);
  return parts.map((part) => (part === "Mod" ? (IS_MAC ? "⌘" : "Ctrl") : SHOWN[part] ?? part)).join(" ");
}

/**
 * Have keys do what actions say, wherever the focus is but in fields.
 * @param {Action[]} actions
 * @param {{pans: (isHeld: boolean) => void}} hears
 */
export function listenToKeys(actions, hears) {
  listenToTyping();
  const known = new Map(actions.flatMap((action) => action.keys.map((key) => [key, action])));
  addEventListener("keydown", (event) => {
    if ((isTyping(event) && !ANYWHERE.has(keyOf(event)) && !leaps(event)) || document.querySelector("dialog[open]")) return;
    if (event.key === " " && isFree(event)) {
      event.preventDefault();
      return hears.pans(true);
    }
    const action = known.get(keyOf(event));
    if (!action || action.isNative || (event.repeat && !action.repeats) || isTaken(event)) return;
    event.preventDefault();
    closeMenu();
    if (event.key === "Escape") giveUp(event.target);
    if (!action.when || action.when()) action.run();
  });
  addEventListener("keyup", (event) => {
    if (event.key === " ") hears.pans(false);
  });
  addEventListener("blur", () => hears.pans(false));
}

/** What fields of one line held before that is being typed in them. @type {WeakMap<EventTarget, string>} */
const before = new WeakMap();

/** Note what is being typed in fields of one line, until it is asked for or left. */
function listenToTyping() {
  addEventListener("beforeinput", ({ target }) => {
    if (target instanceof HTMLInputElement && !before.has(target)) before.set(target, target.value);
  }, true);
  for (const kind of ["change", "focusout"]) addEventListener(kind, ({ target }) => target && before.delete(target), true);
}

/** Whether something is being typed in a field, and not asked for yet. @param {HTMLInputElement} field */
export function isTypedIn(field) {
  return before.has(field);
}

/** Have in a field what it held before that was typed which nobody asked for. @param {EventTarget | null} field */
function giveUp(field) {
  if (!(field instanceof HTMLInputElement) || !before.has(field)) return;
  field.value = field.type === "search" ? "" : before.get(field) ?? "";
  field.dispatchEvent(new Event("input", { bubbles: true }));
}

/**
 * Whether a key in a number field is for the document: undo takes back what is typed there first.
 * @param {KeyboardEvent} event
 */
function leaps(event) {
  const field = event.target;
  if (!(field instanceof HTMLInputElement) || field.type !== "number" || !LEAPS.has(keyOf(event))) return false;
  const typed = before.get(field);
  if (typed === undefined || keyOf(event) !== "Mod+Z") return typed === undefined;
  event.preventDefault();
  field.value = typed;
  before.delete(field);
  return false;
}

/** Close the menu, if it is open: a key does what it says there, and elsewhere what it always does. */
function closeMenu() {
  /** @type {HTMLElement | null} */ (document.querySelector("[role=menu]:popover-open"))?.hidePopover();
}

/** @param {Event} event */
export function isTyping(event) {
  const target = event.target instanceof HTMLElement ? event.target : null;
  return Boolean(target?.closest("input:not([type=checkbox], [type=range], [type=color]), textarea, select"));
}

/** Whether the space bar presses nothing. @param {Event} event */
function isFree(event) {
  return event.target instanceof HTMLElement && !event.target.closest("button, a, summary, [role=option], input");
}

/** Whether a key means something to what has the focus. @param {KeyboardEvent} event */
function isTaken(event) {
  const target = event.target instanceof HTMLElement ? event.target : null;
  // A menu's own way to close is Escape, and a popover's: what is chosen stays chosen.
  if (event.key === "Escape" && (target?.closest("[role=menu]") || document.querySelector("[popover=auto]:popover-open"))) return true;
  if (event.key === "Enter" && target?.closest("button, a, summary, input")) return true;
  return Boolean(target?.closest("[role=listbox], [role=menu], input[type=range]")) && event.key.startsWith("Arrow");
}
