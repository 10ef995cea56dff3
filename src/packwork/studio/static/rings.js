// @ts-check
/** Outlines as rings of points: read from paths, written as paths, pulled at a point. */

/** @typedef {[number, number][]} Ring */

/** Share of an outline's extent by which the points that can be pulled may be off. */
const FINENESS = 0.012;

/**
 * Rings of path data that has nothing but straight lines.
 * @param {string} path
 * @returns {Ring[]}
 */
export function ringsOf(path) {
  return path.split("M").slice(1).map((part) => {
    const numbers = (part.match(/-?[\d.]+(?:e-?\d+)?/g) ?? []).map(Number);
    return Array.from({ length: numbers.length >> 1 }, (_, k) => /** @type {[number, number]} */ ([numbers[2 * k], numbers[2 * k + 1]]));
  });
}

/** @param {Ring[]} rings */
export function pathOf(rings) {
  return rings.map((ring) => `M${ring.map(([x, y]) => `${x} ${y}`).join(" ")}Z`).join("");
}

/**
 * Left, top, right and bottom.
 * @param {Ring[]} rings
 */
export function boundsOf(rings) {
  const [xs, ys] = [rings.flatMap((ring) => ring.map(([x]) => x)), rings.flatMap((ring) => ring.map(([, y]) => y))];
  const least = (/** @type {number[]} */ all) => all.reduce((a, b) => Math.min(a, b), Infinity);
  const most = (/** @type {number[]} */ all) => all.reduce((a, b) => Math.max(a, b), -Infinity);
  return [least(xs), least(ys), most(xs), most(ys)];
}

/**
 * Indices of those points of each ring that tell its shape (Douglas and Peucker 1973).
 * @param {Ring[]} rings
 */
export function tellingPoints(rings) {
  const [left, top, right, bottom] = boundsOf(rings);
  const far = FINENESS * Math.max(right - left, bottom - top);
  return rings.map((ring) => {
    const half = ring.length >> 1;
    return [0, ...between(ring, 0, half, far), half, ...between(ring, half, ring.length, far)];
  });
}

/**
 * @param {Ring} ring
 * @param {number} from
 * @param {number} to
 * @param {number} far
 * @returns {number[]}
 */
function between(ring, from, to, far) {
  const [a, b] = [ring[from], ring[to % ring.length]];
  let [at, most] = [-1, far];
  for (let k = from + 1; k < to; k++) {
    const away = distance(ring[k], a, b);
    if (away > most) [at, most] = [k, away];
  }
  return at < 0 ? [] : [...between(ring, from, at, far), at, ...between(ring, at, to, far)];
}

/**
 * Distance of a point from a segment.
 * @param {[number, number]} point
 * @param {[number, number]} a
 * @param {[number, number]} b
 */
export function distance([x, y], [ax, ay], [bx, by]) {
  const [dx, dy] = [bx - ax, by - ay];
  const share = Math.min(Math.max(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1), 0), 1);
  return Math.hypot(x - ax - share * dx, y - ay - share * dy);
}

/**
 * A ring with one point elsewhere; those up to the points beside it follow, less the farther they are.
 * @param {Ring} ring
 * @param {number[]} telling indices of its telling points
 * @param {number} which of these
 * @param {number} x by how much
 * @param {number} y
 * @returns {Ring}
 */
export function pulled(ring, telling, which, x, y) {
  const count = ring.length;
  const at = telling[which];
  const before = (at - telling[(which + telling.length - 1) % telling.length] + count) % count || count;
  const after = (telling[(which + 1) % telling.length] - at + count) % count || count;
  return ring.map(([px, py], k) => {
    const ahead = (k - at + count) % count;
    const share = ahead < after ? 1 - ahead / after : count - ahead < before ? 1 - (count - ahead) / before : 0;
    return [px + share * x, py + share * y];
  });
}

/** Points of a smoothed line, and how often each becomes the mean of those about it. */
const POINTS = 240, ROUNDS = 6;

/**
 * A line drawn by hand as a smooth closed ring of points at equal distances; null if it is short.
 * @param {Ring} line
 * @param {number} shortest length of one that is not
 * @returns {Ring | null}
 */
export function smoothed(line, shortest) {
  const closed = [...line, line[0]];
  const along = [0];
  closed.slice(1).forEach(([x, y], k) => along.push(along[k] + Math.hypot(x - closed[k][0], y - closed[k][1])));
  const length = along[along.length - 1];
  if (line.length < 3 || length < shortest) return null;
  let k = 0;
  let ring = Array.from({ length: POINTS }, (_, one) => {
    const far = (one * length) / POINTS;
    while (k + 2 < along.length && along[k + 1] < far) k++;
    const share = (far - along[k]) / (along[k + 1] - along[k] || 1);
    return /** @type {[number, number]} */ ([0, 1].map((axis) => closed[k][axis] + share * (closed[k + 1][axis] - closed[k][axis])));
  });
  for (let round = 0; round < ROUNDS; round++) ring = ring.map((at, one) => {
    const [before, after] = [ring[(one + POINTS - 1) % POINTS], ring[(one + 1) % POINTS]];
    return /** @type {[number, number]} */ ([0, 1].map((axis) => (before[axis] + 2 * at[axis] + after[axis]) / 4));
  });
  return ring;
}
