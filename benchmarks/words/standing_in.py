"""Programs written for one package, run with another in its place."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import ModuleType
from typing import Any

PEER = "wordcloud"

TIMED = (
    "generate", "generate_from_text", "generate_from_frequencies", "fit_words", "process_text",
    "recolor", "to_array", "to_image", "to_file", "to_svg",
)  # fmt: skip
"""Methods whose time counts: generating and drawing, not reading and importing."""

MAKING = TIMED[:4]
"""Those after which a cloud is there."""


class Watched:
    """Seconds of the processor that clouds took, and the clouds.

    Parameters
    ----------
    seconds
        Of generating and drawing, of all clouds together.
    clouds
        That were generated, each once, in their order.
    """

    def __init__(self) -> None:
        self.seconds = 0.0
        self.clouds: list[Any] = []
        self._depth = 0

    def timing(self, name: str, method: Callable[..., Any]) -> Callable[..., Any]:
        """The method, its seconds counted unless another that is counted calls it."""

        def timed(cloud: Any, *given: Any, **named: Any) -> Any:
            self._depth += 1
            began = time.process_time()
            try:
                return method(cloud, *given, **named)
            finally:
                self._depth -= 1
                if self._depth == 0:
                    self.seconds += time.process_time() - began
                    if name in MAKING and all(cloud is not other for other in self.clouds):
                        self.clouds.append(cloud)

        return timed


@contextmanager
def watching(module: ModuleType) -> Iterator[Watched]:
    """Count what a module's ``WordCloud`` takes."""
    watched, kind = Watched(), module.WordCloud
    methods = {name: kind.__dict__[name] for name in TIMED if name in kind.__dict__}
    for name, method in methods.items():
        setattr(kind, name, watched.timing(name, method))
    try:
        yield watched
    finally:
        for name, method in methods.items():
            setattr(kind, name, method)


@contextmanager
def standing_in(module: ModuleType, name: str = PEER) -> Iterator[None]:
    """Let ``import name`` give that module, and its submodules by the same names."""
    before = {key: one for key, one in sys.modules.items() if _is_of(key, name)}
    own = module.__name__
    instead = {
        name + key.removeprefix(own): one for key, one in sys.modules.items() if _is_of(key, own)
    }
    for key in before:
        del sys.modules[key]
    sys.modules.update({**instead, name: module})
    try:
        yield
    finally:
        for key in [key for key in sys.modules if _is_of(key, name)]:
            del sys.modules[key]
        sys.modules.update(before)


def _is_of(key: str, package: str) -> bool:
    return key == package or key.startswith(f"{package}.")


def warm_up(module: ModuleType) -> None:
    """A tiny cloud, so that nothing is compiled or loaded while time is taken."""
    cloud = module.WordCloud(width=90, height=60, random_state=0)
    cloud.generate_from_frequencies({"a": 1.0, "b": 0.5}).to_image()
