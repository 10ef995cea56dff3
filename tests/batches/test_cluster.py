"""A cluster makes the same bytes as one process, whatever becomes of its workers."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import packwork as pw
from batches.by_hand import Cluster
from packwork.batches.batch import (
    BatchPlan,
    BatchRequest,
    Template,
    batch_progress,
    plan_batch,
    run_batch,
)
from packwork.batches.cluster import parcel_of
from packwork.batches.task import RowOutcome
from packwork.errors import PackworkError
from packwork.readers.reading import exists, is_folder, read_bytes
from packwork.sources import mirrored, names_like, place_in

SVG = '<svg viewBox="0 0 9 9"><path d="M0 0h9v{}z"/></svg>'
POSTER = {
    "container": "{shape}", "items": ["star", "{art}", "drawn/"], "count": "{n}", "epochs": 20,
    "levels": "50", "effort": "draft",
}  # fmt: skip


@pytest.fixture
def home(tmp_path: Path) -> Path:
    (tmp_path / "drawn").mkdir()
    for k in range(2):
        (tmp_path / "drawn" / f"{k}.svg").write_text(SVG.format(5 + k), encoding="utf-8")
    (tmp_path / "own.svg").write_text(SVG.format(9), encoding="utf-8")
    return tmp_path


def plan_of(home: Path, out: str, count: int = 4) -> BatchPlan:
    shapes = ["heart", "circle", "text:Z"]
    rows: list[dict[str, Any]] = [
        {"name": f"row{k}", "shape": shapes[k % 3], "art": "own.svg", "n": 4 + k}
        for k in range(count)
    ]
    request = BatchRequest(
        templates=[Template("poster", POSTER, home)],
        rows=rows,
        columns=tuple(rows[0]),
        outputs=[f"{home / out}/{{name}}.svg", f"{home / out}/{{name}}.geojson"],
        drawing={},
    )
    return plan_batch(request)


def contents(folder: Path) -> dict[str, bytes]:
    """Files of rows; of records what does not tell the time."""
    found = {}
    for path in sorted(folder.iterdir()):
        data = path.read_bytes()
        if path.suffix in {".json", ".geojson"}:
            told = json.loads(data)
            told.pop("seconds", None)
            told.get("manifest", {}).pop("seconds", None)
            if path.suffix == ".json":
                told["outputs"], told["key"] = sorted(told["outputs"]), ""
            for level in told.get("manifest", {}).get("levels", []):
                level.pop("seconds", None)
            data = json.dumps(told, sort_keys=True).encode()
        found[path.name] = data
    return found


def statuses(outcomes: Any) -> list[str]:
    return [one.status for one in outcomes]


@pytest.fixture(scope="module")
def started() -> Iterator[list[Cluster]]:
    """Clusters of this module, of which the last one may run."""
    pytest.importorskip("distributed", reason="the extra packwork[cluster] is not installed")
    found = list[Cluster]()
    yield found
    for one in found:
        one.close()


@pytest.fixture
def cluster(started: list[Cluster], tmp_path_factory: pytest.TempPathFactory) -> Cluster:
    """A cluster of a worker or more, of which processes may be killed: another takes the place."""
    if not started or started[-1].scheduler.poll() is not None:
        started.append(Cluster(tmp_path_factory.mktemp("cluster")))
    one = started[-1]
    one.workers = [worker for worker in one.workers if worker.poll() is None]
    if not one.workers:
        one.workers.append(one.add_worker())
    return one


def test_workers_far_away_make_the_same_bytes_from_what_they_are_sent(
    home: Path, cluster: Cluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(home)
    plan = plan_of(Path(), "alone")
    assert statuses(run_batch(plan, batch_progress(plan), 1)) == ["made"] * 4
    plan = plan_of(Path(), "far")
    found = run_batch(plan, batch_progress(plan), scheduler=cluster.address)
    assert statuses(found) == ["made"] * 4
    assert contents(Path("far")) == contents(Path("alone"))
    again = plan_of(Path(), "far")
    assert len(batch_progress(again).kept) == 4


def test_a_worker_that_is_killed_costs_no_row(home: Path, cluster: Cluster) -> None:
    plan, heard = plan_of(home, "far"), list[RowOutcome]()

    def kill_one(outcome: RowOutcome) -> None:
        if not heard:
            cluster.workers[0].kill()
        heard.append(outcome)

    found = run_batch(plan, batch_progress(plan), told=kill_one, scheduler=cluster.address)
    assert statuses(found) == ["made"] * 4


def test_a_row_that_ends_its_workers_fails_alone(
    home: Path, cluster: Cluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    code = "import os\n\n\ndef die(*_):\n    os._exit(9)\n"
    for folder in (home, cluster.folder):
        (folder / "deadly.py").write_text(code, encoding="utf-8")
    monkeypatch.syspath_prepend(str(home))
    poster = {"container": "heart", "items": ["star"], "count": 3, "losses": {"{loss}": 1}}
    rows = [
        {"name": "a", "loss": "overlap"},
        {"name": "b", "loss": "deadly:die"},
        {"name": "c", "loss": "overlap"},
    ]
    # Two are ended by it, and one is left.
    while len(cluster.workers) < 3:
        cluster.workers.append(cluster.add_worker())
    made = pw.batch(poster, rows, home / "{name}.svg", scheduler=cluster.address, allow_code=True)
    assert made.outcomes[1].status == "failed"
    assert "its workers were ended" in made.outcomes[1].said
    assert {made.outcomes[k].status for k in (0, 2)} <= {"made", "short"}


def test_a_bad_row_is_its_own_and_in_place_needs_no_sending(home: Path, cluster: Cluster) -> None:
    rows = [
        {"name": "a", "shape": "heart", "art": str(home / "own.svg"), "n": 4},
        {"name": "b", "shape": "none.svg", "art": "leaf", "n": 4},
    ]
    poster = {**POSTER, "items": ["star", "{art}"]}
    for in_place in (False, True):
        made = pw.batch(
            poster, rows, home / f"{in_place}-{{name}}.svg", scheduler=cluster.address,
            in_place=in_place,
        )  # fmt: skip
        assert statuses(made) == ["made", "failed"]
        assert "none.svg: there is no such file" in made.failed[0].said
    files = [(home / f"{in_place}-a.svg").read_bytes() for in_place in (False, True)]
    assert files[0] == files[1]


def test_a_scheduler_that_is_lost_ends_with_what_was_made(
    home: Path, cluster: Cluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("packwork.batches.cluster.LOST_SECONDS", 1.0)
    plan, heard = plan_of(home, "far"), list[RowOutcome]()

    def kill(outcome: RowOutcome) -> None:
        if not heard:
            cluster.scheduler.kill()
        heard.append(outcome)

    found = run_batch(plan, batch_progress(plan), told=kill, scheduler=cluster.address)
    assert "made" in statuses(found)
    assert "stopped" in statuses(found)
    assert set(statuses(found)) == {"made", "stopped"}
    assert not list((home / "far").glob(".packwork-*"))
    rest = run_batch(plan, batch_progress(plan), 1)
    assert set(statuses(rest)) == {"made", "kept"}


def test_a_local_cluster_serves_too(home: Path) -> None:
    distributed = pytest.importorskip("distributed", reason="packwork[cluster] is not installed")
    local = distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, dashboard_address=":0", silence_logs=50
    )
    with local:
        plan = plan_of(home, "local", 3)
        found = run_batch(plan, batch_progress(plan), scheduler=local.scheduler_address)
    assert statuses(found) == ["made"] * 3


def test_without_a_scheduler_or_dask_it_is_one_line(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    out = str(tmp_path / "{a}.svg")
    row = [{"a": 1}]
    poster = {"container": "heart", "items": ["star"], "count": 2}
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(PackworkError, match=r"needs distributed.*packwork\[cluster\]"):
        pw.batch(poster, row, out, scheduler="tcp://127.0.0.1:1")
    monkeypatch.undo()
    pytest.importorskip("distributed")
    monkeypatch.setattr("packwork.batches.cluster.LOST_SECONDS", 0.5)
    with pytest.raises(PackworkError, match=r"no scheduler at tcp://127\.0\.0\.1:1") as caught:
        pw.batch(poster, row, out, scheduler="tcp://127.0.0.1:1")
    assert "\n" not in str(caught.value)


def test_a_parcel_holds_what_is_read_and_a_mirror_calls_it_so(home: Path, tmp_path: Path) -> None:
    parcel = parcel_of(plan_of(home, "x", 1).tasks[0])
    assert sorted(Path(name).name for name in parcel.files) == ["0.svg", "1.svg", "own.svg"]
    mirror = tmp_path / "mirror"
    for name, content in parcel.files.items():
        place_in(mirror, name).parent.mkdir(parents=True, exist_ok=True)
        place_in(mirror, name).write_bytes(content)
    (home / "own.svg").unlink()
    name = str(home / "own.svg")
    assert not exists(name)
    with mirrored(mirror):
        assert exists(name)
        assert is_folder(home / "drawn")
        assert read_bytes(name, 1_000) == SVG.format(9).encode()
        names = [str(home / "drawn" / f"{k}.svg") for k in (0, 1)]
        assert sorted(names_like(str(home / "drawn" / "*.svg"))) == names
