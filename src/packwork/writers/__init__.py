"""Layouts to files, all through one atomic writer."""

from packwork.writers.atomic import check_outputs, check_writable, write_all, write_atomic
from packwork.writers.diagnose import diagnose_png
from packwork.writers.geojson import geojson_text
from packwork.writers.png import PngOptions, png_bytes
from packwork.writers.recipe import recipe_bytes
from packwork.writers.registry import (
    WRITERS,
    WriteOptions,
    check_output,
    encoded,
    write,
    write_options,
)
from packwork.writers.report import json_bytes
from packwork.writers.svg import SvgOptions, svg_text

__all__ = [
    "WRITERS",
    "PngOptions",
    "SvgOptions",
    "WriteOptions",
    "check_output",
    "check_outputs",
    "check_writable",
    "diagnose_png",
    "encoded",
    "geojson_text",
    "json_bytes",
    "png_bytes",
    "recipe_bytes",
    "svg_text",
    "write",
    "write_all",
    "write_atomic",
    "write_options",
]
