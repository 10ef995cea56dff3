"""``python -m packwork.inkscape``: one request in, lines of JSON out.

The request is one object of JSON on standard input: ``verb`` and its arguments. Each line of the
answer is an object: ``progress`` from 0 to 1, any number of times; then ``error``, one line, or
what :class:`packwork.inkscape.arranging.Arranged` holds.
"""

from __future__ import annotations

import json
import sys
import time
from dataclasses import asdict
from typing import Any

from packwork.errors import PackworkError
from packwork.inkscape import arranging
from packwork.progress import Step
from packwork.readers.svg.objects import OpenDrawing


def main() -> None:
    """Answer one request; whoever asked and has gone is worked for no more."""
    request = json.load(sys.stdin)
    try:
        answer = asdict(_arranged(request))
    except PackworkError as error:
        answer = {"error": str(error)}
    _tell(answer)


def _arranged(request: dict[str, Any]) -> arranging.Arranged:
    verb, options = request.pop("verb"), request.pop("options")
    drawing = OpenDrawing(request.pop("drawing").encode())
    if verb == "nest":
        start, seconds, told = time.monotonic(), options["time"], 0.0

        def stop() -> bool:
            # A pass takes a few milliseconds: each percent is told once.
            nonlocal told
            share = min(1.0, (time.monotonic() - start) / seconds)
            if share >= told + 0.01:
                told = share
                _tell({"progress": share})
            return False

        return arranging.nest(drawing, **request, options=options, stop=stop)

    def tell_step(step: Step) -> None:
        _tell({"progress": step.progress})

    arrange = arranging.fill if verb == "fill" else arranging.words
    return arrange(drawing, **request, options=options | {"observer": tell_step})


def _tell(line: dict[str, Any]) -> None:
    sys.stdout.write(f"{json.dumps(line)}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    main()
