"""Public names as type checkers and editors know them; loaded by ``_HOMES`` when first used."""

from packwork.api.batches import Batch, batch
from packwork.api.history import History
from packwork.api.inputs import read_container, read_items
from packwork.api.judging import finish, measure
from packwork.api.layout import Layout
from packwork.api.nesting import Nest, nest
from packwork.api.parts import Placement
from packwork.api.series import Series, chart_series, series
from packwork.api.session import Session
from packwork.api.verbs import chart, fill, photos, pile, run, words
from packwork.errors import PackworkError, ReadError, RecipeError, ShapeError, WriteError
from packwork.fit.fitted import FittedOutline, fit_outline
from packwork.geometry.outline import Outline
from packwork.losses.term import ImageLoss, PosedItems, PoseTerm, Term
from packwork.metrics.measure import Metrics
from packwork.progress import Step
from packwork.raster.colour import render_colour, render_colour_pullback
from packwork.raster.coverage import coverage as render
from packwork.raster.coverage import coverage_pullback as render_pullback
from packwork.recipe.typed import Anchor, Force, Hero
from packwork.scene.container import Container
from packwork.scene.item import FlatArt, Item
from packwork.scene.pose import Poses

__all__ = [
    "Anchor",
    "Batch",
    "Container",
    "FittedOutline",
    "FlatArt",
    "Force",
    "Hero",
    "History",
    "ImageLoss",
    "Item",
    "Layout",
    "Metrics",
    "Nest",
    "Outline",
    "PackworkError",
    "Placement",
    "PoseTerm",
    "PosedItems",
    "Poses",
    "ReadError",
    "RecipeError",
    "Series",
    "Session",
    "ShapeError",
    "Step",
    "Term",
    "WriteError",
    "__version__",
    "batch",
    "chart",
    "chart_series",
    "fill",
    "finish",
    "fit_outline",
    "measure",
    "nest",
    "photos",
    "pile",
    "read_container",
    "read_items",
    "render",
    "render_colour",
    "render_colour_pullback",
    "render_pullback",
    "run",
    "series",
    "words",
]

__version__: str
