"""Options of ``chart`` to the recipe of a run."""

from __future__ import annotations

from typing import Any

from packwork.errors import RecipeError
from packwork.options import Verbs
from packwork.readers.charts import ChartOptions
from packwork.readers.options import check_colour
from packwork.readers.tables.table import categorical_columns, index_of_frame
from packwork.recipe import Recipe, make_recipe
from packwork.recipe.refusals import validated
from packwork.recipe.verbs import with_defaults
from packwork.recipe_paths import check_names

NOT_OURS = ("sizes", "weights", "count", "size_ratio", "stretch", "target_coverage")
"""Options that would let sizes say something else than the data."""


def chart_recipe(container: str, data: object, **options: Any) -> Recipe:
    """Recipe of a unit chart, from the options of ``chart`` and of all runs alike.

    Raises
    ------
    RecipeError
        Naming the option, what was met and what would do.

    Examples
    --------
    >>> recipe = chart_recipe("circle", [{"kg": 2}, {"kg": 1}], size_by="kg", seed=3)
    >>> recipe.chart.size_by, recipe.sizes, recipe.seed
    ('kg', 'shared', 3)
    """
    for key in NOT_OURS:
        if key in options:
            raise RecipeError(key, "is no option of a chart: its data say how large marks are")
    background = options.pop("background", None)
    # What no run knows is meant for the chart, which says what it may have meant.
    own = {key: options.pop(key) for key in list(options) if key not in Recipe.model_fields}
    if background not in (None, "none", "transparent"):
        own["paper"] = check_colour("background", background)
    given = {key: value for key, value in own.items() if value is not None}
    check_names({"chart": {"data": data, **given}})
    told = {"index": index_of_frame(data), "categorical": categorical_columns(data)}
    asked = validated(ChartOptions, {"data": data, **told, **given})
    if asked.by is not None and container.startswith("around:"):
        raise RecipeError("by", "repeats the container, and a picture's quiet part is there once")
    chosen = with_defaults(Verbs.CHART, options)
    return make_recipe(container=container, items=[], chart=asked, **chosen)
