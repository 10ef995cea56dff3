// @ts-check
/** Which items are chosen. */

export class Choice {
  /** @param {() => void} changed */
  constructor(changed) {
    this.changed = changed;
    /** @type {Set<number>} */
    this.ids = new Set();
    /** @type {number | null} */
    this.hovered = null;
    /** Whether they are in the hand: handles would be in the way. */
    this.isBusy = false;
  }

  /** @param {number} id */
  has(id) {
    return this.ids.has(id);
  }

  /** @param {Iterable<number>} ids */
  set(ids) {
    this.ids = new Set(ids);
    this.changed();
  }

  /** @param {number} id */
  toggle(id) {
    const ids = new Set(this.ids);
    if (!ids.delete(id)) ids.add(id);
    this.set(ids);
  }

  /**
   * Forget what is no more.
   * @param {Map<number, number>} present
   */
  keep(present) {
    const left = [...this.ids].filter((id) => present.has(id));
    if (left.length !== this.ids.size) this.set(left);
    if (this.hovered !== null && !present.has(this.hovered)) this.hovered = null;
  }
}
