"""Regular expressions of strangers: what they find, and an end to those that have none."""

from __future__ import annotations

import re

import pytest

from packwork.errors import RecipeError
from packwork.readers.words.options import WordOptions
from packwork.readers.words.source import read_words
from packwork.readers.words.tokens import found_in
from packwork.wordcloud.tokenization import tokens

ENDLESS = "(a+)+$"
LONG = "a" * 60 + "!"


@pytest.mark.parametrize("pattern", [r"\w+", r"#\w+", r"(\w)\w", r"(\w)(\w)", "", "ü."])
def test_matches_are_those_of_the_same_process(pattern: str) -> None:
    texts = ["The bear's #honey", "", "für Bären \U0001f600", "\ud800 lone"]
    known = re.compile(pattern)
    assert found_in(pattern, texts) == [[m.group() for m in known.finditer(t)] for t in texts]
    groups = [[list(m) if isinstance(m, tuple) else m for m in known.findall(t)] for t in texts]
    assert found_in(pattern, texts, groups=True) == groups


def test_a_pattern_that_does_not_end_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("packwork.readers.words.tokens.MOST_SECONDS", 0.5)
    with pytest.raises(RecipeError, match=r"regexp: takes more than 0\.5 s on this text"):
        read_words(WordOptions(source=f"bears {LONG}", regexp=ENDLESS))
    with pytest.raises(RecipeError, match="takes more than"):
        tokens(LONG, ENDLESS, include_numbers=True, min_word_length=0)


def test_the_drop_in_finds_what_the_other_package_finds() -> None:
    assert tokens("The #bear's", r"#?\w+", include_numbers=True, min_word_length=0) == [
        "The", "#bear", "s",
    ]  # fmt: skip


def test_a_program_that_holds_python_in_it_matches_by_itself(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("packwork.readers.words.tokens.sys.executable", "")
    assert found_in("b.", ["abc"]) == [["bc"]]
    assert found_in("(b)(.)", ["abc"], groups=True) == [[("b", "c")]]
