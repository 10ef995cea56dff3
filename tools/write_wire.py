"""Write the studio's list of messages for its page, ``src/packwork/studio/static/wire.js``."""

from __future__ import annotations

from pathlib import Path

from packwork import studio
from packwork.studio.messages import schema
from packwork.studio.wire import page_types

if __name__ == "__main__":
    path = Path(studio.__file__).parent / "static" / "wire.js"
    path.write_text(page_types(schema()), encoding="utf-8")
