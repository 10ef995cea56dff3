"""A sheet on a larger page: bleed, boxes, crop and registration marks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, final

from packwork.errors import RecipeError
from packwork.scene.container import Container
from packwork.scene.notation import number
from packwork.units import convert, length_asked
from packwork.writers.cutting import HAIRLINE_PT
from packwork.writers.prepress.options import MarksChoice

if TYPE_CHECKING:
    import pikepdf

_MM = 72 / 25.4

MARK_PT = 5 * _MM
"""Length of a mark: what print shops set."""

OFFSET_PT = 2.1 * _MM
"""Least distance of marks from the trimmed sheet, for a knife that strays; a larger bleed keeps
them farther off."""

_FREE_PT = 1 * _MM
"""Paper beyond the marks. Chosen."""

_DIGITS = 4
"""Decimals of a coordinate, in points: 35 nm."""

_QUARTER = 0.5523
"""Handles of a cubic that is a quarter of a circle, over its radius."""

_ALL = "All"


@final
@dataclass(frozen=True, kw_only=True)
class PrintSheet:
    """A trimmed sheet in points, what is printed beyond it on each side, and its marks."""

    width: float
    height: float
    bleed: float = 0.0
    marks: MarksChoice = "none"

    @property
    def around(self) -> float:
        """Width of the page beyond the sheet on each side."""
        return self.bleed if self.marks == "none" else self._offset + MARK_PT + _FREE_PT

    @property
    def page(self) -> tuple[float, float]:
        """Size of the whole page."""
        return self.width + 2 * self.around, self.height + 2 * self.around

    @property
    def is_plain(self) -> bool:
        """Whether the page is the sheet."""
        return self.around == 0

    def box(self, beyond: float) -> list[float]:
        """Box of the sheet and so much more on each side, on the page.

        Examples
        --------
        >>> PrintSheet(width=100, height=50, bleed=9).box(0.0)
        [9.0, 9.0, 109.0, 59.0]
        """
        near = self.around - beyond
        far = (near + side + 2 * beyond for side in (self.width, self.height))
        return [round(v, 6) for v in (near, near, *far)]

    def put_boxes(self, page: pikepdf.Page) -> None:
        """Say on a page where it is trimmed and how far it bleeds."""
        page.TrimBox = self.box(0.0)
        page.BleedBox = self.box(self.bleed)

    def put_marks(self, pdf: pikepdf.Pdf) -> None:
        """Draw the marks on the first page of a PDF, in all inks."""
        from pikepdf import Array, Dictionary, Name

        if self.marks == "none":
            return
        tint = Dictionary(FunctionType=2, Domain=[0, 1], C0=[0] * 4, C1=[1] * 4, N=1)
        every = Array([Name.Separation, Name.All, Name.DeviceCMYK, tint])
        page = pdf.pages[0]
        page.add_resource(pdf.make_indirect(every), Name.ColorSpace, Name(f"/{_ALL}"))
        page.contents_add(b"q\n", prepend=True)
        page.contents_add(self._drawn().encode())

    @property
    def _offset(self) -> float:
        return max(self.bleed, OFFSET_PT)

    def _drawn(self) -> str:
        sides = (self.width, self.height)
        near, far = self._offset, self._offset + MARK_PT
        lines = []
        for across in (0, 1):
            for trim in (0.0, sides[across]):
                for start, end in ((-near, -far), (sides[1 - across] + v for v in (near, far))):
                    ends = [(trim, start), (trim, end)]
                    lines.append(self._line([p if across == 0 else p[::-1] for p in ends]))
        if self.marks == "all":
            middle = self._offset + MARK_PT / 2
            for x, y in (
                (-middle, self.height / 2),
                (self.width + middle, self.height / 2),
                (self.width / 2, -middle),
                (self.width / 2, self.height + middle),
            ):
                lines += self._target(x, y, MARK_PT / 2)
        return "\n".join(["Q", "q", f"/{_ALL} CS 1 SCN {HAIRLINE_PT:g} w", *lines, "Q", ""])

    def _line(self, points: list[tuple[float, float]]) -> str:
        first, *rest = (self._at(x, y) for x, y in points)
        return f"{first} m " + " ".join(f"{point} l" for point in rest) + " S"

    def _target(self, x: float, y: float, reach: float) -> list[str]:
        """A cross in a circle of half its reach."""
        r, h = reach / 2, reach / 2 * _QUARTER
        arcs = [
            ((r, h), (h, r), (0, r)), ((-h, r), (-r, h), (-r, 0)),
            ((-r, -h), (-h, -r), (0, -r)), ((h, -r), (r, -h), (r, 0)),
        ]  # fmt: skip
        curves = (" ".join(self._at(x + dx, y + dy) for dx, dy in arc) + " c" for arc in arcs)
        return [
            self._line([(x - reach, y), (x + reach, y)]),
            self._line([(x, y - reach), (x, y + reach)]),
            f"{self._at(x + r, y)} m {' '.join(curves)} s",
        ]

    def _at(self, x: float, y: float) -> str:
        return f"{number(self.around + x, _DIGITS)} {number(self.around + y, _DIGITS)}"


def print_sheet(container: Container, bleed: str | None, marks: MarksChoice) -> PrintSheet:
    """Sheet of a container's canvas; a RecipeError if the bleed is none."""
    width, height = (convert(v, container.unit, "pt") for v in (container.width, container.height))
    beyond = 0.0 if bleed is None else bleed_pt(bleed, container)
    return PrintSheet(width=width, height=height, bleed=beyond, marks=marks)


def bleed_pt(text: str, container: Container) -> float:
    """Bleed in points; a RecipeError if it is no length, or more than the canvas is long."""
    length = length_asked("bleed", text, container.unit, container.side)
    if length > container.side:
        raise RecipeError("bleed", f"is at most as long as the canvas, not {text[:40]}; use 3mm")
    return convert(length, container.unit, "pt")
