"""The widest place of a container, of thin ones by a picture."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from packwork.geometry.outline import Outline
from packwork.pipeline.plan import counts as widest
from packwork.pipeline.plan.counts import widest_cu
from packwork.readers.container import read_container


@pytest.mark.parametrize("name", ["circle", "heart", "islands", "ring"])
def test_a_picture_tells_what_the_exact_search_tells(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    outline = read_container(name).outline
    exact = widest_cu(outline)
    monkeypatch.setattr(widest, "THIN", 1.0)
    assert widest_cu(outline) == pytest.approx(exact, abs=6e-3 * outline.extent)


def test_hairs_are_not_searched_one_by_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """The ball among them is found, and of hairs alone how wide they are on average."""

    def refuses(*_: object) -> None:
        raise AssertionError

    monkeypatch.setattr(shapely, "maximum_inscribed_circle", refuses)
    left = np.arange(0.0, 600.0, 0.5)
    hairs = shapely.box(left, 0.0, left + 0.02, 600.0)
    alone = Outline.from_region(shapely.MultiPolygon(list(hairs)))
    assert widest_cu(alone) == pytest.approx(0.02, rel=0.01)
    ball = shapely.Point(300, 300).buffer(15, quad_segs=90)
    both = Outline.from_region(shapely.union_all([ball, *hairs]))
    assert widest_cu(both) == pytest.approx(30.0, abs=4.0)
