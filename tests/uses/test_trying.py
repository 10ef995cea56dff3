"""Photos begin in several ways, and go on with the best of them."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import pytest
from PIL import Image

from packwork import pipeline, uses
from packwork.pipeline.job import Job
from packwork.progress import Step
from packwork.recipe import Recipe
from packwork.steps.control import BestOf
from packwork.uses.photos.use import PHOTO_STARTS, starts_tried

QUICK = {"epochs": 40, "levels": (50, 150), "seed": 1}


@pytest.fixture(scope="module")
def album(tmp_path_factory: pytest.TempPathFactory) -> str:
    folder = tmp_path_factory.mktemp("album")
    for k in range(12):
        Image.new("RGB", (60 + 7 * k, 90 - 3 * k), "teal").save(folder / f"photo-{k:02}.jpg")
    return str(folder)


def job(album: str, **options: Any) -> Job:
    return uses.read(uses.photos_recipe("fish", album, **(QUICK | options)))


def test_the_start_that_covers_most_is_gone_on_with(
    album: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("packwork.pipeline.plan.plan.PHOTO_TRIALS", 0)
    alone = {
        start: pipeline.run(job(album, start=start)).metrics.as_dict()["LC"]
        for start in PHOTO_STARTS
    }
    chosen = pipeline.run(job(album))
    assert len(set(alone.values())) == len(alone)
    assert chosen.layout.manifest["start"] == max(alone, key=alone.__getitem__)
    assert chosen.metrics.as_dict()["LC"] == max(alone.values())
    assert chosen.layout.manifest["recipe"].get("start") is None


def test_a_film_shows_the_start_that_was_chosen(album: str) -> None:
    done = pipeline.run(job(album, effort="normal"), record=True)
    again = pipeline.run(
        job(album, effort="normal", start=done.layout.manifest["start"]), record=True
    )
    assert done.layout.track is not None
    assert again.layout.track is not None
    assert done.layout.track.numbers.tolist() == again.layout.track.numbers.tolist()


@pytest.mark.parametrize(
    ("options", "count"),
    [
        ({}, len(PHOTO_STARTS)),
        ({"start": "scatter"}, 1),
        ({"effort": "draft"}, 1),
        ({"time": 2.0}, 1),
        ({"sizes": "shared"}, 1),
        ({"finish": "none"}, 1),
    ],
)
def test_who_chose_for_himself_gets_that(album: str, options: dict[str, Any], count: int) -> None:
    one = job(album, **options)
    tried = sum(isinstance(step, BestOf) for step in one.use.steps(one))
    assert starts_tried(one) == (PHOTO_STARTS if count > 1 else ())
    assert tried == (count > 1)


def test_photos_of_one_size_are_left_to_the_levels(album: str) -> None:
    done = pipeline.run(job(album, epochs=None, levels=None, sizes="shared", count=4))
    assert done.layout.manifest["start"] == "distance-field"


def test_many_icons_begin_in_one_way() -> None:
    one = uses.read(Recipe(container="heart", items=("star",), count=30))
    assert not any(isinstance(step, BestOf) for step in one.use.steps(one))


def test_stopped_at_once_it_ends_with_what_it_has(album: str) -> None:
    done = pipeline.run(job(album), stop=lambda: True)
    assert done.layout.manifest["start"] == PHOTO_STARTS[0]


class Watch:
    """Keeps the progress."""

    every = 10

    def __init__(self) -> None:
        self.progress: list[float] = []

    def on_step(self, step: Step) -> None:
        """Keep it."""
        self.progress.append(step.progress)


def test_progress_of_several_starts_goes_from_0_to_1_once(album: str) -> None:
    watch = Watch()
    pipeline.run(job(album), watch)
    assert all(a <= b for a, b in pairwise(watch.progress))
    assert watch.progress[0] < 0.2
    assert watch.progress[-1] == 1.0
