// @ts-check
/** What a hand does to items: take, move, turn, scale, let go; as commands in their order. */

/** @typedef {import("./collage.js").Collage} Collage */
/** @typedef {import("./collage.js").Pose} Pose */
/** @typedef {import("./connection.js").Connection} Connection */

/** Factors nearer to 1 than that are not sent. */
const SAME = 1e-4;

export class Hand {
  /**
   * @param {Collage} collage
   * @param {Connection} connection
   */
  constructor(collage, connection) {
    this.collage = collage;
    this.connection = connection;
    /** @type {Map<number, Pose>} */
    this.began = new Map();
    /** @type {Map<number, number>} scale that the studio was told */
    this.sizes = new Map();
  }

  get isFull() {
    return this.began.size > 0;
  }

  /** @param {Iterable<number>} ids */
  grab(ids) {
    for (const id of ids) {
      const pose = this.collage.pose(id);
      if (!pose) continue;
      this.began.set(id, pose);
      this.sizes.set(id, this.collage.poses[4 * (this.collage.rows.get(id) ?? 0) + 3]);
      this.collage.hand.set(id, { pose: { ...pose }, until: 0 });
    }
    if (this.isFull) this.connection.do({ kind: "grab", items: [...this.began.keys()] });
  }

  /** Leave a copy of what is held where it was taken. */
  leaveCopies() {
    this.connection.do(together([...this.began.keys()].map((item) => ({ kind: "duplicate", item, beside: 0 }))));
  }

  /**
   * Have what is held `x` and `y` from where it was taken.
   * @param {number} x
   * @param {number} y
   */
  move(x, y) {
    for (const [id, from] of this.began) this.put(id, { ...from, x: from.x + x, y: from.y + y });
    this.tell([...this.began.keys()].map((id) => this.moved(id)));
  }

  /**
   * Have it turned about a point, radians.
   * @param {number} angle
   * @param {{x: number, y: number}} about
   */
  turn(angle, about) {
    const [first] = this.began;
    const step = first ? this.collage.allowed(first[0], first[1].angle + angle) - first[1].angle : angle;
    const [cos, sin] = [Math.cos(step), Math.sin(step)];
    for (const [id, from] of this.began) {
      const [x, y] = [from.x - about.x, from.y - about.y];
      this.put(id, { ...from, x: about.x + cos * x - sin * y, y: about.y + sin * x + cos * y, angle: this.collage.allowed(id, from.angle + step) });
    }
    this.tell([...this.began.keys()].flatMap((id) => this.turned(id)));
  }

  /**
   * Have it larger about a point.
   * @param {number} factor
   * @param {{x: number, y: number}} about
   */
  scale(factor, about) {
    for (const [id, from] of this.began) {
      const [x, y] = [about.x + factor * (from.x - about.x), about.y + factor * (from.y - about.y)];
      this.put(id, { ...from, x, y, scale: factor * from.scale });
    }
    this.tell([...this.began.keys()].flatMap((id) => this.scaled(id)));
  }

  drop() {
    if (this.isFull) this.letGo("drop");
  }

  /** Have all that this drag has moved, neighbours too, as it was before. */
  cancel() {
    for (const [id, pose] of this.began) this.put(id, pose);
    this.letGo("cancel");
  }

  /** @param {"drop" | "cancel"} kind */
  letGo(kind) {
    const until = this.connection.do({ kind });
    for (const id of this.began.keys()) {
      const held = this.collage.hand.get(id);
      if (held && until) held.until = until;
      else this.collage.hand.delete(id);
    }
    this.began.clear();
  }

  /** @param {number} id @param {Pose} pose */
  put(id, pose) {
    this.collage.hand.set(id, { pose, until: 0 });
  }

  /** @param {number} id */
  held(id) {
    return /** @type {{pose: Pose}} */ (this.collage.hand.get(id)).pose;
  }

  /** @param {number} id */
  moved(id) {
    const { x, y } = this.held(id);
    return { kind: "move", item: id, x, y };
  }

  /** @param {number} id */
  turned(id) {
    const angle = (this.held(id).angle * 180) / Math.PI;
    const turn = { kind: "turn", item: id, angle };
    return this.began.size > 1 ? [this.moved(id), turn] : [turn];
  }

  /** @param {number} id */
  scaled(id) {
    const pose = this.held(id);
    const factor = Math.min(Math.max(pose.scale / (this.sizes.get(id) ?? pose.scale), 0.01), 100);
    const moved = this.moved(id);
    if (Math.abs(factor - 1) < SAME) return [moved];
    this.sizes.set(id, pose.scale);
    return [moved, { kind: "scale", item: id, factor }];
  }

  /**
   * Have all of it done at once: browsers tell of a pointer once a frame.
   * @param {object[]} commands
   */
  tell(commands) {
    const command = together(commands);
    if (command) this.connection.do(command);
  }
}

/**
 * One command of several.
 * @param {object[]} commands
 */
export function together(commands) {
  if (commands.length < 2) return commands[0] ?? null;
  return { kind: "together", commands };
}
