"""Options of films."""

from __future__ import annotations

import re
from typing import Annotated, Literal, Self, TypeAlias

from pydantic import AfterValidator, BeforeValidator, Field, model_validator

from packwork.errors import RecipeError
from packwork.options import Group, Offer, Options, Verbs

Easing: TypeAlias = Literal["smooth", "linear", "ease-in", "ease-out", "ease-in-out"]

Loop: TypeAlias = Literal["again", "back", "cycle", "once"]

CANVAS = "canvas"
"""Ratio of a film that shows the canvas."""

_RATIO = re.compile(r"(\d{1,3}):(\d{1,3})")
MAX_RATIO = 10.0
"""Longer side of a film by the shorter at most. Chosen."""

MIN_SIDE_PX, MAX_SIDE_PX = 16, 4_096
"""Longer side of a film: smaller shows nothing, larger no encoder at hand is tested with.
Chosen."""

MAX_FPS = 120.0
"""Pictures a second at most: no screen shows more. Chosen."""

MAX_SECONDS = 600.0
"""Longest film. Chosen."""

GLIDE = 0.5
"""Time in which items glide back, by that in which they came. Chosen by eye."""

MAX_FRAMES = 20_000
"""Pictures of one film at most: half an hour of encoding. Chosen."""


def _as_loop(value: object) -> object:
    """Word for true and false, as earlier recipes say it."""
    return {True: "again", False: "once"}.get(value, value) if isinstance(value, bool) else value


def _checked_ratio(text: str) -> str:
    if text != CANVAS:
        match = _RATIO.fullmatch(text)
        sides = sorted(map(int, match.groups())) if match else [0, 0]
        if not 0 < sides[1] <= MAX_RATIO * sides[0]:
            raise RecipeError("film_ratio", f"is width:height, such as 9:16, not {text[:20]!r}")
    return text


class FilmOptions(Options):
    """Options of films."""

    offers = Offer(group=Group.FILM, verbs=Verbs.EVERY)

    fps: Annotated[float, Field(ge=1, le=MAX_FPS, allow_inf_nan=False)] = 30.0
    """Pictures a second of a film. Any number: they are drawn between what was recorded."""

    seconds: Annotated[float, Field(gt=0, le=MAX_SECONDS, allow_inf_nan=False)] = 5.0
    """How long the items of a film move."""

    hold: Annotated[float, Field(ge=0, le=MAX_SECONDS, allow_inf_nan=False)] = 1.0
    """Seconds for which the last picture of a film stays after that."""

    loop: Annotated[Loop, BeforeValidator(_as_loop)] = "again"
    """again: at its end a film jumps to its beginning; back: items go back the way they came;
    cycle: they glide to where they began, in half the time; once: it stays. In MP4 and WebM the
    player decides whether it begins again."""

    easing: Easing = "smooth"
    """smooth: items of a film set off and stop softly; linear: straight from one recorded
    place to the next; ease-in, ease-out, ease-in-out: slow at the beginning, the end or both."""

    film_ratio: Annotated[str, AfterValidator(_checked_ratio)] = CANVAS
    """Width by height of a film, as 1:1, 4:5, 9:16 or 16:9, the layout in the middle; canvas: that,
    and what sticks out of it in the first picture or when all have arrived."""

    film_pixels: Annotated[int, Field(ge=MIN_SIDE_PX, le=MAX_SIDE_PX)] = 800
    """Longer side of a film; MP4 and WebM need an even one."""

    @model_validator(mode="after")
    def _frames_can_be_drawn(self) -> Self:
        frames = self.frames + self.frames_back
        if frames > MAX_FRAMES:
            raise RecipeError(
                "seconds",
                f"{self.seconds:g} at {self.fps:g} pictures a second are {frames}; "
                f"a film may have {MAX_FRAMES}",
            )
        return self

    @property
    def frames(self) -> int:
        """Pictures in which the items move, the first and the last among them."""
        return max(round(self.seconds * self.fps), 2)

    @property
    def frames_back(self) -> int:
        """Pictures after the arrival, in which the items go back to where they began."""
        share = {"back": 1.0, "cycle": GLIDE}.get(self.loop)
        return 0 if share is None else max(round(share * self.frames) - 2, 1)

    @property
    def ratio(self) -> float | None:
        """Width by height; None for the canvas's own."""
        if self.film_ratio == CANVAS:
            return None
        width, height = map(int, self.film_ratio.split(":"))
        return width / height
