"""Options of films."""

from __future__ import annotations

from typing import Annotated, Literal, Self, TypeAlias

from pydantic import Field, model_validator

from packwork.errors import RecipeError
from packwork.offers import Group, Offer, Verbs
from packwork.options import Options

Easing: TypeAlias = Literal["smooth", "linear"]

MIN_SIDE_PX, MAX_SIDE_PX = 16, 4_096
"""Longer side of a film: smaller shows nothing, larger no encoder at hand is tested with.
Chosen."""

MAX_FPS = 120.0
"""Pictures a second at most: no screen shows more. Chosen."""

MAX_SECONDS = 600.0
"""Longest film. Chosen."""

MAX_FRAMES = 20_000
"""Pictures of one film at most: half an hour of encoding. Chosen."""


class FilmOptions(Options):
    """Options of films."""

    offers = Offer(group=Group.FILM, verbs=Verbs.EVERY)

    fps: Annotated[float, Field(ge=1, le=MAX_FPS, allow_inf_nan=False)] = 30.0
    """Pictures a second of a film. Any number: they are drawn between what was recorded."""

    seconds: Annotated[float, Field(gt=0, le=MAX_SECONDS, allow_inf_nan=False)] = 5.0
    """How long the items of a film move."""

    hold: Annotated[float, Field(ge=0, le=MAX_SECONDS, allow_inf_nan=False)] = 1.0
    """Seconds for which the layout stays after that."""

    loop: Annotated[bool, Offer(flags="--loop/--once")] = True
    """Whether a film begins again at its end; in MP4 and WebM the player decides."""

    back: Annotated[bool, Offer(flags="--back")] = False
    """A film goes back the way it came, so that it begins again without a jump."""

    easing: Easing = "smooth"
    """smooth: items of a film set off and stop softly; linear: straight from one recorded
    place to the next."""

    film_pixels: Annotated[int, Field(ge=MIN_SIDE_PX, le=MAX_SIDE_PX)] = 800
    """Longer side of a film; MP4 and WebM need an even one."""

    @model_validator(mode="after")
    def _frames_can_be_drawn(self) -> Self:
        if self.frames > MAX_FRAMES:
            raise RecipeError(
                "seconds",
                f"{self.seconds:g} at {self.fps:g} pictures a second are {self.frames}; "
                f"a film may have {MAX_FRAMES}",
            )
        return self

    @property
    def forth(self) -> int:
        """Pictures from the first places to the layout, both among them."""
        return max(round(self.seconds * self.fps), 2)

    @property
    def frames(self) -> int:
        """Pictures of the film, but for those for which the last one stays."""
        return 2 * self.forth - 2 + round(self.hold * self.fps) if self.back else self.forth

    @property
    def stays(self) -> float:
        """Seconds for which the last picture stays."""
        return 0.0 if self.back else self.hold

    @property
    def total(self) -> float:
        """Seconds of the whole film."""
        return self.frames / self.fps + self.stays
