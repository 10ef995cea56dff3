"""Request of a run: a recipe and its parts, their options and refusals."""

from packwork.recipe.recipe import APART, EPOCHS, Effort, Recipe, Sizes, make_recipe
from packwork.recipe.rules import AUTO, MAX_COUNT, Rotation

__all__ = [
    "APART",
    "AUTO",
    "EPOCHS",
    "MAX_COUNT",
    "Effort",
    "Recipe",
    "Rotation",
    "Sizes",
    "make_recipe",
]
