"""A secret that is never sent: the studio proves itself to pages, and pages to the next studio."""

from __future__ import annotations

import http.server
import os
import re
import threading
import urllib.error
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from packwork.live.face.opening import Opening
from packwork.studio import serving
from packwork.studio.kept_workspaces import KeptWorkspace
from packwork.studio.proof import Secret, mac
from studio.browsing import WIDE, Desk, Server, in_browser

HERE, THERE = "127.0.0.1:8123", "127.0.0.1:8124"


def test_each_start_has_its_own_secret_token_key_and_nonce() -> None:
    found = [Secret(HERE) for _ in range(20)]
    for name in ("text", "token", "key", "nonce"):
        assert len({getattr(one, name) for one in found}) == 20
    one = found[0]
    assert len({one.text, one.token, one.key, one.nonce}) == 4


def test_proofs_are_for_one_place_and_one_question() -> None:
    here, there = Secret(HERE, "known"), Secret(THERE, "known")
    assert here.proofs("1")["now"] == mac(here.key, f"studio {HERE} 1")
    assert here.proofs("1")["now"] not in there.proofs("1").values()
    assert here.proofs("1")["now"] not in here.proofs("2").values()
    assert here.key not in here.proofs("1").values()
    assert here.token not in here.proofs("1").values()


def test_a_page_of_the_studio_before_is_known_by_its_signature_alone() -> None:
    first = Secret(HERE)
    second = Secret(HERE, key_before=first.key)
    signed = mac(first.key, f"page {HERE} {second.nonce}")
    assert second.is_page_before(signed)
    for other in ("", "é", first.key, first.token, mac(first.key, f"page {THERE} {second.nonce}"),
                  mac("", f"page {HERE} {second.nonce}")):  # fmt: skip
        assert not second.is_page_before(other)
    assert not Secret(HERE).is_page_before(mac("", f"page {HERE} {Secret(HERE).nonce}"))
    assert not second.is_token(first.token)


def test_only_where_there_is_no_encryption_the_text_is_a_token() -> None:
    for is_plain in (False, True):
        secret = Secret(HERE, is_plain=is_plain)
        assert secret.is_token(secret.text) is is_plain
        assert secret.is_token(secret.token)
        assert not secret.is_token("")


def test_the_browser_is_given_a_private_file_and_no_secret(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []
    pages: list[tuple[str, int]] = []
    told: list[str] = []

    def open_(address: str) -> bool:
        opened.append(address)
        file = Path(address.removeprefix("file://"))
        pages.append((file.read_text(encoding="utf-8"), file.stat().st_mode))
        pages.append(("", file.parent.stat().st_mode))
        return True

    class Idle:
        def __init__(self, config: Any) -> None:
            pass

        def run(self, sockets: Any) -> None:
            sockets[0].close()

    monkeypatch.setattr(serving.webbrowser, "open", open_)
    monkeypatch.setattr(serving.uvicorn, "Server", Idle)
    kept = KeptWorkspace(tmp_path / "a.packwork", tmp_path / "a.json")
    serving.serve(Opening(), serving.Address(), kept, browses=True, tell=told.append)
    found = re.search(r"http://(\S+)/#(\S+)", told[0])
    assert found is not None
    secret = Secret(found[1], found[2])
    for known in (secret.text, secret.token):
        assert known not in opened[0]
        assert known not in kept.place.read_text(encoding="utf-8")  # type: ignore[union-attr]
    assert opened[0].startswith("file://")
    assert f"url={found[0]}" in pages[0][0]
    if os.name == "posix":
        assert not any(mode & 0o077 for _, mode in pages)
    assert kept.address[1] == secret.key


class _Impostor(http.server.BaseHTTPRequestHandler):
    heard: list[str]

    def do_GET(self) -> None:
        self.heard.append(f"{self.requestline}\n{self.headers}")
        body = b'{"nonce": "1", "now": "2", "before": "3"}'
        self.send_response(200)
        self.send_header("content-length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def do_POST(self) -> None:
        self.do_GET()

    def log_message(self, *_: Any) -> None:
        pass


@contextmanager
def impostor(port: int) -> Iterator[list[str]]:
    """Another program at a port: what it hears."""
    kind = type("Here", (_Impostor,), {"heard": []})
    with http.server.ThreadingHTTPServer(("127.0.0.1", port), kind) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield kind.heard  # type: ignore[attr-defined]
        finally:
            server.shutdown()
            thread.join()


@pytest.fixture
def own_desks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Desks in a folder of their own."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))


def answered(host: str, token: str) -> int:
    """Status of a request with a token."""
    told = {"x-packwork-token": token}
    asked = urllib.request.Request(f"http://{host}/choices", headers=told)
    try:
        with urllib.request.urlopen(asked, timeout=20) as answer:  # noqa: S310 - our own studio
            return int(answer.status)
    except urllib.error.HTTPError as refused:
        return refused.code


class TestInABrowser:
    pytestmark = in_browser

    def test_a_page_tells_another_program_at_its_port_nothing(
        self, browser: Any, own_desks: None
    ) -> None:
        first, second = Server("circle", "star", "-n", "5").start(), Server("--again")
        context = browser.new_context(viewport=WIDE)
        try:
            desk = Desk(context.new_page(), first.address)
            desk.settled()
            desk.until("studio.collage.state.saved")
            host, text = re.findall(r"http://(.*)/#(.*)", first.address)[0]
            secret = Secret(host, text)
            first.kill()
            with impostor(int(first.port)) as heard:
                desk.until("!studio.connection.isOpen")
                for _ in range(3):
                    desk.page.evaluate("() => studio.connection.hurry()")
                    desk.page.wait_for_timeout(400)
                refused = "studio.connection.ask('/choices').then(() => '', (e) => e.message)"
                assert desk.look(refused) == "the studio does not answer"
                assert desk.look("studio.connection.token") == ""
            assert any("/proof/" in one for one in heard)
            assert not any("/socket" in one or "/again" in one for one in heard)
            # The token of a request that was on its way may be: it died with its studio.
            for known in (secret.text, secret.key):
                assert not any(known in one for one in heard)
            second.start()
            assert second.port == first.port
            own = Secret(*re.findall(r"http://(.*)/#(.*)", second.address)[0])
            assert answered(host, own.token) == 200
            assert answered(host, secret.token) == 403
            desk.until("studio.connection.isOpen")
            desk.settled()
            assert desk.look("location.href") == second.address
        finally:
            first.stop()
            second.stop()
            context.close()

    def test_the_private_file_leads_to_the_studio(
        self, browser: Any, server: Server, tmp_path: Path
    ) -> None:
        file = serving._leading_to(server.address, tmp_path)
        context = browser.new_context(viewport=WIDE)
        page = context.new_page()
        page.goto(file.as_uri())
        page.wait_for_url(server.address)
        page.wait_for_function("() => globalThis.studio?.connection.isOpen")
        context.close()
