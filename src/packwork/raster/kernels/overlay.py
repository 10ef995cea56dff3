"""Compiled loop that lays one picture over another, turned and scaled."""

from __future__ import annotations

import numpy as np

from packwork.compiled import helper, kernel


@kernel
def lay(image, texture, inverse):
    """Draw ``texture`` over ``image``; both ``(rows, columns, 4)``, premultiplied, of 0 to 255.

    ``inverse`` maps points of the image to points of the texture. The texture's outermost
    pixels are clear.
    """
    rows, columns = image.shape[0], image.shape[1]
    high, wide = texture.shape[0] - 1, texture.shape[1] - 1
    du_x, du_y, u_0 = inverse[0, 0], inverse[0, 1], inverse[0, 2]
    dv_x, dv_y, v_0 = inverse[1, 0], inverse[1, 1], inverse[1, 2]
    one = np.float32(1.0)
    half = np.float32(0.5)
    share = np.float32(1.0 / 255.0)
    least = np.float32(1e-3)
    first_row, last_row = _rows(inverse, wide + 1, high + 1, rows)
    for row in range(first_row, last_row):
        u_row = du_x * 0.5 + du_y * (row + 0.5) + u_0 - 0.5
        v_row = dv_x * 0.5 + dv_y * (row + 0.5) + v_0 - 0.5
        left, right = _span(u_row, du_x, 0.0, float(wide), 0.0, float(columns))
        left, right = _span(v_row, dv_x, 0.0, float(high), left, right)
        for column in range(max(int(left) - 1, 0), min(int(right) + 2, columns)):
            u = np.float32(u_row + du_x * column)
            v = np.float32(v_row + dv_x * column)
            if u < 0.0 or v < 0.0 or u >= wide or v >= high:
                continue
            i, j = int(v), int(u)
            below, beside = v - np.float32(i), u - np.float32(j)
            above, before = one - below, one - beside
            w_00, w_01, w_10, w_11 = above * before, above * beside, below * before, below * beside
            alpha = _mixed(texture, i, j, 3, w_00, w_01, w_10, w_11)
            if alpha < least:
                continue
            kept = one - alpha * share
            for k in range(3):
                colour = _mixed(texture, i, j, k, w_00, w_01, w_10, w_11)
                under = np.float32(image[row, column, k])
                image[row, column, k] = np.uint8(np.int32(colour + kept * under + half))
            under = np.float32(image[row, column, 3])
            image[row, column, 3] = np.uint8(np.int32(alpha + kept * under + half))


@helper(inline="always")
def _mixed(texture, i, j, k, w_00, w_01, w_10, w_11):
    """One channel between four pixels."""
    return (
        w_00 * np.float32(texture[i, j, k])
        + w_01 * np.float32(texture[i, j + 1, k])
        + w_10 * np.float32(texture[i + 1, j, k])
        + w_11 * np.float32(texture[i + 1, j + 1, k])
    )


@helper
def _rows(inverse, wide, high, rows):
    """Rows of the image that a texture may reach."""
    det = inverse[0, 0] * inverse[1, 1] - inverse[0, 1] * inverse[1, 0]
    top, bottom = 1e30, -1e30
    for corner in range(4):
        u = wide * (corner % 2) - inverse[0, 2]
        v = high * (corner // 2) - inverse[1, 2]
        y = (inverse[0, 0] * v - inverse[1, 0] * u) / det
        top, bottom = min(top, y), max(bottom, y)
    return max(int(max(top, 0.0)) - 1, 0), min(int(max(min(bottom, rows), -1.0)) + 2, rows)


@helper
def _span(at_zero, slope, least, most, left, right):
    """Part of ``left`` to ``right`` where ``at_zero + slope * x`` is from least to most."""
    if abs(slope) < 1e-12:
        if at_zero < least or at_zero > most:
            return 0.0, -9.0
        return left, right
    one, other = (least - at_zero) / slope, (most - at_zero) / slope
    return max(left, min(one, other)), min(right, max(one, other))
