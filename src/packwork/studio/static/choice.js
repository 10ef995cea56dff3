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
    /** What was there before something was asked for that is to be chosen. @type {Map<number, number> | null} */
    this.before = null;
  }

  /**
   * Choose what comes next.
   * @param {Map<number, number>} present what is there before
   */
  expect(present) {
    this.before = present;
  }

  /** @param {number} id */
  has(id) {
    return this.ids.has(id);
  }

  /** @param {Iterable<number>} ids */
  set(ids) {
    this.before = null;
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
    const fresh = this.before ? [...present.keys()].filter((id) => !this.before?.has(id)) : [];
    if (fresh.length) return this.set(fresh);
    const left = [...this.ids].filter((id) => present.has(id));
    if (left.length !== this.ids.size) this.set(left);
    if (this.hovered !== null && !present.has(this.hovered)) this.hovered = null;
  }
}
