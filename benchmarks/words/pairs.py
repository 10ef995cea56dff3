"""Eleven pairs of pictures, the peer's and ours, of its own examples: page, manifest, pictures."""

from __future__ import annotations

import hashlib
import io
import tempfile
from pathlib import Path

from PIL import Image

from benchmarks.kit.manifests import DOCS, Manifest, write_manifest, write_text
from benchmarks.words import stand_ins
from benchmarks.words.examples import EXAMPLES, copied, example, peer_version, stamped
from benchmarks.words.pairs_page import FILE, NAME, page

LOOKED_AT = DOCS.parent / "build" / NAME
"""What the examples drew as they come, for looking at: not all of it may be published."""

PICTURES = DOCS / "pictures"
SIDE = 480
MOST_BYTES = 120_000
COLOURS = 256
QUALITIES = (88, 80, 70, 60)


def write(source: Path) -> None:
    """Run all examples, unchanged and with pictures of ours; write pictures, manifest, page."""
    LOOKED_AT.mkdir(parents=True, exist_ok=True)
    found: Manifest = {}
    with copied(source) as folder, tempfile.TemporaryDirectory() as temporary:
        ours = stand_ins.with_stand_ins(folder, Path(temporary, "examples"))
        drawn = Path(temporary)
        for name in EXAMPLES:
            stand_in = stand_ins.PICTURES.get(name)
            as_it_comes = example(folder, name, 1, LOOKED_AT)
            shown = example(ours, name, 1, drawn) if stand_in else as_it_comes
            found[name] = {
                "stands_in_for": stand_in,
                "programs": _with_pictures(name, shown, drawn if stand_in else LOOKED_AT),
            }
    parts = {"peer": peer_version(), "pairs": found}
    write_text(FILE, page(write_manifest(NAME, {**stamped(), **parts})))


def _with_pictures(name: str, programs: Manifest, drawn: Path) -> Manifest:
    """Beside each program's figures the picture of its first cloud."""
    found: Manifest = {}
    for program, one in programs.items():
        found[program] = dict(one)
        path = drawn / f"{name}-{program}-0.png"
        if "clouds" in one and path.exists():
            with Image.open(path) as image:
                found[program] |= published(image, f"pair-{name.replace('_', '-')}-{program}")
    return found


def published(image: Image.Image, name: str) -> Manifest:
    """A small copy among the pages' pictures, and what tells it from another."""
    data, ending = small(image)
    for earlier in PICTURES.glob(f"{name}.*"):
        earlier.unlink()
    path = PICTURES / f"{name}.{ending}"
    path.write_bytes(data)
    return {"file": f"pictures/{path.name}", "sha256": hashlib.sha256(data).hexdigest()}


def small(image: Image.Image) -> tuple[bytes, str]:
    """A picture of at most ``SIDE`` pixels and ``MOST_BYTES``: a PNG of few colours, or a JPEG."""
    image = image.convert("RGB")
    image.thumbnail((SIDE, SIDE), Image.Resampling.LANCZOS)
    made = io.BytesIO()
    image.quantize(COLOURS, dither=Image.Dither.NONE).save(made, "PNG", optimize=True)
    for quality in QUALITIES:
        if made.tell() <= MOST_BYTES:
            break
        made = io.BytesIO()
        image.save(made, "JPEG", quality=quality, optimize=True)
    data = made.getvalue()
    return data, "png" if data.startswith(b"\x89PNG") else "jpg"
