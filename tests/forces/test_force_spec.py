"""Forces as people write them."""

from __future__ import annotations

import pytest

from packwork.errors import RecipeError
from packwork.forces.spec import ForceSpec, parse_force

GOOD = {
    "down": ForceSpec("direction", angle=90.0),
    "-90deg": ForceSpec("direction", angle=270.0),
    "towards centre": ForceSpec("towards", places=("50%,50%",)),
    "towards 1,2mm 30%,4": ForceSpec("towards", places=("1,2mm", "30%,4")),
    "away line 0,0 9,0 reach=20%": ForceSpec(
        "away", places=("0,0", "9,0"), is_line=True, reach="20%"
    ),
    "towards river.svg": ForceSpec("towards", places=("river.svg",), is_line=True),
    "inward strength=3": ForceSpec("inward", strength=3.0),
    "align vertical items=a*,b": ForceSpec("align", axis="vertical", items=("a*", "b")),
    "balance": ForceSpec("balance", places=("50%,50%",)),
    "balance vertical": ForceSpec("balance", axis="vertical", places=("50%,50%",)),
    "together by=weight": ForceSpec("together", by_weight=True),
}
BAD = {
    "": "is empty",
    "gravity": "no force is called",
    "dwn": "did you mean down",
    "down 3": "takes no '3'",
    "towards": "use towards or away with",
    "towards 1": "use towards or away with",
    "towards line 1,1": "use towards or away with",
    "towards line 1,1 1,1": "has no length",
    "align diagonal": "align horizontal or align vertical",
    "balance 1,2 3,4": "use balance with",
    "down strength=0": "strength must be above 0",
    "down strength=nan": "strength must be above 0",
    "down strength=-1": "away pushes",
    "down reach=0": "use a length",
    "down by=name": "use by=weight",
    "down speed=3": "has no 'speed'",
}


@pytest.mark.parametrize("text", GOOD)
def test_a_force_is_read(text: str) -> None:
    assert parse_force(text) == GOOD[text]


@pytest.mark.parametrize("text", BAD)
def test_a_bad_force_is_refused_in_one_line(text: str) -> None:
    with pytest.raises(RecipeError, match=r"^force: ") as caught:
        parse_force(text)
    assert BAD[text] in str(caught.value)
    assert "\n" not in str(caught.value)
