"""What each verb may be asked: the options of the recipe, of its own part and of what is written.

Everything follows from the fields of the models and their :class:`packwork.options.Offer`. What
stands here is which model is a verb's own, and where its choices are others than the recipe's.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache
from types import MappingProxyType
from typing import Any

from packwork.offers import Group, Offered, Verbs
from packwork.options import Options, offered
from packwork.piles import PileOptions
from packwork.readers.charts.options import ChartOptions
from packwork.readers.photos.options import PhotoOptions
from packwork.readers.words.options import WordOptions
from packwork.recipe import Recipe
from packwork.writers.film.options import FilmOptions
from packwork.writers.options import DrawingOptions


@dataclass(frozen=True, kw_only=True)
class Verb:
    """A verb of the command line and of Python.

    Parameters
    ----------
    part
        Options that it alone has; None for none.
    defaults
        Its choices where nobody says anything and the recipe's would be others.
    typed_defaults
        The same on a command line only: in Python the run chooses.
    """

    part: type[Options] | None = None
    defaults: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))
    typed_defaults: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))


VERBS: Mapping[Verbs, Verb] = MappingProxyType(
    {
        Verbs.FILL: Verb(),
        # Proportions of weights are kept, and words stand far enough apart to be read one by
        # one; less fills more. Chosen by eye.
        Verbs.WORDS: Verb(
            part=WordOptions,
            defaults={"sizes": "shared", "rotate": "horizontal", "padding": "0.3%"},
        ),
        # Photos lie as if strewn on a table, and none is upside down.
        Verbs.PHOTOS: Verb(part=PhotoOptions, defaults={"rotate": "15"}),
        # Sizes say numbers, marks stand upright and just apart. Chosen by eye.
        Verbs.CHART: Verb(
            part=ChartOptions,
            defaults={"sizes": "shared", "rotate": "none", "padding": "0.2%"},
            typed_defaults={"start": "distance-field"},
        ),
        Verbs.PILE: Verb(part=PileOptions, typed_defaults={"start": "distance-field"}),
    }
)
"""By the name that each has among :class:`packwork.options.Verbs`."""

WRITTEN: tuple[type[Options], ...] = (DrawingOptions, FilmOptions)
"""Options of what is written, whatever was asked to be run."""


@cache
def options_of(verb: Verbs) -> tuple[Offered, ...]:
    """All options of a verb in the order in which faces list them, group by group.

    Its own come first in a group. Where its part has one of the recipe's name, as words have a
    count of their own, the recipe's is what is offered.

    Examples
    --------
    >>> [option.name for option in options_of(Verbs.PILE)][:8]
    ['pixels', 'dpi', 'background', 'halo', 'show_container', 'flatten', 'cut', 'kiss_cut']
    >>> [o.name for o in options_of(Verbs.WORDS) if o.offer.group is Group.PLACED][:3]
    ['count', 'min_count', 'language']
    """
    written = [option for model in WRITTEN for option in offered(model) if verb in option.verbs]
    return in_groups((*run_options(verb), *written))


@cache
def run_options(verb: Verbs) -> tuple[Offered, ...]:
    """Those of :func:`options_of` that are about the run: a recipe holds them."""
    part = VERBS[verb].part
    own = {option.name: option for option in (offered(part) if part else ())}
    common = {option.name: option for option in offered(Recipe) if verb in option.verbs}
    return in_groups({**own, **common}.values())


def in_groups(options: Iterable[Offered]) -> tuple[Offered, ...]:
    """The same options, group by group; those of no group come first."""
    groups = [None, *Group]
    return tuple(sorted(options, key=lambda option: groups.index(option.offer.group)))


def with_defaults(verb: Verbs, options: Mapping[str, Any]) -> dict[str, Any]:
    """Options that are given, which None is not, and the verb's own choices for the rest.

    Examples
    --------
    >>> with_defaults(Verbs.WORDS, {"padding": "1mm", "seed": None})
    {'sizes': 'shared', 'rotate': 'horizontal', 'padding': '1mm'}
    """
    given = {key: value for key, value in options.items() if value is not None}
    return {**VERBS[verb].defaults, **given}


def default_of(verb: Verbs, option: Offered) -> Any:
    """What counts for a verb where nobody says anything.

    Examples
    --------
    >>> (padding,) = (o for o in options_of(Verbs.WORDS) if o.name == "padding")
    >>> default_of(Verbs.WORDS, padding), default_of(Verbs.FILL, padding)
    ('0.3%', '0')
    """
    return VERBS[verb].defaults.get(option.name, option.default)
