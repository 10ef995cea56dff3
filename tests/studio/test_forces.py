"""Forces drawn as arrows."""

from __future__ import annotations

from collections.abc import Callable

from studio.browsing import Desk, in_browser

pytestmark = in_browser


def test_an_arrow_that_is_drawn_is_a_force(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.page.locator("#tab-options").click()
    desk.page.get_by_role("button", name="Draw an arrow").click()
    desk.drag((900, 300), (900, 600))
    desk.until("studio.collage.scene.options.force?.length === 1")
    assert desk.look("studio.collage.scene.options.force[0]").startswith("90deg strength=1.")
    assert desk.look("studio.choice.ids.size") == 0
    desk.page.get_by_label("Add a force").select_option("towards centre")
    desk.until("studio.collage.scene.options.force.length === 2")
    desk.settled()
    desk.picture("forces")
    buttons = desk.page.locator("#panel [aria-label^=Without]")
    for left in (1, 0):
        buttons.first.click()
        desk.until(f"(studio.collage.scene.options.force?.length ?? 0) === {left}")
        desk.until(f"document.querySelectorAll('#panel [aria-label^=Without]').length === {left}")
    assert desk.look("studio.stage.forces.arrows().length") == 0
    desk.settled()
