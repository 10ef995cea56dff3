"""Findings of a run beside poses, and the sentences that are made of them, all of them here.

A step adds a finding: one of :class:`Sentence` and its values. Terminal, report, page and notebook
tell it in the same words.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum, auto


class Told(Enum):
    """Kind of a finding: a fault, advice, a remark, or part of another."""

    FAULT = auto()  # asked, and does not hold
    ADVICE = auto()  # poor, and what would do
    REMARK = auto()  # chosen by the run
    PART = auto()  # part of another sentence, or the reason or ending of something


class Sentence(Enum):
    """Sentences about results, with places for values."""

    BROKEN = Told.FAULT, "{fault}"
    SMALLER_THAN_PINNED = (
        Told.FAULT,
        "{item} (item {number}) came out at {size}, {asked} asked; "
        "{why}the container's widest place is {widest} across",
    )
    NO_PLACE = Told.PART, "it has no place at that size, turned as it may be; "
    SMALLER_THAN_RULED = (
        Told.FAULT,
        "{item} (item {number}) came out at {ratio:.2g} times the typical size, "
        "{least:g} asked at least",
    )
    DWARFS = (
        Told.FAULT,
        "{many} ({names}) came out up to {factor:.0f} times smaller than the typical item, "
        "--size-ratio {ratio:g} allows less; use fewer items",
    )
    SMALL = (
        Told.PART,
        "{many} smaller than --size-ratio {ratio:g} allows, {worst} by {percent:.0f} %",
    )
    SPECKS = Told.FAULT, "{many} too small to be seen ({names}: {width:.2g} {unit} wide); {remedy}"
    LESS_DIFFERENCE = (
        Told.PART,
        "weights that differ less, fewer items or --smallest for words would do",
    )
    WIDER_LINES = Told.PART, "the container is lines {width:.2g} {unit} wide; wider ones would do"
    COARSE = (
        Told.FAULT,
        "{many} fewer than the {least:g} pixels to the inch asked for, {photo} the fewest: "
        "{ppi:.0f}",
    )
    LARGER_THAN_HERO = Told.FAULT, "{names}: larger than {hero}, the hero; give it a larger size"
    PILE_FULL = Told.FAULT, "{placed} of {count} items fit into the container at their sizes"
    MARKS_LEFT = Told.FAULT, "{placed} of {count} marks have a place"

    POOR_SHAPE = Told.ADVICE, "{poor}; {remedy}"
    EMPTY_PARTS = Told.PART, "{empty} of the container's {parts} parts are empty"
    BARE = Told.PART, "{percent:.0f} % of the container lies far from any item"
    SHAPE = Told.PART, "the container's shape shows to {percent:.0f} % only"
    OTHER_CONTAINER = (
        Told.PART,
        "it is lines {width:.2g} {unit} wide; wider ones, or what they enclose, would show",
    )
    MORE_ITEMS = Told.PART, "-n {count} would show it"
    BARE_EDGE = (
        Told.ADVICE,
        "{percent:.0f} % of the container's edge lies bare; -n {count} would cover more of it",
    )
    CROPPED = Told.PART, "--edge crop, which cuts photos at its line, would show more of it"
    PLAINER = Told.PART, "a container of fewer and larger parts would show"
    FREE_SIZES = Told.PART, "--sizes free would show it"
    FREE_AND_MORE = Told.PART, "--sizes free -n {count} would show it"
    REPEATED = Told.PART, "--repeat auto, smaller copies in the voids, would show more of it"
    MORE_COPIES = Told.PART, "--max-items {count:.0f} would show more of it"
    SMALLER_COPIES = Told.PART, "--smallest 0.3%, smaller copies yet, would show more of it"
    MORE_OF_THEM = Told.PART, "-n {count} would show more of it"
    GRADED = Told.PART, "--sizes graded, whose proportions give way, would fill it"
    PICTURE_HIDDEN = (
        Told.ADVICE,
        "the picture shows to {percent:.0f} % only; {remedy} would show it",
    )
    RUN_TOGETHER = (
        Told.ADVICE,
        "neighbours have one colour and touch; --padding 0.5% or --palette would tell them apart",
    )
    SHOWS_REPEAT = (
        Told.ADVICE,
        "{item} is {percent:.0f} % of all that is drawn, {times:.1f} times the next, and shows "
        "where the tile repeats; {remedy} would hide it",
    )
    UNLIKE_LINES = (
        Told.ADVICE,
        "drawings have lines up to {times:.0f} times as wide as others; --stroke-width even makes "
        "them alike",
    )
    LOOSE_WEIGHTS = (
        Told.ADVICE,
        "for their weights some areas are {times:.1f} times as large as others, as sizes are free; "
        "--sizes shared holds the shares",
    )
    FEW_TILES = Told.ADVICE, "the picture is hard to recognise with {tiles}; {remedy} would do"

    SHOWN_TO = Told.REMARK, "{tiles} can show the picture to {percent:.0f} %{then}"
    COUNT = Told.REMARK, "auto chose {many}"
    TINTED = (
        Told.REMARK,
        "pictures of several colours are in the tints of one of the palette's: {names}; "
        'shades = "keep" in a recipe, or in Python, leaves them theirs',
    )
    ROWS = (
        Told.REMARK,
        "{many}, not {asked}: rows of equal squares fill this container with so many",
    )
    COUNT_BY_WIDTH = (
        Told.REMARK,
        "auto chose {many}, to reach into parts {width:.3g} {unit} wide",
    )
    STOPWORDS = (
        Told.REMARK,
        "{many} left out ({names}); --keep-words keeps those that it names, --language none all",
    )
    GIVES_WAY = (
        Told.REMARK,
        "{why}, so sizes of words give way; --sizes shared keeps proportions",
    )
    SET_AGAIN = (
        Told.REMARK,
        "{many} set again, until the line is full; {count} different ones would fill it{elsewhere}",
    )
    READ_LETTERS = (
        Told.REMARK,
        "{many} repeated, {total} in all, for the letters to be read; {option} sets each once",
    )
    THIN = Told.PART, "the container is thin"
    LEFT_BARE = Told.PART, "in proportion they would leave it bare"
    CLOSER = (
        Told.REMARK,
        "so many {what} stand {gap:.2g} {unit} apart, not {usual:g} {unit}; "
        "another --padding is kept",
    )
    APART = (
        Told.REMARK,
        "drawings stand {gap:.2g} {unit} apart, not to run together; --padding 0 lets them touch",
    )
    FULLEST_PART = (
        Told.REMARK,
        "{part} is the fullest: without it all marks could be {factor:.2g} times as wide",
    )
    HERO_LEADS = (
        Told.REMARK,
        "other words are smaller than their weights ask, so that {hero}, the hero, leads",
    )

    OVERLAPS = Told.PART, "overlaps {other} by {area:.3g} {unit}²"
    STICKS_OUT = Told.PART, "sticks out of the container by {area:.3g} {unit}²"
    TOO_NEAR = Told.PART, "is {gap:.3g} {unit} from {other}, nearer than asked"
    TOO_SMALL = (
        Told.PART,
        "is smaller than it may be: there was no room at its smallest size",
    )
    MOSTLY_OUTSIDE = Told.PART, "{percent:.0f} % of it is overlapped or outside the container"
    NO_ROOM = Told.PART, "there was no room left at its size"
    STOPPED = Told.PART, "the run was stopped before it found a place"
    UNREADABLE_WORD = (
        Told.PART,
        "finds no place at a size that could be read; use fewer words or a larger canvas",
    )
    LETTERS = (
        Told.PART,
        "its letters would be {size:.3g} {unit} high, less than the {least:.3g} {unit} of "
        "--smallest",
    )

    NOT_CLEAN = Told.PART, "the layout was not clean"
    COVERED = Told.PART, "{target:g} % are covered"
    MOST_ITEMS = Told.PART, "{count} items are the most that were asked for"
    FILLING_STOPPED = Told.PART, "the run was stopped"
    FILLING_TOO_LONG = (
        Told.PART,
        "more than {count} of such items take too long; {remedy} would do",
    )
    NO_VOID = Told.PART, "no void holds an item of {smallest:.3g} {unit}"
    NO_GAP = Told.PART, "no gap holds another one of {least:.3g} {unit}"
    MOST_REPEATS = Told.PART, "{most} are as many as there may be"

    CROWDED = (
        Told.FAULT,
        "the items' area is {times:.1f} times the container's; use {remedy}",
    )
    ROUGH = (
        Told.FAULT,
        "still rough: {double:.1f} % of the container is covered twice, {outside:.1f} % as much "
        "lies outside; {remedy}",
    )

    def __init__(self, told: Told, template: str) -> None:
        self.told, self.template = told, template

    def of(self, **values: object) -> str:
        """The sentence with its values."""
        return self.template.format(**values)


@dataclass(frozen=True)
class Finding:
    """Something that a step found, which is told."""

    sentence: Sentence
    values: Mapping[str, object] = field(default_factory=dict)

    def __str__(self) -> str:
        return self.sentence.of(**self.values)


def told_as(told: Told, findings: tuple[Finding, ...]) -> tuple[str, ...]:
    """Sentences of those findings that are told so, in their order."""
    return tuple(str(one) for one in findings if one.sentence.told is told)


@dataclass(frozen=True)
class Unplaced:
    """An item that found no place of its own, and why."""

    item: str
    index: int
    reason: str


@dataclass(frozen=True)
class Filling:
    """Report on filling the voids between items.

    Parameters
    ----------
    covered, target
        Shares of the container that are covered, and that were to be; None if as much as
        goes.
    """

    added: int
    ending: str
    covered: float
    target: float | None

    @property
    def is_short(self) -> bool:
        """Whether less is covered than was asked for."""
        return self.target is not None and self.covered < self.target


@dataclass(frozen=True)
class WordsFound:
    """Number of different words that a source holds, and of those that were to be set.

    Parameters
    ----------
    of_true
        Where sizes gave way, of each word its size as a share of its proportion to the heaviest.
    """

    found: int
    asked: int
    of_true: Mapping[str, float] = field(default_factory=dict)
