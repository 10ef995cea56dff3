"""Labels: where a link may lead, and what is too long."""

from __future__ import annotations

import pytest

from packwork.errors import RecipeError
from packwork.scene.item import MAX_LENGTH, Label

GOOD = [
    "", "https://example.org/a?b=1&c=2#d", "HTTP://example.org", "mailto:someone@example.org",
    "page.html", "../up/page.html#part", "#part", "?q=1", "//example.org/page", "ünïcode/päge",
]  # fmt: skip
BAD = [
    "javascript:alert(1)", "JavaScript:alert(1)", "java\tscript:alert(1)", "\x01javascript:a()",
    "javascript\n:alert(1)", "data:text/html,<b>", "vbscript:x", "file:///etc/passwd", "ftp://a",
    "a b", "http://[::1", "\\\\host\\share", "https://a\u2028b",
]  # fmt: skip


@pytest.mark.parametrize("link", GOOD)
def test_links_that_lead_somewhere_harmless(link: str) -> None:
    assert Label(link=link).link == link


@pytest.mark.parametrize("link", BAD)
def test_links_that_may_run_code_or_are_none(link: str) -> None:
    with pytest.raises(RecipeError, match=r"link: must begin with http:, https: or mailto:"):
        Label(link=link)


@pytest.mark.parametrize("key", ["name", "link", "title"])
def test_texts_have_an_end(key: str) -> None:
    assert Label(**{key: "x" * MAX_LENGTH})
    with pytest.raises(RecipeError, match=f"{key}: may have {MAX_LENGTH} characters"):
        Label(**{key: "x" * (MAX_LENGTH + 1)})
