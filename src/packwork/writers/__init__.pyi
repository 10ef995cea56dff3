"""Names as type checkers and editors know them; loaded by ``_HOMES`` when first used."""

from packwork.writers.atomic import (
    check_all,
    check_new,
    check_outputs,
    check_writable,
    described,
    write_all,
    write_atomic,
)
from packwork.writers.bitmaps import png_bytes
from packwork.writers.diagnose import diagnose_png
from packwork.writers.film.film import Film, tell_nobody
from packwork.writers.film.registry import FILMS, check_film, film_bytes
from packwork.writers.geojson import geojson_text, json_bytes
from packwork.writers.halos import faint_message
from packwork.writers.recipe import recipe_bytes
from packwork.writers.registry import (
    WRITERS,
    WriteOptions,
    check_output,
    check_picture_size,
    encoded,
    pdf_drawing,
    write,
    write_options,
)
from packwork.writers.svg import SvgOptions, svg_text

__all__ = [
    "FILMS",
    "WRITERS",
    "Film",
    "SvgOptions",
    "WriteOptions",
    "check_all",
    "check_film",
    "check_new",
    "check_output",
    "check_outputs",
    "check_picture_size",
    "check_writable",
    "described",
    "diagnose_png",
    "encoded",
    "faint_message",
    "film_bytes",
    "geojson_text",
    "json_bytes",
    "pdf_drawing",
    "png_bytes",
    "recipe_bytes",
    "svg_text",
    "tell_nobody",
    "write",
    "write_all",
    "write_atomic",
    "write_options",
]
