"""DXFs, read back by ezdxf: layers, units, places, areas."""

from __future__ import annotations

import io
from collections.abc import Callable
from dataclasses import replace

import ezdxf
import numpy as np
import pytest
import shapely
from ezdxf import recover
from ezdxf.document import Drawing
from ezdxf.entities.lwpolyline import LWPolylinePoints

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import region, silhouette
from packwork.readers.builtin import builtin_item
from packwork.scene.container import brought_over, on_canvas
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.units import canvas_size, convert
from packwork.writers.dxf import LAYERS, LinePoints, dxf_bytes, paper_unit

CODES = {"mm": 4, "cm": 5, "in": 1}


def opened(dxf: bytes) -> Drawing:
    """The drawing, as a strict reader takes it."""
    drawing, audit = recover.read(io.BytesIO(dxf))
    assert not audit.errors
    assert not audit.fixes
    return drawing


def rings(drawing: Drawing, layer: str) -> list[FloatArray]:
    """Vertices of a layer's polylines, in drawing units, y up."""
    lines = list(drawing.modelspace().query(f'LWPOLYLINE[layer=="{layer}"]'))
    assert all(line.closed for line in lines)
    assert not any(bulge for line in lines for *_, bulge in line.get_points("xyb"))
    return [np.array(line.get_points("xy")) for line in lines]


def on(layout: Layout, size: str) -> Layout:
    container = on_canvas(layout.container, canvas_size(size))
    poses = brought_over(layout.poses, layout.container, container)
    return replace(layout, container=container, poses=poses)


@pytest.mark.parametrize("size", ["200x150mm", "20x15cm", "8in", "600", "300pt", "A4-landscape"])
def test_items_come_back_in_real_units_y_up(three: Layout, size: str) -> None:
    layout = on(three, size)
    drawing = opened(dxf_bytes(layout))
    unit = paper_unit(layout.container.unit)
    assert drawing.header["$INSUNITS"] == CODES[unit]
    scale = convert(1.0, layout.container.unit, unit)
    height = layout.container.height
    down = np.array([[1 / scale, 0.0, 0.0], [0.0, -1 / scale, height]])
    seen = [region([affine.apply(down, ring)]) for ring in rings(drawing, "cut")]
    expected_rings = [region([ring]) for outline in layout.outlines for ring in outline.rings]
    for got, expected in zip(seen, expected_rings, strict=True):
        assert got.area == pytest.approx(expected.area, rel=1e-7)
        assert shapely.hausdorff_distance(got, expected) < 1e-8 * layout.container.side


def test_limits_are_the_sheet_and_extents_what_is_drawn(three: Layout) -> None:
    drawing = opened(dxf_bytes(on(three, "200x150mm")))
    assert drawing.header["$LIMMIN"] == (0, 0)
    assert drawing.header["$LIMMAX"] == (200, 150)
    points = np.concatenate([r for layer in LAYERS for r in rings(drawing, layer)])
    assert drawing.header["$EXTMIN"][:2] == pytest.approx(points.min(axis=0))
    assert drawing.header["$EXTMAX"][:2] == pytest.approx(points.max(axis=0))


def test_holes_that_are_packed_over_are_engraved(make_layout: Callable[..., Layout]) -> None:
    filled, kept = (builtin_item("ring", holes) for holes in ("fill", "keep"))
    drawing = opened(dxf_bytes(on(make_layout([filled, kept], scale=[0.2, 0.2]), "80mm")))
    assert len(rings(drawing, "cut")) == 3
    (bare,) = rings(drawing, "engrave")
    hole = filled.ink.rings[1]
    assert region([bare]).area == pytest.approx(0.2**2 * region([hole]).area, rel=1e-7)


def test_islands_in_what_is_bare_are_engraved_too(
    make_layout: Callable[..., Layout], ring_item: Item
) -> None:
    ink = Outline.from_region(ring_item.ink.region | shapely.box(-1, -1, 1, 1))
    target = replace(ring_item, ink=ink, outline=Outline.from_region(silhouette(ink.region)))
    drawing = opened(dxf_bytes(on(make_layout([target]), "80mm")))
    assert sorted(region([r]).area for r in rings(drawing, "engrave")) == pytest.approx([4, 64])


def test_the_container_has_a_layer_of_its_own(three: Layout) -> None:
    (ring,) = rings(opened(dxf_bytes(on(three, "80mm"))), "container")
    assert region([ring]).area == pytest.approx(76 * 56)
    assert region([ring]).bounds == pytest.approx((2, 2, 78, 58))


def test_layers_have_colours_that_cutters_tell_apart(three: Layout) -> None:
    drawing = opened(dxf_bytes(three))
    assert {name: drawing.layers.get(name).color for name in LAYERS} == LAYERS


def test_no_items(make_layout: Callable[..., Layout]) -> None:
    drawing = opened(dxf_bytes(make_layout([])))
    assert len(drawing.modelspace()) == 1


def test_same_layout_same_bytes_and_no_trace_in_the_library(three: Layout) -> None:
    before = ezdxf.options.write_fixed_meta_data_for_testing
    assert dxf_bytes(three) == dxf_bytes(three)
    assert ezdxf.options.write_fixed_meta_data_for_testing is before


def test_points_are_written_as_ezdxf_would_write_them() -> None:
    ring = np.random.default_rng(0).normal(0, 1e3, (50, 2)).round(6)
    ring[:3] = [[0, -0.0], [1e-6, 1e20], [1e-9, 3]]
    own = LWPolylinePoints()
    own.set(np.column_stack([ring, np.zeros((50, 3))]))
    assert LinePoints(ring, np.zeros(len(ring))).dxfstr() == "".join(
        tag.dxfstr() for tag in own.dxftags()
    )
