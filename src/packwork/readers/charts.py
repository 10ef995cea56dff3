"""Options of unit charts."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Field, field_validator, model_validator

from packwork.errors import RecipeError
from packwork.options import NOT_OFFERED, Group, Offer, Options, Verbs
from packwork.readers.options import check_colour, texts_of

SizeIs: TypeAlias = Literal["area", "height", "width"]


class ChartOptions(Options):
    """Source of the rows, and the columns that sizes, colours and labels of marks stand for."""

    offers = Offer(group=Group.MARKS, verbs=Verbs.CHART)

    data: Annotated[str | tuple[dict[str, Any], ...], NOT_OFFERED]
    """A table: .csv, .xlsx, .json or (with pandas) .parquet; in Python also a data frame, rows
    as dicts, or a dict of columns."""

    index: Annotated[dict[str, str], NOT_OFFERED] = Field(default_factory=dict)
    """Columns that were a data frame's index, with their types: they are its index again."""

    categorical: Annotated[tuple[str, ...], NOT_OFFERED] = ()
    """Columns that hold categories in a data frame, numbers too."""

    size_by: str | None = None
    """Column of numbers that sizes are in proportion to. Default: of words the weights; in a chart
    all marks are alike."""

    size_is: SizeIs = "area"
    """What of a mark is in that proportion: its area, height or width."""

    unit: Annotated[float, Field(ge=1e-100, le=1e100)] | None = None
    """One mark for each so many of --size-by (without it: so many rows that are alike in
    what is shown of them); what is left over is a part of a mark."""

    color_by: str | None = None
    """Column that colours come from: of numbers, from small to large along the palette; of
    anything else, a colour for each value."""

    mark: Annotated[
        tuple[str, ...], texts_of("mark"), Offer(takes=str | Path | tuple[str | Path, ...])
    ] = ()
    """What stands for a row: an SVG, a picture, a folder or a built-in name. May be given
    several times, with --mark-by. Default: circle."""

    mark_by: str | None = None
    """Column whose values have marks of their own: that of the same name, else in turn."""

    label_by: str | None = None
    """Column that names marks: in files, tooltips and messages, and on marks that have room; of a
    table of words, their column."""

    by: str | None = None
    """Column that parts marks into groups: each has a container of its own or, in container none,
    is a bar that its marks stand in or have fallen into. All marks have one scale."""

    by_step: Annotated[float, Field(gt=0, allow_inf_nan=False)] | None = None
    """With --by and a column of numbers: groups of so many, as 10 for decades."""

    in_regions: bool = False
    """With --by: each group lies in the part of the container that has its name, such as a state
    of a map: GeoJSON whose features have names, or an SVG whose shapes have titles or ids."""

    title: str | None = None
    """Line over the chart."""

    legend: bool = True
    """Keys to sizes, colours and marks under the chart."""

    paper: Annotated[str, NOT_OFFERED] = "white"
    """What is behind the chart: colours are made to be seen on it."""

    @model_validator(mode="after")
    def _steps_of_something(self) -> ChartOptions:
        if self.by_step is not None and self.by is None:
            raise RecipeError(
                "by_step", "parts the numbers of a column; say which: --by COL, or --series COL"
            )
        if self.in_regions and self.by is None:
            raise RecipeError("in_regions", "needs the column that names them; say which: --by COL")
        return self

    @field_validator("paper")
    @classmethod
    def _paper_has_a_colour(cls, text: str) -> str:
        # What is clear lies on white, wherever it is shown.
        return "white" if text in {"none", "transparent"} else check_colour("paper", text)

    @field_validator("data", mode="before")
    @classmethod
    def _data_are_rows(cls, data: Any) -> Any:
        if isinstance(data, str | Path):
            return str(data)
        # What turns frames into rows is not needed for the command line's help.
        from packwork.readers.tables.table import rows_of_frame

        try:
            return tuple(rows_of_frame(data))
        except RecipeError as error:
            raise ValueError(error.problem) from None
