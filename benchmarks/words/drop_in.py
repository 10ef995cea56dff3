"""The default cloud of the drop-in beside the peer's, in turn, in one process."""

from __future__ import annotations

import time
from types import ModuleType
from typing import Any

from benchmarks.kit.manifests import Manifest
from benchmarks.words.clouds import vocabulary
from benchmarks.words.standing_in import warm_up

COUNT, WIDTH, HEIGHT = 200, 400, 200
ROUNDS = 9


def frequencies(count: int = COUNT) -> dict[str, float]:
    """Words whose frequency is one over their rank, as in texts (Zipf's law)."""
    return {word: 1 / (rank + 1) for rank, word in enumerate(vocabulary(count))}


def default_cloud(
    peer: ModuleType, ours: ModuleType, rounds: int = ROUNDS, count: int = COUNT
) -> Manifest:
    """Processor seconds of each round by either package, the first of words never seen before."""
    words = frequencies(count)
    for module in (peer, ours):
        warm_up(module)
    found: Manifest = {"words": count, "width": WIDTH, "height": HEIGHT, "runs": {}}
    for turn in range(rounds + 1):
        for name, module in (("wordcloud", peer), ("packwork", ours)):
            cloud, seconds = _timed(module, words)
            one = found["runs"].setdefault(name, {"first": seconds, "again": []})
            one["placed"] = len(cloud.layout_)
            if turn:
                one["again"].append(seconds)
    print(found, flush=True)
    return found


def _timed(module: ModuleType, words: dict[str, float]) -> tuple[Any, float]:
    began = time.process_time()
    cloud = module.WordCloud(width=WIDTH, height=HEIGHT, random_state=0)
    cloud.generate_from_frequencies(words).to_image()
    return cloud, time.process_time() - began
