"""Names of groups and of a map's parts among the items: where they lie, and what is told."""

from __future__ import annotations

import logging
from pathlib import Path

import numpy as np
import pytest
import shapely

import packwork as pw
from packwork.errors import ReadError, RecipeError
from packwork.readers.reading import SHAPES_NS
from packwork.readers.svg import container
from packwork.readers.svg.container import MOST_PARTS, container_of_svg, named_parts, parts_of_svg
from packwork.readers.svg.drawing import LARGESSE
from packwork.scene.swatch import representative_colour

QUICK = {"levels": "60", "epochs": 60, "effort": "draft", "seed": 0}
NAMES = ("star", "moon", "heart", "owl", "fish", "cloud")
GROUPS = ("In the sky", "On earth")

MAP = """<svg viewBox="0 0 400 200"><style>.a {{fill: teal}}</style><g id="layer1">
<path class="a" aria-label="West Land" d="M0 0h{0}v200h-{0}z"/>
<path id="East_Land" d="M{0} 0h160v200h-160z"/><path id="path77" d="M360 0h40v200h-40z"/>
<path id="{1}" d="M{0} 190h8v9h-8z"/></g></svg>"""


def _table(folder: Path, head: str = "name,kind,a,b", row: str = "{name},{kind},{a},{b}") -> str:
    rows = [
        row.format(name=name, kind=GROUPS[k // 3], a=int(k < 3), b=int(k > 2) + 0.01 * k)
        for k, name in enumerate(NAMES)
    ]
    path = folder / "kinds.csv"
    path.write_text("\n".join([head, *rows]), encoding="utf-8")
    return str(path)


@pytest.fixture
def land(tmp_path: Path) -> str:
    """A map of a wide land, one less wide, one without a name, and one too small for its."""
    path = tmp_path / "map.svg"
    path.write_text(MAP.format(200, "A_very_small_land"), encoding="utf-8")
    return str(path)


@pytest.mark.parametrize("sizes", ["free", "shared"])
def test_names_lie_upright_in_the_middle_of_their_groups(tmp_path: Path, sizes: str) -> None:
    layout = pw.fill(
        "circle", list(NAMES), count=48, sizes=sizes, embeddings=_table(tmp_path),
        label_regions=True, **QUICK,
    )  # fmt: skip
    assert layout.certified
    assert len(layout.items) == 50
    points = np.column_stack([layout.poses.x, layout.poses.y])
    names = np.array([item.name for item in layout.items])
    for number, group in enumerate(GROUPS):
        (at,) = np.flatnonzero(names == group)
        assert layout.poses.angle[at] == 0
        own = points[np.isin(names, NAMES[3 * number : 3 * number + 3])].mean(axis=0)
        other = points[np.isin(names, NAMES[3 - 3 * number : 6 - 3 * number])].mean(axis=0)
        assert np.hypot(*(points[at] - own)) < np.hypot(*(points[at] - other))
    first, second = (layout.items[k] for k in np.flatnonzero(np.isin(names, GROUPS)))
    heights = [np.ptp(item.outline.points[:, 1]) for item in (first, second)]
    assert heights[0] == pytest.approx(heights[1], rel=0.3)


def test_a_palette_tells_the_groups(tmp_path: Path) -> None:
    layout = pw.fill(
        "circle", list(NAMES), count=24, embeddings=_table(tmp_path), palette="#aa0000,#0000aa",
        shades="tint", **QUICK,
    )  # fmt: skip
    fills = [set(), set()]
    for item in layout.items:
        colour = representative_colour(item)
        fills[NAMES.index(item.name) // 3].add(colour[1:3] > colour[5:7])
    assert sorted(map(len, fills)) == [1, 1]
    assert fills[0] != fills[1]


def test_words_have_names_too(tmp_path: Path) -> None:
    words = {name: 3.0 + k for k, name in enumerate(NAMES)}
    layout = pw.words(
        "circle", words, embeddings=_table(tmp_path), label_regions=True, effort="draft"
    )
    assert layout.certified
    assert set(GROUPS) < {item.name for item in layout.items}


def test_parts_of_a_map_have_their_names_inside(
    land: str, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.WARNING, "packwork"):
        layout = pw.fill(land, list(NAMES), count=60, label_regions=True, **QUICK)
    assert layout.certified
    assert "A very small land: has no room for its name" in caplog.text
    labels = {
        item.name: outline.region
        for item, outline in zip(layout.items, layout.outlines, strict=True)
        if item.name not in NAMES
    }
    side = layout.container.width / 400
    assert set(labels) == {"West Land", "East Land"}
    assert shapely.box(0, 0, 200 * side, 200 * side).contains(labels["West Land"])
    assert shapely.box(200 * side, 0, 360 * side, 200 * side).contains(labels["East Land"])


def test_a_saved_layout_and_a_session_have_them(land: str, tmp_path: Path) -> None:
    layout = pw.fill(land, ["star"], count=20, label_regions=True, **QUICK)
    layout.save(tmp_path / "map.geojson")
    assert "West Land" in [item.name for item in pw.Layout.load(tmp_path / "map.geojson").items]
    session = layout.edit()
    session.move("West Land", "30%", "50%")
    session.finish()
    assert session.is_certified


@pytest.mark.parametrize(
    ("options", "error", "said"),
    [
        ({}, RecipeError, "label_regions: nothing has names"),
        ({"embeddings": {"star": [1, 0], "moon": [0, 1]}}, RecipeError, "nothing has names"),
        ({"embeddings": "TWO"}, ReadError, "columns of texts, 'kind', 'sort'; leave one"),
    ],
)
def test_nothing_to_name_is_one_line(
    tmp_path: Path, options: dict[str, object], error: type[Exception], said: str
) -> None:
    if options.get("embeddings") == "TWO":
        options = {
            "embeddings": _table(tmp_path, "name,kind,sort,a,b", "{name},{kind},odd,{a},{b}")
        }
    with pytest.raises(error, match=said) as refused:
        pw.fill("circle", ["star", "moon"], count=4, label_regions=True, **options, **QUICK)
    assert "\n" not in str(refused.value)


def test_ids_that_programs_give_are_no_names() -> None:
    shapes = "".join(
        f'<path id="{name}" d="M0 0h9v9z"/>'
        for name in ("path12", "g", "Layer_3", "polygon-7", "SVGID_1_", "x48213", "Peru", "A")
    )
    found = named_parts(f"<svg>{shapes}</svg>".encode())
    assert [name for name, _ in found] == ["Peru", "A"]
    title = b'<svg><path id="path1"><title> New \n York </title></path><rect id="Ohio"/></svg>'
    assert [name for name, _ in named_parts(title)] == ["New York", "Ohio"]


def test_parts_that_go_without_names_are_told() -> None:
    names = ["Peru", "Chile", *(f"part {'x' * 60} {k}" for k in "ab")]
    shapes = "".join(f'<path id="{name}" d="M0 0h9v9z"/>' for name in names)
    told = list[str]()
    found = list(named_parts(f"<svg>{shapes}</svg>".encode(), told.append))
    assert [name for name, _ in found] == ["Peru", "Chile"]
    assert told == ["2 of its parts go without: a name has at most 60 letters"]
    many = "".join(f'<path id="p{k}q" d="M0 0h9v9z"/>' for k in range(MOST_PARTS + 2))
    told.clear()
    assert len(list(named_parts(f"<svg>{many}</svg>".encode(), told.append))) == MOST_PARTS
    assert told == ["300 of its 302 parts are named, the first"]


def test_a_part_brings_only_definitions_that_it_refers_to(tmp_path: Path) -> None:
    sky = '<defs><linearGradient id="sky"><stop stop-color="#123"/></linearGradient></defs>'
    plain = '<path id="Peru" fill="#123456" d="M0 0h9v9z"/>'
    shaded = '<path id="Chile" fill="url(#sky)" d="M9 0h9v9z"/>'
    found = dict(named_parts(f"<svg>{sky}{plain}{shaded}</svg>".encode()))
    assert [b"<stop" in found[name] for name in ("Peru", "Chile")] == [False, True]


def test_parts_together_take_as_much_work_as_a_container(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shapes = '<path id="Peru" d="M0 0h9v9z"/><path id="Chile" d="M0 0h3v3z"/>'
    data = f'<svg viewBox="0 0 9 9">{shapes}</svg>'.encode()
    land = container_of_svg(data, "land", "land.svg")
    assert len(parts_of_svg(data, land)) == 2
    told = list[str]()
    stops = iter([False, True])
    assert len(parts_of_svg(data, land, told.append, lambda: next(stops))) == 1
    assert told.pop() == "stopped: the part Chile and those after it are not named"
    monkeypatch.setattr(container, "_BYTE_NS", 0.75 * LARGESSE * SHAPES_NS / len(data))
    assert [name for name, _ in parts_of_svg(data, land, told.append)] == ["Peru"]
    assert told == ["the part Chile and those after it are not named: it has too large parts"]


def test_hostile_names_stay_text(tmp_path: Path) -> None:
    evil = "&lt;script&gt;alert(1)&lt;/script&gt;"
    path = tmp_path / "evil.svg"
    path.write_text(
        f'<svg viewBox="0 0 300 300"><path aria-label="{evil}" d="M0 0h300v150h-300z"/>'
        '<path id="Ohio" d="M0 150h300v150h-300z"/></svg>',
        encoding="utf-8",
    )
    layout = pw.fill(str(path), ["star"], count=8, label_regions=True, **QUICK)
    layout.save(tmp_path / "out.svg")
    assert "<script" not in (tmp_path / "out.svg").read_text("utf-8")
