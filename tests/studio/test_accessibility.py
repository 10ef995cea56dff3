"""Nothing serious found by axe-core, where it is there; ``make setup-page`` fetches it."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from studio.browsing import PHONE, WIDE, Desk, in_browser

ROOT = Path(__file__).parents[2]

AXE = Path(os.environ.get("PACKWORK_AXE", ROOT / ".page/node_modules/axe-core/axe.min.js"))
"""The script of axe-core."""

pytestmark = [
    *in_browser,
    pytest.mark.skipif(not AXE.is_file(), reason="no axe-core; make setup-page fetches it"),
]

SERIOUS = ("serious", "critical")

RUN = "() => axe.run(document, { resultTypes: ['violations'] }).then((found) => found.violations)"


def faults(desk: Desk) -> list[str]:
    """What is seriously wrong with the page as it is now."""
    if not desk.look("Boolean(globalThis.axe)"):
        desk.page.evaluate(AXE.read_text(encoding="utf-8"))
    found: list[dict[str, Any]] = desk.page.evaluate(RUN)
    return [
        f"{one['id']}: {node['html']} {node['failureSummary']}"
        for one in found
        if one["impact"] in SERIOUS
        for node in one["nodes"][:4]
    ]


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", [WIDE, PHONE], ids=["wide", "phone"])
def test_no_panel_or_dialog_has_a_serious_fault(
    open_desk: Callable[..., Desk], size: dict[str, int], scheme: str
) -> None:
    desk = open_desk(size, color_scheme=scheme)
    desk.page.keyboard.press("n")
    found = faults(desk)
    for panel in ("room", "items", "words", "options", "more", "look"):
        if desk.look(f"document.getElementById('tab-{panel}').ariaPressed") != "true":
            desk.page.locator(f"#tab-{panel}").click()
        desk.until("studio.panels.choices !== null")
        desk.look("document.querySelectorAll('details').forEach((one) => { one.open = true; })")
        found += faults(desk)
    for keys in ("Control+e", "?", "Shift+R"):
        desk.page.keyboard.press(keys)
        desk.until("document.querySelector('dialog[open]')")
        desk.page.wait_for_timeout(100)
        found += faults(desk)
        desk.page.keyboard.press("Escape")
        desk.until("!document.querySelector('dialog[open]')")
    assert sorted(set(found)) == []
