"""Synonyms that people type for options and commands that go by other names here.

Spelling finds ``cuont``; only meaning finds ``gap``. Names of other programs are among them.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping

_TYPED: Mapping[str, str] = {
    "padding": "gap gaps margin spacing space distance buffer clearance gutter separation",
    "palette": "color colors colour colours color_scheme scheme theme colormap cmap fill_color",
    "count": "n number num amount copies quantity repeat limit max_words n_items items_count total",
    "sizes=shared": "equal equal_size equal_sizes same_size same_sizes uniform proportional",
    "sizes": "size_mode sizing scaling",
    "size_ratio": "variation size_range size_variation spread",
    "rotate": "angle angles rotation rotations turn orientation prefer_horizontal tilt",
    "canvas": "width height dimensions page paper paper_size sheet format size",
    "pixels": "resolution px image_size output_size scale",
    "dpi": "ppi density",
    "output": "out outfile output_file save save_as file to svg png pdf export imagefile",
    "background": "bg bgcolor background_color background_colour back",
    "seed": "random random_state random_seed rng",
    "target_coverage": "coverage fill_ratio fullness occupancy fill_rate",
    "smallest": "min_size minimum min_font_size min_scale smallest_size",
    "largest": "max_size maximum max_font_size largest_size",
    "filler": "fillers gap_filler fill_gaps fill_with",
    "epochs": "iterations iteration iter steps max_iter rounds",
    "effort": "quality speed accuracy precision fast slow",
    "time": "timeout duration max_time time_limit",
    "font": "fonts font_family font_path fontfile typeface",
    "quiet": "silent no_progress",
    "no_clobber": "no_overwrite keep_files overwrite",
    "film": "video animate animation movie gif mp4 record",
    "show_container": "contour contour_width contour_color border frame show_mask",
    "weights": "weight values importance sizes_file relative",
    "hero": "focus main feature highlight centre center featured",
    "force": "gravity attract pull push",
    "apart": "unique distinct no_repeat spread_out shuffle separate",
    "start": "init initial from resume continue layout previous",
    "stay": "keep_places keep stable",
    "stopwords": "stop_words exclude ignore",
    "keep_words": "keep include whitelist allow",
    "language": "lang locale",
    "phrases": "ngrams ngram bigrams collocations",
    "min_word_length": "min_length min_letters",
    "weight_is": "relative_scaling size_is",
    "report": "json stats metrics measures log",
    "diagnose": "debug diagnostic",
    "save_recipe": "save_config write_recipe config recipe",
    "add": "items icons extra with",
    "stretch": "squeeze distort aspect deform",
    "show_saliency": "saliency show_quiet",
    "strict": "fail_fast no_skip",
    "size_by": "value value_by area_by size",
    "color_by": "colour_by color colour hue",
    "label_by": "label labels name name_by",
    "by": "group group_by facet",
    "emit": "source drop_from pour",
    "finish=none": "no_finish raw approximate",
}  # fmt: skip
"""By option, with a value where one is meant: what is typed for it. What stands first wins where
a word stands twice and the command has both."""

_ARGUMENTS: Mapping[str, str] = {
    "container": "the first argument, CONTAINER",
    "mask": "the first argument, CONTAINER",
    "shape": "the first argument, CONTAINER",
    "region": "the first argument, CONTAINER",
    "items": "the arguments after the container, ITEM...",
    "icons": "the arguments after the container, ITEM...",
    "images": "the arguments after the container",
    "photos": "the arguments after the container, PHOTO...",
    "input": "the arguments: the container, then what fills it",
    "text": "the second argument, SOURCE",
    "data": "the second argument, DATA",
    "words": "the second argument, SOURCE",
}  # fmt: skip

_COMMANDS: Mapping[str, str] = {
    "fill": "collage pack packing arrange layout nest nesting make create mosaic icons shape tile",
    "words": "wordcloud word_cloud cloud word tagcloud tags text wordle wordcloud_cli",
    "chart": "graph plot bar bars unit_chart data pictogram",
    "photos": "photo images image pictures picture album photo_collage photocollage",
    "pile": "heap stack pour drop physics",
    "run": "repeat rerun recipe again replay",
    "measure": "check verify validate info inspect metrics test certify",
    "demo": "example examples try sample",
    "bench": "benchmark benchmarks",
}


def option_meant(typed: str, known: Iterable[str]) -> str | None:
    """Option in place of an unknown one, as a flag or an argument; None if there is none.

    Parameters
    ----------
    typed
        With or without dashes.

    Examples
    --------
    >>> option_meant("--gap", ["padding"]), option_meant("equal", ["sizes"])
    ('--padding', '--sizes shared')
    >>> option_meant("cuont", ["count"]), option_meant("--mask", [])
    ('--count', 'the first argument, CONTAINER')
    """
    plain, there = _plain(typed), {_plain(name): name for name in known}
    for option, typings in _TYPED.items():
        name, _, value = option.partition("=")
        if name in there and plain in typings.split():
            return f"--{name.replace('_', '-')} {value}".strip()
    if plain in _ARGUMENTS:
        return _ARGUMENTS[plain]
    close = difflib.get_close_matches(plain, there, n=1)
    return f"--{close[0].replace('_', '-')}" if close else None


def key_meant(typed: str, known: Iterable[str]) -> str | None:
    """The same for the key of a recipe or an option in Python.

    Examples
    --------
    >>> key_meant("gap", ["padding"]), key_meant("equal", ["sizes"]), key_meant("x", ["sizes"])
    ('padding', 'sizes = "shared"', None)
    """
    known = list(known)
    meant = option_meant(typed, known)
    if meant is None or not meant.startswith("--"):
        close = difflib.get_close_matches(typed, known, n=1)
        return close[0] if close else None
    name, _, value = meant.removeprefix("--").replace("-", "_").partition(" ")
    return f'{name} = "{value}"' if value else name


def command_meant(typed: str) -> str | None:
    """The command for which people type that; None if none is known.

    Examples
    --------
    >>> command_meant("wordcloud"), command_meant("fil"), command_meant("xyz")
    ('words', 'fill', None)
    """
    plain = _plain(typed)
    for command, typings in _COMMANDS.items():
        if plain in typings.split():
            return command
    close = difflib.get_close_matches(plain, _COMMANDS, n=1)
    return close[0] if close else None


def _plain(typed: str) -> str:
    return typed.strip("-").replace("-", "_").lower()
