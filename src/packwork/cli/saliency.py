"""``--show-saliency``: what was found of a picture, before the run that uses it."""

from __future__ import annotations

from pathlib import Path

from packwork.recipe import Recipe


def write_saliency(recipe: Recipe, path: Path | None) -> None:
    """Write the saliency of a recipe's picture and the outline of its quiet part, as PNG.

    None writes nothing.

    Raises
    ------
    ReadError
        If the picture cannot be used.
    RecipeError
        If the container is no picture.
    WriteError
        If nothing can be written there.
    """
    if path is None:
        return
    # Only what is asked for loads the picture library.
    from packwork.display.saliency import saliency_png
    from packwork.errors import RecipeError
    from packwork.readers.saliency.container import QuietOptions
    from packwork.recipe_paths import AROUND
    from packwork.writers import check_writable, write_atomic

    if not recipe.container.startswith(AROUND):
        raise RecipeError(
            "show_saliency", f"needs a container {AROUND}IMAGE, not {recipe.container[:40]!r}"
        )
    check_writable(path)
    quiet = QuietOptions(recipe.quiet_share, recipe.keep_clear or ())
    write_atomic(path, saliency_png(recipe.container, quiet))
