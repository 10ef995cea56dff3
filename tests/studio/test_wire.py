"""Messages: one schema for both ends, and whatever else is refused in one line."""

from __future__ import annotations

import json
import random
import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from packwork import studio
from packwork.studio import messages

STATIC = Path(studio.__file__).parent / "static"
TOOLS = Path(__file__).resolve().parents[2] / "tools"

GOOD = [
    {"type": "ack", "frame": 3},
    {"type": "leap", "n": 1, "to": "undo"},
    {"type": "order", "way": "outwards", "by": "hue"},
    {"type": "alike", "source": "auto"},
    {"type": "picture", "source": "file:0123456789abcdef"},
    {"type": "do", "n": 1, "command": {"kind": "move", "item": 0, "x": 1.0, "y": 2.0}},
    {"type": "do", "n": 2, "command": {"kind": "grab", "items": [0, 1]}},
    {"type": "count", "count": 12},
    {"type": "bring", "sources": ["builtin:star"]},
    {"type": "set", "options": {"padding": "1mm"}},
]
BAD = [
    "", "null", "[]", "{}", "7", '{"type": "ack"}', '{"type": "ack", "frame": -1}',
    '{"type": "ack", "frame": 1, "more": 2}', '{"type": "leap", "n": 1, "to": "over"}',
    "\0", "[" * 90_000, '{"type": "order", "way": "outwards", "by": "/etc/ages.csv"}',
    '{"type": "do", "n": 1, "command": {"kind": "move", "item": 0, "x": NaN, "y": 1}}',
    '{"type": "do", "n": 1, "command": {"kind": "format_disk"}}',
    '{"type": "do", "n": 1, "command": {"kind": "together", "commands": []}}',
    '{"type": "count", "count": 1e99}', '{"type": "pour", "seed": -1}', " " * 2_000_000,
]  # fmt: skip


@pytest.mark.parametrize("message", GOOD)
def test_what_a_page_says_is_read(message: dict[str, object]) -> None:
    assert messages.read(json.dumps(message)).type == message["type"]


@pytest.mark.parametrize("text", BAD, ids=range(len(BAD)))
def test_what_means_nothing_is_refused_in_one_line(text: str) -> None:
    with pytest.raises(messages.UnreadableError) as refused:
        messages.read(text)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 300


@given(st.text() | st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.sampled_from(
        ["type", "n", "command", "kind", "items", "item", "x", "frame", "commands"]), inner),
).map(json.dumps))  # fmt: skip
def test_any_text_is_a_message_or_refused(text: str) -> None:
    try:
        messages.read(text)
    except messages.UnreadableError as error:
        text = str(error)
        if "\n" in text:
            raise


def test_ten_thousand_messages_gone_wrong_are_each_read_or_refused() -> None:
    chance = random.Random(7)
    texts = [json.dumps(message) for message in GOOD]
    refused = 0
    for _ in range(10_000):
        text = list(chance.choice(texts))
        for _ in range(chance.randint(1, 4)):
            text[chance.randrange(len(text))] = chr(
                chance.choice([0, 34, 44, 57, 91, 123, 125, 960])
            )
        try:
            messages.read("".join(text))
        except messages.UnreadableError:
            refused += 1
    assert refused > 5_000


def test_the_page_knows_the_very_messages(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(TOOLS))
    from write_wire import page_types

    text = (STATIC / "wire.js").read_text(encoding="utf-8")
    assert text == page_types(messages.schema()), "run tools/write_wire.py"


def test_all_that_the_page_sends_is_in_the_schema() -> None:
    types = {part["properties"]["type"]["const"] for part in _parts("told")}
    for path in STATIC.glob("*.js"):
        for sent in re.findall(r'send\(\{ type: "(\w+)"', path.read_text(encoding="utf-8")):
            assert sent in types, path.name


def _parts(side: str) -> list[dict[str, dict[str, dict[str, str]]]]:
    schema = messages.schema()[side]
    return [
        schema["$defs"][name.rpartition("/")[2]]
        for name in schema["discriminator"]["mapping"].values()
    ]
