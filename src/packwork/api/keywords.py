"""Tables of options at run time, as the stub beside this lists them: they are written down once."""

from __future__ import annotations

from pathlib import Path

_STUB = Path(__file__).with_suffix(".pyi")

exec(compile(_STUB.read_text(encoding="utf-8"), _STUB, "exec"))  # noqa: S102 - our own words
