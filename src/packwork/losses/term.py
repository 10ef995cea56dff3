"""Values of losses and the protocols of losses: of images, of colours, of poses."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol, final

import numpy as np

from packwork.arrays import FloatArray, Image, IntArray
from packwork.errors import RecipeError
from packwork.scene.pose import Poses


@dataclass(frozen=True, eq=False)
class Term:
    """Value of an image loss and its derivative.

    Parameters
    ----------
    value
        The loss; a mean over the image's pixels, so that levels agree.
    adjoint
        d value / d density, of the image's size.
    colour_adjoint
        d value / d colour, ``(rows, columns, 3)``, of a loss that is given the colours; None if
        zero.
    """

    value: float
    adjoint: Image
    colour_adjoint: Image | None = None


class ImageLoss(Protocol):
    """A pure function of the density image and the container's coverage.

    Both images are float32 or float64 of one size, ``[row, col]``; the density may
    exceed one. The weight lives in the recipe, not in the loss.
    """

    def __call__(self, density: Image, container: Image) -> Term:
        """Return value and derivative; leave both images, ``(rows, columns)``, as they are."""
        ...


def checked_term(loss: ImageLoss, density: Image, container: Image) -> Term:
    """Term of a loss that a user may have written, checked, of images ``(rows, columns)``.

    Raises ``RecipeError`` if the loss fails, returns no Term, or one of another size or not finite.

    Examples
    --------
    >>> import numpy as np
    >>> checked_term(lambda density, container: None, np.ones((1, 1)), np.ones((1, 1)))
    Traceback (most recent call last):
        ...
    packwork.errors.RecipeError: losses: <lambda> must return a Term, not NoneType
    """
    return checked_call(loss, (density, container))


def checked_call(loss: Callable[..., Any], images: tuple[Image, ...]) -> Term:
    """Term of a loss of these images, checked; the density is the first, colours are the second.

    Raises ``RecipeError`` as for :func:`checked_term`.

    Examples
    --------
    >>> import numpy as np
    >>> checked_call(lambda density: Term(0.0, density), (np.ones((1, 1)),)).adjoint
    array([[1.]])
    """
    name = getattr(loss, "__name__", repr(loss))
    try:
        term = loss(*images)
    except Exception as error:  # a user's code may raise anything
        raise RecipeError("losses", f"{name} failed: {type(error).__name__}: {error}") from error
    if not isinstance(term, Term):
        raise RecipeError("losses", f"{name} must return a Term, not {type(term).__name__}")
    _check_adjoint(f"{name}'s adjoint", term.adjoint, images[0])
    if term.colour_adjoint is not None:
        if len(images) < 3:
            raise RecipeError("losses", f"{name} is given no colours, so has no adjoint of them")
        _check_adjoint(f"{name}'s adjoint of colours", term.colour_adjoint, images[1])
    return term


def _check_adjoint(what: str, adjoint: Image, image: Image) -> None:
    if np.shape(adjoint) != image.shape:
        raise RecipeError(
            "losses", f"{what} must have shape {image.shape}, not {np.shape(adjoint)}"
        )
    if not np.isfinite(adjoint).all():
        raise RecipeError("losses", f"{what} must be finite; it has NaN or infinite values")


@dataclass(frozen=True, eq=False)
class PosedItems:
    """Poses, areas and kinds of n items: the argument of an object-space loss.

    Parameters
    ----------
    areas
        ``(n,)`` areas of their outlines, item units squared.
    nominal
        ``(n,)`` scales that were asked for.
    kinds
        ``(n,)`` items of one number are copies of one thing; None where it does not matter.
    """

    poses: Poses
    areas: FloatArray
    nominal: FloatArray
    kinds: IntArray | None = None


@dataclass(frozen=True, eq=False)
class PoseTerm:
    """Value of an object-space loss and its derivative by the poses.

    Parameters
    ----------
    x, y
        ``(n,)`` derivatives by the items' positions, per canvas unit.
    log_scale
        ``(n,)`` derivatives by the logarithm of their scales; None if zero.
    """

    value: float
    x: FloatArray
    y: FloatArray
    log_scale: FloatArray | None = None


class PoseLoss(Protocol):
    """A pure function of the poses: an object-space loss."""

    def __call__(self, placed: PosedItems) -> PoseTerm:
        """Return the value and its derivative."""
        ...


def checked_pose_term(loss: PoseLoss, placed: PosedItems) -> PoseTerm:
    """Term of a loss of poses that a user may have written, checked.

    Raises ``RecipeError`` if the loss fails, returns no PoseTerm, or one of another size or not
    finite.

    Examples
    --------
    >>> one = np.ones(1)
    >>> placed = PosedItems(Poses(one, one), one, one)
    >>> checked_pose_term(lambda placed: PoseTerm(0.0, [1.0], [0.0]), placed).x
    array([1.])
    """
    name = getattr(loss, "__name__", repr(loss))
    try:
        term = loss(placed)
    except Exception as error:  # a user's code may raise anything
        raise RecipeError("losses", f"{name} failed: {type(error).__name__}: {error}") from error
    if not isinstance(term, PoseTerm):
        raise RecipeError("losses", f"{name} must return a PoseTerm, not {type(term).__name__}")
    x, y, log_scale = (
        None if slopes is None else _checked_slopes(np.asarray(slopes, float), name, placed)
        for slopes in (term.x, term.y, term.log_scale)
    )
    if x is None or y is None:
        raise RecipeError("losses", f"{name} must return the derivatives by x and y")
    return PoseTerm(term.value, x, y, log_scale)


def _checked_slopes(slopes: FloatArray, name: str, placed: PosedItems) -> FloatArray:
    count = len(placed.poses)
    if slopes.shape != (count,):
        raise RecipeError(
            "losses", f"{name}'s derivatives must have shape ({count},), not {slopes.shape}"
        )
    if not np.isfinite(slopes).all():
        raise RecipeError(
            "losses", f"{name}'s derivatives must be finite; some are NaN or infinite"
        )
    return slopes


class ColourLoss(Protocol):
    """A pure function of density, colour image and the container's coverage.

    The colour image is ``(rows, columns, 3)``, sRGB from 0 to 1, of the density's dtype: items in
    their mean colours, mixed by coverage over the function's ``background`` (an attribute, a CSS
    colour; white if it has none). Where items overlap it may leave that range.
    """

    def __call__(self, density: Image, colour: Image, container: Image) -> Term:
        """Return value and derivatives; leave all images, ``(rows, columns)``, as they are."""
        ...


@final
@dataclass(frozen=True, eq=False)
class SeenInColour:
    """A colour loss, and the colours in which a run's items are seen by it.

    ``colours``: ``(n, 3)`` of the items, sRGB from 0 to 1.
    ``background``: ``(3,)``: what shows where nothing lies.

    Examples
    --------
    >>> import numpy as np
    >>> def red(density, colour, container):
    ...     by_colour = np.zeros_like(colour)
    ...     by_colour[..., 0] = 1 / density.size
    ...     return Term(float(colour[..., 0].mean()), np.zeros_like(density), by_colour)
    >>> seen = SeenInColour(red, "red", np.ones((1, 3)), np.zeros(3))
    >>> seen(np.ones((1, 2)), np.ones((1, 2, 3)), np.ones((1, 2))).value
    1.0
    """

    loss: ColourLoss
    name: str
    colours: FloatArray
    background: FloatArray

    @property
    def __name__(self) -> str:
        """As functions have it."""
        return self.name

    def __call__(self, density: Image, colour: Image, container: Image) -> Term:
        """Checked term of the loss, of images ``(rows, columns)``.

        Raises ``RecipeError`` if the loss fails, or returns no such term.
        """
        return checked_call(self.loss, (density, colour, container))
