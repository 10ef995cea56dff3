// @ts-check
/** Colours of the canvas, from the page's theme. */

/** @param {Element} element */
export function coloursOf(element) {
  const style = getComputedStyle(element);
  const names = ["desk", "paper", "edge", "mark", "hover", "wrong", "pin", "on-pin", "handle", "marquee", "free", "taken"];
  const found = names.map((name) => style.getPropertyValue(`--${name}`).trim());
  const [desk, paper, edge, accent, hover, bad, pin, onPin, handle, marquee, free, taken] = found;
  return { desk, paper, edge, accent, hover, bad, pin, onPin, handle, marquee, free, taken };
}
