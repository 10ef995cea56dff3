"""Names of rows' files: any system takes them, none leaves its folder."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from packwork.batches.templates import identity_of, path_of
from packwork.errors import RecipeError


@pytest.mark.parametrize(
    "cell", ["AC/DC", "..", ".", "a\\b", "a:b", "what?", "a\nb", "a\0b", "<b>", '"', "a|b", "*"]
)
def test_what_no_name_may_hold_is_refused_by_its_column(cell: str) -> None:
    with pytest.raises(RecipeError, match=r"^name: "):
        path_of("out/{name}.svg", {"name": cell})


@pytest.mark.parametrize("name", ["nul", "COM1", "lpt9"])
def test_devices_of_windows_are_refused(name: str) -> None:
    with pytest.raises(RecipeError, match="device"):
        path_of("out/{name}.svg", {"name": name})


@given(st.text(max_size=300))
def test_a_name_that_passes_lies_in_the_folder(cell: str) -> None:
    try:
        path = path_of("out/{name}.svg", {"name": cell})
    except RecipeError:
        return
    assert path.resolve().parent == Path("out").resolve()
    assert len(path.name.encode(errors="surrogatepass")) <= 255


def test_names_that_some_file_system_takes_for_one_are_one() -> None:
    assert identity_of(Path("Zoë.svg")) == identity_of(Path("ZOE\u0308.svg"))
