"""Losses by epoch: kept on request, of all that a run does, and nothing else is changed by it."""

from __future__ import annotations

import copy
import pickle
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import packwork as pw
from packwork.api.history import HistoryKeeper
from packwork.progress import ObjectiveTerms, Step
from scenes import poses

QUICK: dict[str, Any] = {"epochs": 40, "levels": "32,64", "seed": 1}


def made(**options: Any) -> pw.Layout:
    return pw.fill("circle", ["star"], count=5, **(QUICK | options))


def kept(layout: pw.Layout) -> pw.History:
    assert layout.history is not None
    return layout.history


def test_each_epoch_of_each_level_is_kept() -> None:
    history = kept(made(history=True))
    levels = [row for row in history if row["stage"] == "levels"]
    assert [row["epoch"] for row in levels] == list(range(1, 41))
    assert {(row["level"], row["level_px"]) for row in levels} == {(0, 32), (1, 64)}
    assert {row["solve"] for row in history} == {1}
    for name in ("containment", "overlap", "filling", "evenness", "recall", "total"):
        cells = history[name]
        assert np.isfinite(cells[: len(levels)]).all()
        assert np.isnan(cells[len(levels) :]).all()
    assert history["filling"][39] < history["filling"][0]


def test_the_end_is_the_layout() -> None:
    layout = made(history=True)
    history = kept(layout)
    assert (history["stage"][-1], history["progress"][-1]) == ("done", 1.0)
    assert history["LC"][-1] == pytest.approx(layout.metrics["exact"]["LC"])
    assert "finish" in history["stage"]


def test_fewer_epochs_are_kept_if_that_is_asked() -> None:
    history = kept(made(history=15))
    assert history["epoch"][history["stage"] == "levels"].tolist() == [1, 16, 20, 31, 40]


def test_nothing_is_kept_unasked() -> None:
    assert made().history is None


def test_the_same_bytes_come_with_and_without(tmp_path: Path) -> None:
    plain, watched = made(), made(history=True)
    for ending in ("svg", "geojson", "png"):
        for name, layout in (("plain", plain), ("watched", watched)):
            layout.save(tmp_path / f"{name}.{ending}")
        written = [(tmp_path / f"{name}.{ending}").read_bytes() for name in ("plain", "watched")]
        assert written[0] == written[1]
    assert pw.Layout.load(tmp_path / "watched.geojson").history is None


def test_a_history_is_a_value() -> None:
    layout = made(history=10)
    for again in (pickle.loads(pickle.dumps(layout)), copy.deepcopy(layout)):  # noqa: S301
        assert list(kept(again).columns) == list(kept(layout).columns)
        np.testing.assert_array_equal(kept(again)["total"], kept(layout)["total"])
        with pytest.raises(ValueError, match="read-only"):
            kept(again)["total"][0] = 1.0
    with pytest.raises(TypeError, match="read-only"):
        kept(layout).columns["total"] = np.zeros(3)  # type: ignore[index]
    assert replace(layout, notes=()).history is None
    assert pw.finish(layout).history is None


def test_a_history_becomes_a_data_frame() -> None:
    pytest.importorskip("pandas")
    history = kept(made(history=10))
    frame = history.to_dataframe()
    assert frame.shape == (len(history), len(history.columns))
    assert frame.groupby("stage")["LC"].max().index.tolist() == ["done", "finish", "levels"]


def test_losses_of_ones_own_have_a_column() -> None:
    def epoch(density: Any, container: Any) -> pw.Term:
        return pw.Term(float(density.mean()), np.ones_like(density) / density.size)

    def leftmost(placed: pw.PosedItems) -> pw.PoseTerm:
        count = len(placed.poses)
        return pw.PoseTerm(placed.poses.x.mean(), np.full(count, 1 / count), np.zeros(count))

    history = kept(made(losses={epoch: 0.1, leftmost: 1e-4}, history=10))
    assert history["loss_epoch"][0] > 0.1
    assert 100 < history["leftmost"][0] < 500
    assert history["epoch"][0] == 1


def test_observers_are_told_as_often_as_without() -> None:
    alone: list[int] = []
    beside: list[int] = []
    made(observer=lambda step: alone.append(step.epoch))
    made(observer=lambda step: beside.append(step.epoch), history=3)
    assert alone == beside


def test_a_further_solve_is_numbered() -> None:
    keeper = HistoryKeeper(1)
    for epoch in (1, 2, 1):
        keeper.on_step(
            Step(0, 1, 32, epoch, 0.0, poses([1.0], [1.0]), lambda: (0.0, 0.0, 0.0),
                 priced=lambda: ObjectiveTerms(1.0, {"overlap": 2.0}))
        )  # fmt: skip
    assert keeper.history()["solve"].tolist() == [1, 1, 2]


@pytest.mark.parametrize("asked", [-1, 2.5, "all", None])
def test_a_history_is_asked_for_by_a_number(asked: Any) -> None:
    with pytest.raises(pw.RecipeError, match="history: must be True, False or a number"):
        made(history=asked)


def test_every_verb_keeps_one(tmp_path: Path) -> None:
    Image.new("RGB", (30, 20), "teal").save(tmp_path / "sea.png")
    layouts = [
        pw.words("circle", {"owl": 2, "fox": 1}, history=10, **QUICK),
        pw.photos("circle", tmp_path / "sea.png", history=10, record=True, **QUICK),
        pw.chart("circle", {"kg": [3, 1]}, size_by="kg", history=10, **QUICK),
        pw.pile("square", "circle", count=3, size="30%", history=10),
        pw.run({"container": "circle", "items": ["star"], **QUICK}, history=10),
    ]
    assert [kept(layout)["stage"][-1] for layout in layouts] == ["done"] * 5
    assert layouts[1].track is not None


def lively(density: Any, container: Any) -> pw.Term:
    return pw.Term(float(density.mean()), np.ones_like(density) / density.size)


@pytest.mark.parametrize(
    "options",
    [{}, {"preset": "paper"}, {"losses": {"area-shares": 2.0, lively: 0.5}, "force": "down"}],
)
def test_the_total_is_the_sum_of_the_terms_by_their_weights(options: dict[str, Any]) -> None:
    history = kept(made(history=True, **options))
    levels = history["stage"] == "levels"
    terms = [name.removeprefix("weight_") for name in history.columns if "weight_" in name]
    weighed = [history[f"weight_{name}"] * history[name] for name in terms]
    np.testing.assert_allclose(np.sum(weighed, axis=0)[levels], history["total"][levels])


@pytest.mark.parametrize("preset", ["default", "paper"])
def test_the_manifest_has_all_weights_of_the_levels(preset: str) -> None:
    layout = made(history=True, preset=preset, losses={"filling": 0.5, "overlap": 0, lively: 0.25})
    solve, history = layout.manifest["solve"], kept(layout)
    assert solve["losses"]["filling"] == 0.5
    assert solve["losses"]["lively"] == 0.25
    assert "overlap" not in solve["losses"]
    assert solve["epochs"] == QUICK["epochs"]
    for k, epoch in enumerate(history["epoch"][history["stage"] == "levels"]):
        progress = min(epoch / (solve["epochs"] - 1), 1.0)
        is_settling = progress > 1 - solve["settling"]
        for name, weight in {**solve["losses"], "recall": solve["recall"]}.items():
            grown = 1.0 if name == "filling" else solve["hardening"] ** progress
            cut = is_settling and name in {"filling", "evenness"}
            factor = grown * (solve["settling_reward"] if cut else 1.0)
            assert history[f"weight_{name}"][k] == pytest.approx(weight * factor)


@pytest.mark.parametrize(
    ("preset", "name", "said"),
    [
        ("paper", "containment", "paper-containment, overlap, paper-evenness"),
        ("paper", "filling", "paper-containment, overlap, paper-evenness"),
        ("default", "paper-evenness", "containment, overlap, filling, evenness"),
    ],
)
def test_no_loss_is_left_out_that_the_preset_has_not(preset: str, name: str, said: str) -> None:
    with pytest.raises(pw.RecipeError, match=f"losses: {name} is none .*{preset}.*{said}$"):
        made(preset=preset, losses={name: 0})
    # Beside the preset's own it is one more.
    layout = made(preset=preset, losses={name: 1.0})
    assert layout.manifest["solve"]["losses"][name] == 1.0


def test_a_loss_that_weighs_nothing_anyway_is_told(caplog: pytest.LogCaptureFixture) -> None:
    layout = made(sizes="shared", losses={"evenness": 0, lively: 0})
    assert "the loss evenness weighs nothing here anyway" in caplog.text
    assert "evenness" not in layout.manifest["solve"]["losses"]
