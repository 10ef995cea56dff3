"""Twelve things that people do with Packwork in Python; ``python twelve_uses.py`` draws them all.

Each is a function that returns a layout, and takes the options that all runs have, such as
``effort="draft"``.
"""

from __future__ import annotations

import io
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import Literal, TypedDict, Unpack

import numpy as np
import shapely
from PIL import Image, ImageDraw

import packwork as pw


class Quickness(TypedDict, total=False):
    """How long a run tries."""

    effort: Literal["draft", "normal", "best"]
    levels: str | None


def array_as_container(**how: Unpack[Quickness]) -> pw.Layout:
    """Stars and circles in a mask of bools: True is inside."""
    rows, columns = np.mgrid[:200, :300]
    hill = rows > 150 - 110 * np.exp(-(((columns - 150) / 70) ** 2))
    return pw.fill(hill, ["star", "circle"], count=60, padding="0.3%", **how)


def pictures_as_items(**how: Unpack[Quickness]) -> pw.Layout:
    """Pictures with transparency that were drawn by Pillow; their names are the dict's."""
    coins = {}
    for name, colour in (("gold", "#d9a520"), ("silver", "#a9b0b8"), ("copper", "#b5693b")):
        coins[name] = Image.new("RGBA", (160, 160), "#00000000")
        draw = ImageDraw.Draw(coins[name])
        draw.ellipse((4, 4, 155, 155), fill=colour, outline="#5a4632", width=5)
        draw.regular_polygon((80, 80, 46), 6, fill="#fff6dc")
    return pw.fill("bear", coins, count=70, size_ratio=3, **how)


def shapely_in_and_out(**how: Unpack[Quickness]) -> pw.Layout:
    """Shapely parts on a sheet of 300 x 200 mm, 2 mm apart; what is left over is Shapely too."""
    bracket = shapely.box(0, 0, 60, 40) - shapely.box(15, 12, 60, 40)
    washer = shapely.Point(0, 0).buffer(18)
    sheet = pw.Container("sheet", outline=shapely.box(0, 0, 300, 200), unit="mm")
    parts = [
        pw.Item("bracket", outline=bracket, art="#33658a"),
        pw.Item("washer", outline=washer, art="#f26419"),
    ]
    layout = pw.fill(sheet, parts, count=24, padding="2mm", sizes="shared", **how)
    offcut = sheet.outline.region - shapely.union_all([p.outline.region for p in layout])
    assert offcut.area > 0
    return layout


def map_with_y_up(**how: Unpack[Quickness]) -> pw.Layout:
    """A land in degrees, as GeoJSON has it, filled with trees."""
    coast = [(5.9, 45.8), (7.1, 46.0), (10.3, 46.2), (9.4, 47.6), (7.0, 47.5), (6.1, 46.9)]
    land = {"type": "Polygon", "coordinates": [[*coast, coast[0]]]}
    return pw.fill(land, ["leaf"], count=50, y_up=True, **how)


def rows_of_a_frame(**how: Unpack[Quickness]) -> pw.Layout:
    """One item a row; names and weights from columns. A GeoDataFrame is given in the same way."""
    lakes = {"Como": (146, 0.25), "Garda": (370, 0.5), "Iseo": (65, 0.2), "Maggiore": (212, 0.3)}
    colours = ("#05668d", "#028090", "#00a896", "#02c39a")
    features = [
        {
            "type": "Feature",
            "properties": {"lake": name, "km2": area, "color": colour},
            "geometry": shapely.LineString([(0, 0), (0.3, 1), (wide, 2)]).buffer(wide),
        }
        for (name, (area, wide)), colour in zip(lakes.items(), colours, strict=True)
    ]
    frame = {"type": "FeatureCollection", "features": features}
    items = pw.read_items(frame, name_by="lake", weight_by="km2", y_up=True)
    return pw.fill("circle", items, sizes="shared", count=12, **how)


def table_in_and_out(**how: Unpack[Quickness]) -> pw.Layout:
    """A chart of a table; a data frame, with its index, is given in the same way."""
    sold = {"fruit": ["fig", "kiwi", "lime", "plum"], "kg": [31, 12, 22, 8]}
    layout = pw.chart("heart", sold, size_by="kg", label_by="fruit", color_by="fruit", **how)
    frame = layout.to_dataframe()
    assert frame["kg"].tolist() == [31, 12, 22, 8]
    return layout


def words_of_a_text(**how: Unpack[Quickness]) -> pw.Layout:
    """Words by their number, in the font that comes with the package."""
    text = "the bear and the fox and the owl saw the bear in the old wood by the bear cave"
    counts = Counter(word for word in text.split() if len(word) > 2)
    return pw.words("cloud", counts, palette="tol-vibrant", **how)


def photographs_in_memory(**how: Unpack[Quickness]) -> pw.Layout:
    """Photographs as arrays; they are printed as finely as the file needs."""
    rows, columns = np.mgrid[:120, :180] / 120
    skies = [
        (np.dstack([rows * warm, 0.3 + 0.3 * columns, 1 - rows]).clip(0, 1) * 255).astype(np.uint8)
        for warm in (0.2, 0.5, 0.8, 1.0)
    ]
    return pw.photos("heart", skies, border="3%", **how)


def going_on(**how: Unpack[Quickness]) -> pw.Layout:
    """A layout that is gone on from: the same places, but a gap between items."""
    first = pw.fill("cloud", ["circle", "hexagon"], count=40, **how)
    return pw.fill("cloud", ["circle", "hexagon"], count=40, start=first, padding=2, **how)


def moved_by_hand(**how: Unpack[Quickness]) -> pw.Layout:
    """Items that were moved, then brought to where nothing overlaps."""
    layout = pw.fill("square", ["star", "heart"], count=20, **how)
    turned = replace(layout.poses, angle=np.zeros(len(layout)))
    upright = replace(layout, poses=turned)
    assert not upright.certified
    return pw.finish(upright, turn=False)


def loss_of_ones_own(**how: Unpack[Quickness]) -> pw.Layout:
    """A loss of the poses: large items to the left."""

    def by_size(placed: pw.PosedItems) -> pw.PoseTerm:
        large = placed.areas * placed.poses.scale**2
        pull = large / large.mean() - 1
        return pw.PoseTerm(float(pull @ placed.poses.x) / 600, pull / 600, np.zeros(len(pull)))

    return pw.fill("page", "circle", count=40, size_ratio=4, losses={by_size: 1.0}, **how)


def watched(**how: Unpack[Quickness]) -> pw.Layout:
    """A run that tells how far it is, and ends early when enough is covered; a PNG in memory."""
    covered = [0.0]
    layout = pw.fill(
        "heart", "leaf", count=30, observer=lambda step: covered.append(step.coverage),
        stop=lambda: covered[-1] > 0.85, **how,
    )  # fmt: skip
    picture = io.BytesIO()
    layout.save(picture, format="png", pixels=200)
    assert picture.getvalue() != layout.to_png(pixels=100)
    return layout


USES = (
    array_as_container, pictures_as_items, shapely_in_and_out, map_with_y_up, rows_of_a_frame,
    table_in_and_out, words_of_a_text, photographs_in_memory, going_on, moved_by_hand,
    loss_of_ones_own, watched,
)  # fmt: skip


def main(folder: Path = Path()) -> None:
    """Draw all of them into a folder."""
    for use in USES:
        use().save(folder / f"{use.__name__}.png", pixels=600, show_container=True)


if __name__ == "__main__":
    main()
