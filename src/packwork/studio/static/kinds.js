// @ts-check
/** What the page shows of each kind of document: what has no meaning for it is not offered. */

/** @typedef {import("./wire.js").Scene["kind"]} Name */
/**
 * @typedef {{again: string, sizes: boolean, turns: boolean, groups: boolean, orders: boolean, grows: boolean, edge: boolean, moves: boolean, settings: Set<string> | null}} Kind
 * What filling again is called; whether items are sized by hand, turned beyond what they are held at, grouped, put in
 * an order or coloured by a picture, and more of them come; whether the container has an edge, and items are for the hand; the settings for all, null for every one.
 */

/** @type {Kind} */
const COLLAGE = { again: "Pour anew", sizes: true, turns: true, groups: true, orders: true, grows: true, edge: true, moves: true, settings: null };

/** @type {Record<NonNullable<Name>, Kind>} */
const KINDS = {
  collage: COLLAGE,
  nest: { ...COLLAGE, again: "Nest anew", sizes: false, turns: false, groups: false, orders: false, settings: new Set(["padding", "rotate"]) },
  chart: { ...COLLAGE, sizes: false, groups: false, orders: false, grows: false, settings: new Set(["padding", "rotate", "evenness"]) },
  tile: { ...COLLAGE, orders: false, edge: false },
  lines: { again: "Set anew", sizes: false, turns: false, groups: false, orders: false, grows: false, edge: true, moves: false, settings: new Set() },
  pile: { ...COLLAGE, again: "Heap anew", orders: false, settings: new Set(["padding", "rotate"]) },
};

/** @param {import("./collage.js").Collage} collage @returns {Kind} */
export function kindOf(collage) {
  return KINDS[collage.scene?.kind ?? "collage"];
}
