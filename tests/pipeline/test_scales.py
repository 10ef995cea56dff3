"""Nothing depends on absolute canvas units, and no stage works without a bound."""

from __future__ import annotations

import numpy as np
import pytest

import packwork as pw
from packwork import uses
from packwork.recipe import make_recipe
from packwork.steps import voids
from scenes import flat_item, round_container, star

QUICK = {"epochs": 12, "levels": "24,48", "effort": "draft", "count": 6}


@pytest.mark.parametrize("canvas", ["0.002px", "900000px", "0.5mm", "250m"])
def test_tiny_and_huge_canvases_give_the_same_layout(canvas: str) -> None:
    if canvas == "250m":
        with pytest.raises(pw.PackworkError, match="canvas"):
            pw.fill("heart", ["star", "moon"], canvas=canvas, **QUICK)
        return
    plain, other = (
        pw.fill("heart", ["star", "moon"], canvas=size, **QUICK) for size in ("600px", canvas)
    )
    ratio = other.container.side / plain.container.side
    assert len(plain.poses) == len(other.poses) == 6
    np.testing.assert_allclose(other.poses.x, plain.poses.x * ratio, rtol=0.02)
    np.testing.assert_allclose(other.poses.scale, plain.poses.scale * ratio, rtol=0.1)
    assert other.manifest["certified"]


def test_filling_gaps_ends_when_its_work_is_done(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(voids, "MOST_WORK", {"draft": 2.5 * voids.IMAGE_WORK})
    recipe = make_recipe(
        container="circle", items=["star"], target_coverage=0.99, smallest="0.1%", **QUICK
    )
    met = uses.fill(recipe, [flat_item("star", star(9.0, 4.0))], round_container(100.0))
    assert met.filling is not None
    assert "take too long; a higher --effort would do" in met.filling.ending
    assert met.certified
