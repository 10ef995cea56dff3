"""Words on lines on the desk: a badge, its table, other texts round it, a drag that is refused."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import packwork as pw
from studio.browsing import Desk, Server, in_browser

pytestmark = in_browser

TABLE = {"apple": 9, "cider": 7, "press": 5, "barrel": 4, "bloom": 3, "pear": 3, "oak": 2}


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    file: Path = tmp_path_factory.mktemp("badge") / "badge.packwork"
    pw.words("circle", TABLE, ring=("OLD ORCHARD", "HEREFORD"), effort="draft").save(file)
    made = Server(str(file)).start()
    yield made
    made.stop()


def test_a_badge_is_set_anew_after_each_change_and_no_word_is_dragged(
    open_desk: Callable[..., Desk],
) -> None:
    desk = open_desk()
    desk.picture("badge")
    before = desk.rested()
    page, word = desk.page, desk.look("studio.words.list.things[0].id")
    desk.drag(desk.place(word), (700, 700))
    page.get_by_text("Words on lines lie where these have room").wait_for()
    assert desk.rested() == before
    page.keyboard.press("3")
    assert page.get_by_label("Round the top of the container").input_value() == "OLD ORCHARD"
    listed = "studio.words.list.things.map(one => [one.name, one.count])"
    assert dict(desk.look(listed)) == TABLE
    page.get_by_label("How often: oak").fill("14")
    page.get_by_label("How often: oak").press("Enter")
    desk.until("studio.words.list.things[0].name === 'oak'")
    desk.settled()
    page.get_by_label("Round the bottom of the container").fill("SINCE 1890")
    page.get_by_label("Round the bottom of the container").press("Enter")
    desk.until("studio.collage.items.some(one => one.name === 'SINCE 1890')")
    desk.settled()
    assert desk.look("studio.collage.scene.ring") == ["OLD ORCHARD", "SINCE 1890"]
    desk.picture("badge-changed")
    page.get_by_label("Words lie").select_option("edge")
    desk.until("studio.collage.scene.along === 'edge'")
    desk.settled()
    desk.look("studio.connection.leap('undo')")
    desk.until("studio.collage.scene.along === null")
    desk.settled()
    # What is taken away is left out as by the table, and a text of the edge is taken off it.
    chosen = "studio.collage.items.filter(one => ['SINCE 1890', 'pear'].includes(one.name))"
    desk.look(f"studio.choice.set({chosen}.map(one => one.id)) ?? studio.remove()")
    desk.until(f"studio.collage.scene.ring.length === 1 && !{chosen}.length")
    desk.settled()
    assert desk.look("Object.keys(studio.collage.scene.left_out)") == ["pear"]
    desk.undo_all()
    assert desk.rested() == before
