"""Make the pictures of docs/guide/studio.md, in a Chromium that is there."""

from __future__ import annotations

import sys
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).parents[1]
sys.path.append(str(ROOT / "tests"))

FOLDER = ROOT / "docs" / "pictures" / "studio"
SIZE = {"width": 1440, "height": 900}


def main() -> None:
    """Open a desk, drag an item, try others, edit another container."""
    from studio.browsing import Desk, Server, chromium

    FOLDER.mkdir(exist_ok=True)
    server = Server("heart", "builtin:icons", "-n", "60").start()
    with chromium() as browser:
        desk = Desk(browser.new_page(viewport=SIZE), server.address)
        desk.settled()
        start = desk.place(12)
        desk.page.mouse.move(*start)
        desk.page.mouse.down()
        desk.page.mouse.move(900, 430, steps=30)
        desk.page.screenshot(path=str(FOLDER / "dragged.png"))
        desk.page.mouse.up()
        desk.page.locator("#tab-more").click()
        desk.page.get_by_text("Try six others").click()
        desk.until("studio.variants.found.length === 6")
        desk.settled()
        desk.page.screenshot(path=str(FOLDER / "more.png"))
        desk.page.locator("#tab-room").click()
        desk.page.locator(".grid [aria-label=fish]").click()
        desk.until("studio.collage.scene.name === 'fish'")
        desk.settled()
        desk.page.get_by_role("button", name="Edit its outline").click()
        desk.page.mouse.move(1400, 860)
        desk.page.wait_for_timeout(200)
        desk.page.screenshot(path=str(FOLDER / "container.png"))
    server.stop()
    for path in FOLDER.glob("*.png"):
        Image.open(path).convert("RGB").quantize(256).save(path, optimize=True)


if __name__ == "__main__":
    main()
