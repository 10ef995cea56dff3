"""Whatever a page asks for, of whatever types: an answer or a line, and no fault of the program."""

from __future__ import annotations

import asyncio
import itertools
import json
from collections.abc import Awaitable, Callable, Iterator, Mapping
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any, get_args
from urllib.parse import quote

import pytest

from packwork.live.commands.together import AnyCommand
from packwork.live.face.exporting import FILM_FORMATS, FORMATS
from packwork.live.face.opening import Opening
from packwork.recipe.verbs import FilmOptions
from packwork.studio import messages as requests
from packwork.studio.app import guarded
from packwork.studio.files import Importer, Uploads
from packwork.studio.guard import TOKEN_HEADER
from packwork.studio.proof import Secret
from packwork.studio.workspace import Workspace
from packwork.writers.options import DrawingOptions

HOST = "127.0.0.1:9"
TYPES: tuple[Any, ...] = (
    None, True, -1, 0, 1, 2**70, 1e300, "", "a", "\ud800", "é" * 300, [], [1], ["a"], {}, {"a": 1},
)  # fmt: skip
"""A value of each kind that JSON has, and some that no field takes."""

KEYS = ("recipes", "self", "given", "options", "layout", "kind", "é" * 300, "")
"""Names of parameters and of nothing."""


@dataclass(frozen=True)
class Answer:
    status: int
    body: bytes


Ask = Callable[[str, str, bytes, Mapping[str, str]], Awaitable[Answer]]


async def asked(
    app: Any, token: str, method: str, path: str, body: bytes, headers: Mapping[str, str]
) -> Answer:
    """What a studio answers, without a server between."""
    known = {
        "host": HOST, "origin": f"http://{HOST}", "sec-fetch-site": "same-origin",
        TOKEN_HEADER: token, **headers,
    }  # fmt: skip
    scope = {
        "type": "http", "method": method, "path": path, "raw_path": path.encode(),
        "query_string": b"", "root_path": "", "http_version": "1.1",
        "headers": [(k.encode(), v.encode("latin-1")) for k, v in known.items()],
    }  # fmt: skip
    sent: list[Any] = []
    parts = iter([{"type": "http.request", "body": body}])

    async def receive() -> Any:
        return next(parts, {"type": "http.disconnect"})

    async def send(message: Any) -> None:
        sent.append(message)

    await app(scope, receive, send)
    data = b"".join(message.get("body", b"") for message in sent)
    return Answer(sent[0]["status"], data)


def talk(opening: Opening, scenario: Callable[[Ask, Workspace, Uploads], Awaitable[None]]) -> None:
    """Have a scenario ask a studio that is open."""

    async def played() -> None:
        secret, uploads, desk = Secret(HOST), Uploads(), Workspace(opening)
        app = guarded(desk, uploads, secret)

        async def ask(method: str, path: str, body: bytes, headers: Mapping[str, str]) -> Answer:
            return await asked(app, secret.token, method, path, body, headers)

        await desk.begin()
        try:
            while desk.shown is None or desk.shown.state.moving:
                await asyncio.sleep(0.01)
            await scenario(ask, desk, uploads)
        finally:
            await asyncio.to_thread(desk.close)
            uploads.close()

    asyncio.run(played())


def is_line(answer: Answer) -> bool:
    text = answer.body.decode()
    return answer.status == 400 and text.endswith("\n") and text.count("\n") == 1


def exports() -> Iterator[Any]:
    """What no export may fail at."""
    yield from TYPES
    yield from ({"format": value} for value in TYPES)
    kinds = ["svg", "png", "geojson", "film.svg", "film.gif", "packwork", "recipe", "none"]
    yield from (
        {"format": kind, "options": value}
        for kind, value in itertools.product(kinds, TYPES)
        if value != {}
    )
    drawn = [*DrawingOptions.model_fields, *KEYS]
    filmed = ["background", "show_container", *FilmOptions.model_fields, *KEYS]
    for kind, names in (("geojson", drawn), ("film.json", filmed)):
        for name, value in itertools.product(names, TYPES):
            yield {"format": kind, "options": {name: value}}


def test_an_export_is_made_or_refused_in_a_line(opening: Opening) -> None:
    async def scenario(ask: Ask, desk: Workspace, uploads: Uploads) -> None:
        for what in exports():
            answer = await ask("POST", "/export", json.dumps(what).encode(), {})
            assert answer.status == 200 or is_line(answer), (what, answer)
        unknown = {"format": "film.gif", "options": {"recipes": 1}}
        answer = await ask("POST", "/export", json.dumps(unknown).encode(), {})
        assert is_line(answer)
        assert b"recipes: no such option" in answer.body
        for body in (b"", b"\xff", b"{", b"[" * 9_000, b"1" * 9_000, b"9" * 20_000):
            assert is_line(await ask("POST", "/export", body, {}))

    assert FORMATS
    assert FILM_FORMATS
    talk(opening, scenario)


def test_a_refusal_names_no_folder_of_what_was_sent(opening: Opening) -> None:
    async def scenario(ask: Ask, desk: Workspace, uploads: Uploads) -> None:
        batch = uploads.new_batch()
        uploads.add(batch, "wrong.png", b"no picture")
        asked = {"format": "pdf", "options": {"icc": f"file:{batch}"}}
        answer = await ask("POST", "/export", json.dumps(asked).encode(), {})
        assert answer.body.startswith(b"wrong.png: ")
        told: asyncio.Queue[Any] = asyncio.Queue()
        desk.listen(told, lambda news: news and told.put_nowait(news.text))
        tab: Any = SimpleNamespace(workspace=desk, importer=Importer(desk, uploads))
        for purpose in ("mosaic", "behind", "colours"):
            requests.Picture(source=f"file:{batch}", purpose=purpose).act(tab)
            assert (await asyncio.wait_for(told.get(), 60)).startswith("wrong.png: ")

    talk(opening, scenario)


@pytest.mark.parametrize(
    "name",
    [
        "é" * 100 + ".svg", "字" * 120 + ".svg", "\U0001d4b3" * 120, "a" * 5_000, "." * 300, "\0",
        "a\ud800b.svg", "CON", "con.svg", "é" * 8 + ".ééééééé", "a/b\\c", "", " ", "\n\r.svg",
    ],
)  # fmt: skip
def test_a_file_of_any_name_is_kept(opening: Opening, name: str) -> None:
    async def scenario(ask: Ask, desk: Workspace, uploads: Uploads) -> None:
        batch = json.loads((await ask("POST", "/files", b"", {})).body)["batch"]
        header = {"x-name": quote(name, errors="surrogatepass")}
        for _ in range(3):
            answer = await ask("POST", f"/files/{batch}", b"<svg/>", header)
            assert answer.status == 200, answer
        kept = list(uploads.folder(batch).iterdir())
        assert len(kept) == 3
        assert all(one.read_bytes() == b"<svg/>" for one in kept)

    talk(opening, scenario)


@pytest.mark.parametrize("batch", ["0" * 16, "..", "%2e%2e", "é", "a" * 5_000, "0" * 16 + "\n"])
def test_a_batch_that_is_none_is_refused_in_a_line(opening: Opening, batch: str) -> None:
    async def scenario(ask: Ask, desk: Workspace, uploads: Uploads) -> None:
        answer = await ask("POST", f"/files/{batch}", b"", {"x-name": "a.svg"})
        assert is_line(answer), answer
        raw = await ask("POST", f"/files/{batch}", b"", {"x-name": "\xff%ff%"})
        assert is_line(raw), raw

    talk(opening, scenario)


def messages() -> Iterator[dict[str, Any]]:
    """Each message and each command with each field of each type, alone and beside what is good."""
    fits = {
        "n": 1, "item": 0, "items": [0], "other": 1, "x": 300.0, "y": 300.0, "name": "a",
        "source": "builtin:star", "sources": ["builtin:star"], "angle": 0.1, "weight": 1.0,
        "words": [["a", 1.0]], "use": "items", "way": "right", "by": "hue", "seed": 1, "count": 12,
        "frame": 1, "options": {"padding": 1}, "factor": 1.1, "share": 0.2, "colour": "red",
        "asset": "none", "property": "place", "to": "undo",
    }  # fmt: skip
    models = [*_members(requests.Told), *_members(AnyCommand)]
    for model in models:
        fields = model.model_fields
        key = "type" if "type" in fields else "kind"
        (kind,) = get_args(fields[key].annotation)
        whole = {key: kind} | {name: fits[name] for name in fields if name in fits}
        for name, value in itertools.product([*fields, "more"], TYPES):
            said = {**whole, name: value}
            yield said if key == "type" else {"type": "do", "n": 1, "command": said}
    for name, value in itertools.product(["padding", "sizes", "rotate", "force", *KEYS], TYPES):
        yield {"type": "set", "options": {name: value}}


def _members(union: Any) -> list[Any]:
    """Models of a union, and of the unions in it."""
    if isinstance(union, type):
        return [union]
    inner = get_args(union)[:1] if hasattr(union, "__metadata__") else get_args(union)
    return [member for one in inner for member in _members(one)]


SLOW = {"pour", "more", "order", "alike", "fill", "count", "room", "bring"}
"""What is a run of its own once it is understood; here only what is refused is asked."""


def test_a_message_of_any_types_is_done_or_refused_in_a_line(play: Any) -> None:
    async def scenario(desk: Workspace, open_page: Callable[[], Any]) -> None:
        page, told = open_page(), []
        await page.until(lambda: page.is_certified)
        assert desk.owner is not None
        desk.listen("told", lambda line: told.append(line) if line is not None else None)
        for message in messages():
            text = json.dumps(message)
            try:
                is_slow = requests.read(text).type in SLOW
            except requests.UnreadableError:
                continue
            if not is_slow:
                page.tab.receive(text)
                await asyncio.wrap_future(desk.owner.call(lambda session: None))
        page.tell(type="picture", source="nothing")
        await page.until(lambda: any("drop them again" in line.text for line in told))
        assert len(told) > 100
        assert not [line.text for line in told if "fault" in line.text or "\n" in line.text]

    play(scenario)
