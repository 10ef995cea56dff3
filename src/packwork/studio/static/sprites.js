// @ts-check
/** Drawings of items as pictures of a few sizes, made when they are first needed. */

/** @typedef {import("./collage.js").Look} Look */
/** @typedef {ImageBitmap} Sprite never changed: what can be is copied each time it is drawn */

/** Longer side of the smallest and largest picture, px. */
const SMALLEST = 32;
const LARGEST = 1024;
/** Pictures made in one frame at most: more would be seen as a halt. */
const AT_ONCE = 40;

export class Sprites {
  /** @param {() => void} changed told when a drawing has become ready */
  constructor(changed) {
    this.changed = changed;
    /** @type {Map<string, Map<number, Sprite>>} */
    this.made = new Map();
    /** @type {Map<string, HTMLImageElement | null>} */
    this.images = new Map();
    this.left = AT_ONCE;
    /** Whether something was asked for that was not there yet. */
    this.lacks = false;
  }

  /** @param {string[]} keys of looks that are not there any more */
  forget(keys) {
    for (const key of keys) {
      for (const sprite of this.made.get(key)?.values() ?? []) sprite.close();
      this.made.delete(key);
      this.images.delete(key);
    }
  }

  /** Begin a frame. */
  begin() {
    const wanted = this.left < 0;
    this.left = AT_ONCE;
    return wanted;
  }

  /**
   * A picture of an item at least so large, or the nearest there is.
   * @param {Look} look
   * @param {number} pixels
   * @returns {Sprite | null}
   */
  of(look, pixels) {
    const size = Math.min(Math.max(2 ** Math.ceil(Math.log2(Math.max(pixels, 1))), SMALLEST), LARGEST);
    const sizes = this.made.get(look.key) ?? new Map();
    const found = sizes.get(size);
    if (found) return found;
    const drawn = this.draw(look, size);
    if (drawn) {
      sizes.set(size, drawn);
      this.made.set(look.key, sizes);
      return drawn;
    }
    this.lacks = true;
    return nearest(sizes, size);
  }

  /**
   * @param {Look} look
   * @param {number} size
   * @returns {Sprite | null}
   */
  draw(look, size) {
    const image = look.svg ? this.image(look) : null;
    if (look.svg && !image) return null;
    if (--this.left < 0) return null;
    const [left, top, right, bottom] = look.box;
    const ratio = size / look.extent;
    const [wide, high] = [Math.ceil((right - left) * ratio), Math.ceil((bottom - top) * ratio)];
    const sprite = new OffscreenCanvas(Math.max(wide, 1), Math.max(high, 1));
    const pen = /** @type {OffscreenCanvasRenderingContext2D} */ (sprite.getContext("2d"));
    if (image) pen.drawImage(image, 0, 0, sprite.width, sprite.height);
    else {
      pen.setTransform(sprite.width / (right - left), 0, 0, sprite.height / (bottom - top), 0, 0);
      pen.translate(-left, -top);
      pen.fillStyle = look.fill;
      pen.fill(/** @type {Path2D} */ (look.inkPath), "evenodd");
    }
    return sprite.transferToImageBitmap();
  }

  /**
   * The drawing itself, once it is there.
   * @param {Look} look
   */
  image(look) {
    if (this.images.has(look.key)) return this.images.get(look.key) ?? null;
    this.images.set(look.key, null);
    const image = new Image();
    const url = URL.createObjectURL(new Blob([look.svg], { type: "image/svg+xml" }));
    image.onload = () => {
      URL.revokeObjectURL(url);
      this.images.set(look.key, image);
      this.changed();
    };
    image.src = url;
    return null;
  }
}

/**
 * @param {Map<number, Sprite>} sizes
 * @param {number} size
 */
function nearest(sizes, size) {
  const known = [...sizes.keys()].sort((a, b) => Math.abs(a - size) - Math.abs(b - size));
  return known.length ? sizes.get(known[0]) ?? null : null;
}
