// @ts-check
/** Which part of the canvas the window shows. */

const CLOSEST = 40;
const FARTHEST = 0.1;
const GLIDE = 180;

export class View {
  /** @param {() => void} changed */
  constructor(changed) {
    this.changed = changed;
    this.zoom = 1;
    this.x = 0;
    this.y = 0;
    /** Size of the window and what panels cover of it, px. */
    this.size = { width: 1, height: 1, left: 0, top: 0, right: 0, bottom: 0 };
    this.whole = { x: 0, y: 0, width: 600, height: 600 };
    this.isFitted = true;
    /** @type {null | {from: number[], to: number[], since: number}} */
    this.glide = null;
  }

  /** @param {number} x @param {number} y */
  toCanvas(x, y) {
    return { x: (x - this.x) / this.zoom, y: (y - this.y) / this.zoom };
  }

  /** @param {number} x @param {number} y */
  toScreen(x, y) {
    return { x: x * this.zoom + this.x, y: y * this.zoom + this.y };
  }

  /** Where all of the canvas is seen. */
  fitted() {
    const { width, height, left, top, right, bottom } = this.size;
    const [free, high] = [Math.max(width - left - right, 80), Math.max(height - top - bottom, 80)];
    const zoom = Math.min(free / this.whole.width, high / this.whole.height);
    const x = left + (free - zoom * this.whole.width) / 2 - zoom * this.whole.x;
    const y = top + (high - zoom * this.whole.height) / 2 - zoom * this.whole.y;
    return [zoom, x, y];
  }

  get fitZoom() {
    return this.fitted()[0];
  }

  /** @param {boolean} glides */
  fit(glides) {
    this.isFitted = true;
    this.go(this.fitted(), glides);
  }

  /** Keep all in view when the window changes, if it was. */
  refit() {
    if (this.isFitted) this.fit(false);
    else this.changed();
  }

  /**
   * Show a box in the middle.
   * @param {[number, number, number, number]} box
   */
  show([left, top, right, bottom]) {
    const { width, height } = this.size;
    const zoom = Math.min(Math.max(this.zoom, this.fitZoom), width / (right - left) / 2, height / (bottom - top) / 2);
    this.isFitted = false;
    this.go([zoom, width / 2 - (zoom * (left + right)) / 2, height / 2 - (zoom * (top + bottom)) / 2], true);
  }

  /**
   * @param {number[]} to
   * @param {boolean} glides
   */
  go(to, glides) {
    this.glide = glides ? { from: [this.zoom, this.x, this.y], to, since: performance.now() } : null;
    if (!glides) [this.zoom, this.x, this.y] = to;
    this.changed();
  }

  /** Go on to where it glides; whether it still does. */
  step() {
    if (!this.glide) return false;
    const { from, to, since } = this.glide;
    const share = Math.min((performance.now() - since) / GLIDE, 1);
    const eased = 1 - (1 - share) ** 3;
    [this.zoom, this.x, this.y] = from.map((value, k) => value + eased * (to[k] - value));
    if (share === 1) this.glide = null;
    return this.glide !== null;
  }

  /**
   * Zoom about a point of the window.
   * @param {number} factor
   * @param {number} x
   * @param {number} y
   */
  zoomAt(factor, x, y) {
    const fit = this.fitZoom;
    const zoom = Math.min(Math.max(this.zoom * factor, fit * FARTHEST), fit * CLOSEST);
    const ratio = zoom / this.zoom;
    this.isFitted = false;
    this.go([zoom, x - ratio * (x - this.x), y - ratio * (y - this.y)], false);
  }

  /** @param {number} x @param {number} y */
  pan(x, y) {
    this.isFitted = false;
    this.go([this.zoom, this.x + x, this.y + y], false);
  }
}
