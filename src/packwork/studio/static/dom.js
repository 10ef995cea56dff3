// @ts-check
/** Elements in one line each, and the few drawings that buttons have. */

/** Paths of the icons, on a square of 24, drawn as lines. */
const ICONS = {
  undo: "M9 14 4 9l5-5M4 9h10a6 6 0 0 1 0 12h-3",
  redo: "m15 14 5-5-5-5M20 9H10a6 6 0 0 0 0 12h3",
  pour: "M20 11a8 8 0 1 0-2.3 6M20 4v7h-7",
  fit: "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5",
  help: "M9 9a3 3 0 1 1 4 2.8c-.7.3-1 .9-1 1.7v.5M12 17.5v.1",
  theme: "M12 3v2M12 19v2M5 5l1.5 1.5M17.5 17.5 19 19M3 12h2M19 12h2M5 19l1.5-1.5M17.5 6.5 19 5M16 12a4 4 0 1 1-8 0 4 4 0 0 1 8 0Z",
  export: "M12 4v11M7 10l5 5 5-5M5 20h14",
  pin: "M9 4h6l-1 6 3 3H7l3-3-1-6ZM12 13v7",
  release: "M4 4l16 16M9 4h6l-1 6 3 3h-3M10 10l-3 3h6M12 13v7",
  copy: "M9 9h11v11H9zM5 15H4V4h11v1",
  bin: "M5 7h14M10 7V4h4v3M7 7l1 13h8l1-13",
  swap: "M7 4 3 8l4 4M3 8h14M17 12l4 4-4 4M21 16H7",
  replace: "M4 4h8v8H4zM20 12v8h-8M20 4l-5 5M15 5v4h4",
  group: "M3 7V3h4M17 3h4v4M21 17v4h-4M7 21H3v-4M7 7h6v6H7zM13 11h4v6h-6v-4",
  ungroup: "M4 4h7v7H4zM13 13h7v7h-7zM15 4h5v5M9 20H4v-5",
  layers: "M4 9a5 5 0 1 0 10 0 5 5 0 1 0-10 0M10 15a5 5 0 1 0 10 0 5 5 0 1 0-10 0",
  shape: "M12 4 20 10l-3 10H7L4 10z",
  left: "M4 4v16M8 7h12v3H8zM8 14h7v3H8z",
  center: "M12 3v4M12 10v4M12 17v4M5 7h14v3H5zM8 14h8v3H8z",
  right: "M20 4v16M4 7h12v3H4zM9 14h7v3H9z",
  top: "M4 4h16M7 8v12h3V8zM14 8v7h3V8z",
  middle: "M3 12h4M10 12h4M17 12h4M7 5v14h3V5zM14 8v8h3V8z",
  bottom: "M4 20h16M7 4v12h3V4zM14 9v7h3V9z",
  across: "M4 4v16M20 4v16M10.500 7h3v10h-3z",
  down2: "M4 4h16M4 20h16M7 10.500h10v3H7z",
  crop: "M6 2v16h16M2 6h16v16",
  flip: "M12 3v18M9 7v10H3zM15 7v10h6z",
  flipDown: "M3 12h18M7 9h10V3zM7 15h10v6z",
  items: "M4 4h7v7H4zM13 4h7v7h-7zM4 13h7v7H4zM13 13h7v7h-7z",
  words: "M5 6V4h14v2M12 4v16M9 20h6",
  options: "M4 7h9M17 7h3M4 17h3M11 17h9M15 5v4M9 15v4",
  down: "m7 10 5 5 5-5",
  eye: "M2.500 12c2.500-4.500 6-6.500 9.500-6.500s7 2 9.500 6.500c-2.500 4.500-6 6.500-9.500 6.500s-7-2-9.500-6.500ZM15 12a3 3 0 1 1-6 0 3 3 0 0 1 6 0Z",
  upright: "M12 20V5M6.500 10.500 12 5l5.500 5.500",
  close: "M6 6l12 12M18 6 6 18",
  plus: "M12 5v14M5 12h14",
  minus: "M5 12h14",
  check: "m5 12 5 5 9-10",
  file: "M6 3h8l4 4v14H6zM14 3v4h4",
  pencil: "M4 20l1-5L16 4l4 4L9 19l-5 1M14 6l4 4",
  pipette: "m14 6 4 4M19.500 8.500a2.500 2.500 0 0 0-3.500-4l-2 2-1.500-1.500-2 2 6 6 2-2L17 9.500M12 8.500l-7 7V19h3.500l7-7",
  colour: "M12 3c4 5 6 7.500 6 11a6 6 0 0 1-12 0c0-3.500 2-6 6-11Z",
  dots: "M6 12h.01M12 12h.01M18 12h.01",
  more: "M12 4v16M4 12h16M6.500 6.500l11 11M17.500 6.500l-11 11",
};

/** @typedef {keyof typeof ICONS} IconName */

/**
 * An element with attributes, listeners (`onclick`) and children.
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag
 * @param {Record<string, any>} [given]
 * @param {...(Node | string | null | undefined | false)} children
 * @returns {HTMLElementTagNameMap[K]}
 */
export function h(tag, given = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(given)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (name === "value") /** @type {any} */ (made).value = value;
    else made.setAttribute(name, value === true ? "" : String(value));
  }
  made.append(...children.filter((child) => child || child === "").map((child) => child || ""));
  return made;
}

/**
 * A drawing for a button; says nothing to screen readers.
 * @param {IconName} name
 */
export function icon(name) {
  const drawn = vector("0 0 24 24", ICONS[name]);
  drawn.setAttribute("class", "icon");
  return drawn;
}

/**
 * An SVG of one path.
 * @param {string} box
 * @param {string} path
 */
export function vector(box, path) {
  const space = "http://www.w3.org/2000/svg";
  const drawn = document.createElementNS(space, "svg");
  drawn.setAttribute("viewBox", box);
  drawn.setAttribute("aria-hidden", "true");
  const line = document.createElementNS(space, "path");
  line.setAttribute("d", path);
  line.setAttribute("fill-rule", "evenodd");
  drawn.append(line);
  return drawn;
}

/**
 * A button with a drawing.
 * @param {IconName} name
 * @param {string} label
 * @param {() => void} act
 * @param {Record<string, any>} [given]
 */
export function button(name, label, act, given = {}) {
  return h("button", { type: "button", title: label, "aria-label": label, onclick: act, ...given }, icon(name));
}

/**
 * A field of a colour, which is taken for what it was opened for, whatever is chosen by then.
 * @param {Record<string, any>} given
 * @param {(colour: string, ids: number[]) => void} take
 * @param {() => number[]} [ids] those that a colour is for
 */
export function colourField(given, take, ids = () => []) {
  /** @type {{ids: number[], colour: string} | null} */
  let opened = null;
  const field = h("input", { type: "color", ...given,
    onclick: () => (opened = { ids: ids(), colour: field.value }),
    oninput: () => opened && (opened.colour = field.value),
    onchange: () => {
      const taken = opened ?? { ids: ids(), colour: field.value };
      opened = null;
      take(taken.colour, taken.ids);
    } });
  return field;
}

/**
 * A field of one colour, and where the browser can, a pipette that takes one from the screen.
 * @param {string} label
 * @param {(colour: string, ids: number[]) => void} take
 * @param {() => number[]} [ids] those that a colour is for
 */
export function picker(label, take, ids = () => []) {
  const field = colourField({ title: label, "aria-label": label }, take, ids);
  const Pipette = /** @type {any} */ (globalThis).EyeDropper;
  const pick = () => {
    const opened = ids();
    return new Pipette().open().then((/** @type {any} */ found) => take(found.sRGBHex, opened), () => {});
  };
  const pipette = Pipette && button("pipette", `${label}, from the screen`, pick);
  /** @param {string} colour @param {boolean} isMixed whether it stands for none or for several */
  const show = (colour, isMixed) => {
    showNumber(field, colour);
    field.classList.toggle("mixed", isMixed);
  };
  return { element: h("span", { class: "picker" }, field, pipette), field, show };
}

/** Have a key open a list whose every step would be asked for at once; letters are for finding in it. @param {KeyboardEvent} event */
export function openList(event) {
  const field = event.currentTarget;
  if (!(field instanceof HTMLSelectElement) || event.ctrlKey || event.metaKey || event.altKey || !field.showPicker || !/^(Arrow(Up|Down)|Page(Up|Down)|Home|End)$/.test(event.key)) return;
  event.preventDefault();
  field.showPicker();
}

/** @param {string} id */
export function byId(id) {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no ${id}`);
  return found;
}

/**
 * Show a number or a colour in a field; what is typed there and not asked for yet stays, and so does what is on its way.
 * @param {HTMLInputElement} field
 * @param {string} text
 */
export function showNumber(field, text) {
  if (field.dataset.shown === text) return;
  if (document.activeElement !== field || field.value === field.dataset.shown) field.value = text;
  field.dataset.shown = text;
}

/** Have a field say what there is. @param {HTMLInputElement} field */
export function showAgain(field) {
  field.value = field.dataset.shown ?? "";
}
