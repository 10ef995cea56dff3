"""A profile of a press made for tests: four inks by the plainest rule, black in place of grey."""

from __future__ import annotations

import struct

import numpy as np

GRID = 9


def press_profile(name: str = "Test press FOGRA39") -> bytes:
    """ICC profile, version 2, of class ``prtr``: tables of 8 bits from inks to Lab and back."""
    tags = {
        b"desc": b"desc" + bytes(4) + struct.pack(">I", len(name) + 1) + name.encode() + bytes(80),
        b"cprt": b"text" + bytes(4) + b"none\0",
        b"wtpt": b"XYZ " + bytes(4) + struct.pack(">3i", *(round(v * 65536) for v in WHITE)),
        b"A2B0": _table(4, 3, _lab_of_inks),
        b"B2A0": _table(3, 4, _inks_of_lab),
    }
    place = 128 + 4 + 12 * len(tags)
    directory, body = struct.pack(">I", len(tags)), b""
    for key, data in tags.items():
        padded = data + bytes(-len(data) % 4)
        directory += key + struct.pack(">2I", place + len(body), len(data))
        body += padded
    size = place + len(body)
    head = struct.pack(">I4sI4s4s4s", size, b"none", 0x02400000, b"prtr", b"CMYK", b"Lab ")
    head += struct.pack(">6H4s", 2026, 1, 1, 0, 0, 0, b"acsp") + bytes(28)
    head += struct.pack(">3i", *(round(v * 65536) for v in WHITE))
    return head.ljust(128, b"\0") + directory + body


WHITE = (0.9642, 1.0, 0.8249)
"""D50, XYZ."""

TO_XYZ = np.array([[0.4361, 0.3851, 0.1431], [0.2225, 0.7169, 0.0606], [0.0139, 0.0971, 0.7141]])
"""Of linear sRGB, adapted to D50."""


def _table(inputs: int, outputs: int, rule) -> bytes:  # type: ignore[no-untyped-def]
    axes = np.meshgrid(*[np.linspace(0, 1, GRID)] * inputs, indexing="ij")
    values = rule(np.stack(axes, axis=-1))
    ramp = bytes(range(256))
    matrix = struct.pack(">9i", *(65536 * v for v in (1, 0, 0, 0, 1, 0, 0, 0, 1)))
    head = b"mft1" + bytes(4) + bytes([inputs, outputs, GRID, 0]) + matrix
    cells = np.clip(np.round(values * 255), 0, 255).astype(np.uint8).tobytes()
    return head + ramp * inputs + cells + ramp * outputs


def _lab_of_inks(inks: np.ndarray) -> np.ndarray:
    rgb = (1 - inks[..., :3]) * (1 - inks[..., 3:])
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    f = np.cbrt(np.maximum(linear @ TO_XYZ.T / WHITE, 1e-9))
    light = 116 * f[..., 1] - 16
    a, b = 500 * (f[..., 0] - f[..., 1]), 200 * (f[..., 1] - f[..., 2])
    return np.stack([light / 100, (a + 128) / 255, (b + 128) / 255], axis=-1)


def _inks_of_lab(lab: np.ndarray) -> np.ndarray:
    fy = (lab[..., 0] * 100 + 16) / 116
    f = np.stack(
        [fy + (lab[..., 1] * 255 - 128) / 500, fy, fy - (lab[..., 2] * 255 - 128) / 200], axis=-1
    )
    linear = np.clip((f**3 * WHITE) @ np.linalg.inv(TO_XYZ).T, 0, 1)
    rgb = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    black = 1 - rgb.max(axis=-1, keepdims=True)
    # Grey is half black ink, half the other three: a press's profile has rich blacks too.
    black = black / 2
    return np.concatenate([1 - rgb / (1 - black), black], axis=-1)
