"""Options of each verb: those of the recipe, of its own part, of drawings and of films.

All follow from the models' fields and their :class:`packwork.options.Offer`. What stands here is
which model belongs to one verb alone, and which defaults of a verb differ from the recipe's.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache
from types import MappingProxyType
from typing import Any

from packwork.options import Group, Offered, Options, Verbs, offered
from packwork.readers.charts import ChartOptions
from packwork.readers.photo_options import PhotoOptions
from packwork.readers.words.options import WordOptions
from packwork.recipe import Recipe
from packwork.recipe.piles import PileOptions
from packwork.recipe.refusals import validated
from packwork.writers.film.options import FilmOptions
from packwork.writers.options import DrawingOptions


@dataclass(frozen=True, kw_only=True)
class Verb:
    """A verb of the command line and of Python.

    Parameters
    ----------
    part
        Options that only this verb has; None if it has none.
    common
        Names of options that its help shows at first, beside :data:`COMMON`.
    """

    part: type[Options] | None = None
    common: tuple[str, ...] = ()
    defaults: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))


COMMON = (
    "quiet", "output", "pixels", "background", "save_recipe", "count", "canvas", "rotate",
    "padding", "arrange", "palette", "picture", "target_coverage", "seed", "effort", "best_of",
    "film",
)  # fmt: skip
"""Names of options that the help of every verb shows at first, where the verb has them."""

VERBS: Mapping[Verbs, Verb] = MappingProxyType(
    {
        Verbs.FILL: Verb(common=("sizes", "force", "weights")),
        # Proportions of weights are kept.
        Verbs.WORDS: Verb(
            part=WordOptions,
            common=("fonts", "color_by", "language"),
            defaults={"sizes": "auto", "rotate": "horizontal"},
        ),
        # Photos lie as if strewn on a table, and none is upside down.
        Verbs.PHOTOS: Verb(
            part=PhotoOptions,
            common=("shape", "border", "edge", "dpi"),
            defaults={"rotate": "15"},
        ),
        # Sizes say numbers, and marks stand upright.
        Verbs.CHART: Verb(
            part=ChartOptions,
            common=("size_by", "color_by", "label_by", "mark", "unit", "by", "title"),
            defaults={"sizes": "shared", "rotate": "none"},
        ),
        Verbs.PILE: Verb(
            part=PileOptions,
            common=("open", "size", "emit", "compact", "force", "weights", "show_container"),
        ),
    }
)
"""All verbs, in the order of :class:`packwork.options.Verbs`."""

WRITTEN: tuple[type[Options], ...] = (DrawingOptions, FilmOptions)
"""Models of how results are drawn and filmed; all verbs share them."""


@cache
def options_of(verb: Verbs) -> tuple[Offered, ...]:
    """All options of a verb, by group, as help and forms list them.

    Within a group those of its own part come first. An option that the part and the recipe both
    have, such as the count of words, has the recipe's help and default.

    Examples
    --------
    >>> [option.name for option in options_of(Verbs.PILE)][:8]
    ['pixels', 'dpi', 'background', 'halo', 'show_container', 'flatten', 'cut', 'kiss_cut']
    >>> [o.name for o in options_of(Verbs.WORDS) if o.offer.group is Group.PLACED][:3]
    ['count', 'label_by', 'size_by']
    """
    written = [option for model in WRITTEN for option in offered(model) if verb in option.verbs]
    return in_groups((*run_options(verb), *written))


@cache
def run_options(verb: Verbs) -> tuple[Offered, ...]:
    """Options of :func:`options_of` that a recipe holds: all but drawings and films."""
    part = VERBS[verb].part
    own = {option.name: option for option in (offered(part) if part else ())}
    common = {option.name: option for option in offered(Recipe) if verb in option.verbs}
    return in_groups({**own, **common}.values())


def in_groups(options: Iterable[Offered]) -> tuple[Offered, ...]:
    """The options sorted by group, otherwise in the order given; those without a group first."""
    groups = [None, *Group]
    return tuple(sorted(options, key=lambda option: groups.index(option.offer.group)))


def named(name: str | None) -> Verbs | None:
    """The verb of a command; of ``run``, which has the options of ``fill``, that one.

    Examples
    --------
    >>> named("words"), named("run"), named("measure")
    (<Verbs.WORDS: 2>, <Verbs.FILL: 1>, None)
    """
    known = {str(verb.name).lower(): verb for verb in VERBS}
    return known.get("fill" if name == "run" else str(name))


def with_defaults(verb: Verbs, options: Mapping[str, Any]) -> dict[str, Any]:
    """The options that are not None, over the verb's own defaults.

    Examples
    --------
    >>> with_defaults(Verbs.WORDS, {"padding": "1mm", "seed": None})
    {'sizes': 'auto', 'rotate': 'horizontal', 'padding': '1mm'}
    """
    given = {key: value for key, value in options.items() if value is not None}
    return {**VERBS[verb].defaults, **given}


def default_of(verb: Verbs, option: Offered) -> Any:
    """Default of an option for a verb, in Python and on command lines.

    Examples
    --------
    >>> (sizes,) = (o for o in options_of(Verbs.WORDS) if o.name == "sizes")
    >>> default_of(Verbs.WORDS, sizes), default_of(Verbs.FILL, sizes)
    ('auto', 'free')
    """
    return VERBS[verb].defaults.get(option.name, option.default)


def film_options(recipes: FilmOptions | None = None, /, **given: Any) -> FilmOptions:
    """Options of a film: those given, then the recipe's, then the defaults.

    Parameters
    ----------
    recipes
        What the recipe says; None if nothing.
    given
        Options by name; None is as good as not given.

    Examples
    --------
    >>> film_options(FilmOptions(fps=12, hold=3), fps=60, hold=None)
    FilmOptions(fps=60.0, seconds=5.0, hold=3.0, loop='again', easing='smooth',
                film_ratio='canvas', film_pixels=800)
    >>> film_options(film_pixels=0)
    Traceback (most recent call last):
        ...
    packwork.errors.RecipeError: film_pixels: must be at least 16, not 0
    """
    known = {} if recipes is None else recipes.model_dump(exclude_unset=True)
    said = {key: value for key, value in given.items() if value is not None}
    return validated(FilmOptions, known | said)
