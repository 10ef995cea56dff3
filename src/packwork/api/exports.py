"""Layouts as other libraries know them: pictures, arrays, frames, patches on axes."""

from __future__ import annotations

import io
import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np
import numpy.typing as npt
from PIL import Image
from pydantic import ValidationError

from packwork import writers
from packwork.api.keywords import SaveKeywords
from packwork.api.signatures import of_model
from packwork.display.extras import data_frame, draw_on_axes, geo_data_frame
from packwork.display.picture import notebook_png, notebook_svg
from packwork.recipe.refusals import refusal
from packwork.scene import layout as scene
from packwork.writers.options import DrawingOptions

if TYPE_CHECKING:
    from geopandas import GeoDataFrame
    from matplotlib.axes import Axes
    from pandas import DataFrame
else:
    GeoDataFrame = Axes = DataFrame = Any


def drawing_options(options: Mapping[str, Any]) -> writers.WriteOptions:
    """Options of drawing, refused in the words of the package."""
    try:
        return writers.write_options(**options)
    except ValidationError as error:
        raise refusal(error, DrawingOptions) from error


class Exported(scene.Layout):
    """A layout that becomes what other libraries have."""

    @of_model(DrawingOptions)
    def to_svg(self, **options: Unpack[SaveKeywords]) -> str:
        """Text of the SVG that :meth:`save` writes.

        Examples
        --------
        >>> from packwork import fill
        >>> fill("circle", "star", effort="draft", levels="50").to_svg()[:5]
        '<?xml'
        """
        return self._encoded("svg", drawing_options(options)).decode()

    @of_model(DrawingOptions)
    def to_png(self, **options: Unpack[SaveKeywords]) -> bytes:
        """Content of the PNG that :meth:`save` writes: :meth:`to_svg`, in ``pixels``."""
        return self._encoded("png", drawing_options(options))

    @of_model(DrawingOptions)
    def to_image(self, **options: Unpack[SaveKeywords]) -> Image.Image:
        """Picture of the same pixels as Pillow has it, with opacity."""
        with Image.open(io.BytesIO(self.to_png(**options))) as drawn:
            return drawn.convert("RGBA")

    @of_model(DrawingOptions)
    def to_array(self, **options: Unpack[SaveKeywords]) -> npt.NDArray[np.uint8]:
        """The same as an array ``(rows, columns, 4)``: red, green, blue and opacity, 0 to 255.

        Examples
        --------
        >>> from packwork import fill
        >>> fill("circle", "star", effort="draft", levels="50").to_array(pixels=90).shape
        (90, 90, 4)
        """
        return np.asarray(self.to_image(**options))

    def to_geojson(self) -> dict[str, Any]:
        """GeoJSON as :meth:`save` writes it: canvas units, y down.

        Examples
        --------
        >>> from packwork import fill
        >>> made = fill("circle", "star", effort="draft", levels="50").to_geojson()
        >>> [feature["properties"]["role"] for feature in made["features"]]
        ['container', 'item']
        """
        made: dict[str, Any] = json.loads(self._encoded("geojson", writers.WriteOptions()))
        return made

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """The same, for GeoPandas, Shapely and others that ask for it."""
        return self.to_geojson()

    def _encoded(self, format: str, options: writers.WriteOptions) -> bytes:
        return writers.encoded(self, f"layout.{format.lower().lstrip('.')}", options)

    def to_dataframe(self) -> DataFrame:
        """Pandas data frame: one row per item, in the layout's order.

        Of a chart, first the columns of its table (the index of a data frame is the index again),
        then ``value`` (what the mark stands for), ``category`` and ``group``, where there are any;
        of items that were rows of a data frame its index; of all layouts ``item``, ``source``,
        ``x``, ``y``, ``angle_deg`` (degrees, clockwise, as in files), ``scale``, ``stretch``,
        ``area`` (squared canvas units), ``weight`` and ``color``. Where the table has a column of
        that name too, ours is called ``mark_x`` and so on.

        Raises
        ------
        PackworkError
            If pandas is not installed.

        Examples
        --------
        >>> from packwork import chart
        >>> sold = {"fruit": ["fig", "kiwi"], "kg": [3, 1]}
        >>> layout = chart("circle", sold, size_by="kg", effort="draft", levels="50")
        >>> frame = layout.to_dataframe()
        >>> frame["fruit"].tolist(), round(float(frame["area"][0] / frame["area"][1]), 6)
        (['fig', 'kiwi'], 3.0)
        """
        return data_frame(self)

    def to_geodataframe(self) -> GeoDataFrame:
        """GeoPandas frame: :meth:`to_dataframe` with each item's outline in place as its geometry.

        Canvas units, y down, without a reference system.

        Raises
        ------
        PackworkError
            If GeoPandas is not installed.
        """
        return geo_data_frame(self)

    def plot(self, ax: Axes | None = None, **patch: Any) -> Axes:
        """Draw the items on Matplotlib axes, true to scale, y down; the axes.

        Each item is a ``PathPatch`` of what is drawn of it, holes and all, in its colour;
        pictures and drawings of several colours are in their mean colour. A chart's title stands
        over it, and keys of its categories beside it, or a bar of its numbers' colours.

        Parameters
        ----------
        ax
            Axes to draw on; new ones without ticks and frame if None.
        patch
            What Matplotlib knows of patches, for all of them: ``edgecolor="white"``, ``alpha=0.5``.

        Raises
        ------
        PackworkError
            If Matplotlib is not installed.

        Examples
        --------
        >>> from packwork import fill
        >>> layout = fill("circle", "star", count=3, effort="draft", levels="50")
        >>> len(layout.plot().patches)
        3
        """
        axes: Axes = draw_on_axes(self, ax, patch)
        return axes

    def _repr_svg_(self) -> str | None:
        return notebook_svg(self)

    def _repr_png_(self) -> tuple[bytes, dict[str, int]] | None:
        return notebook_png(self)
