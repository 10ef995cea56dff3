"""Options of the verbs as type checkers and editors know them.

Written by ``tools/write_keywords.py`` from the fields of the options: not to be changed by hand.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from pathlib import Path
from typing import Any, Literal, Required, TypedDict

from numpy.random import Generator

from packwork.api.plain import Cells, Colours
from packwork.api.signatures import RunKeywords
from packwork.readers.memory.values import Value
from packwork.readers.words.word import Word
from packwork.recipe.typed import Anchor, Force, Hero
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses


class PinTable(TypedDict, total=False):
    """Given parts of one item's pose."""

    x: str | float | None
    """Where its centroid lies, from the canvas' left edge; % are of the canvas' width."""

    y: str | float | None
    """The same from the canvas' top edge; % are of its height."""

    angle_deg: float | None
    """Turn from upright, degrees clockwise."""

    size: str | float | None
    """Longer side of the item as drawn; % are of the canvas' longer side."""


class RuleTable(TypedDict, total=False):
    """Rule for the items of some names."""

    items: Required[Value | Iterable[Value] | None]
    """Names of items, or patterns such as ``b*``."""

    count: int | None
    """Copies of each of them."""

    scale: list[float] | tuple[float, float] | None
    """Smallest and largest size, 1 being the typical item's. With free sizes."""

    rotate: str | float | Sequence[float] | None
    """Turns that they may have, in the words of the option ``rotate``."""

    weight: float | None
    """Share of area, as in ``weights``."""

    pin: PinTable | None
    """Given parts of the pose. With both x and y the rule is for one copy only."""

    region: Value | Sequence[str | float] | None
    """Part of the canvas to stay in: a container, or left, top, width and height."""

    color: Colours | None
    """One colour, or a palette: items of several colours become silhouettes; or ``own``, where
    another rule or the recipe gives colours that these items shall not have."""

    name: str | None
    """Name in the file that is written."""

    link: str | None
    """Where a click on it leads: http(s), mailto or a relative address."""

    title: str | None
    """Text that is shown when a pointer rests on it."""


class _FillWordsPhotos(TypedDict, total=False):
    """Options of fill, words, photos."""

    margin: str | float
    """Free edge of the sheet, in which nothing is placed, a length as for the padding: what a
    printer cannot reach or a frame hides. The container is drawn in as far as it takes. Default:
    '0'."""

    quiet_share: float | str
    """Of a container around:IMAGE: the share of the picture that is filled, as 0.4 or 40%: that in
    which least is to be seen. Default: 0.4."""

    keep_clear: str | Sequence[str] | None
    """Of a container around:IMAGE: what is left free in any case, a mask (dark is kept clear) or a
    box left,top,width,height such as 10%,20%,30%,30%."""

    tile: Literal["square", "half-drop", "hexagon"] | None
    """A canvas that repeats without a seam: items pass over its edge and come in again on the other
    side. square: in rows and columns; half-drop: every other column half a tile lower; hexagon: the
    same in a honeycomb, on a canvas of the height that this needs. Either way the file repeats by
    itself, side by side. The container is page or square."""

    sizes: Literal["free", "shared", "fixed", "graded", "auto"]
    """free: each item finds its size; shared: all have equal areas, or areas in the shares of the
    weights; fixed: as large as in their files; graded (words alone): in proportion as far as there
    is room, the heaviest first, no word larger than a heavier one; auto (words alone): graded where
    the container is thin or branched, or many words in proportion would leave it bare, else shared.
    Default: 'free' (fill, photos), 'auto' (words)."""

    size_ratio: float | None
    """With free sizes: 2 lets an item be half to twice as large as the typical one. Default: 2; of
    6 icons at most 1.5, of 7 to 59 in between, and with a picture 1.5."""

    hero: str | Hero | None
    """One item larger than the rest and upright: NAME, NAME=30% (its longer side) or
    NAME@50%,40%=30% (where its middle lies, as shares of the canvas' width and height)."""

    arrange: str | None
    """In which order items lie: a way (right, left, down, up, 45deg, outwards or inwards from the
    middle, around it, or along the container from end to end) and what rises along it, as in right
    by=weight, outwards by=ages.csv (lines of name,number), around by=hue; also lightness and name,
    and of words a column of their table."""

    embeddings: Value | None
    """Vectors of the items (.npy, .csv, .xlsx, .json, .parquet; a row an item, or a first column of
    names): those with like ones come to lie together. auto: of words, by which of them stand near
    each other in the text."""

    anchors: str | Anchor | Sequence[str | Anchor]
    """With --embeddings: where things lie that are like a row, a column or a word, as left=warm;
    also right, up, down, 45deg, middle. May be given several times."""

    label_regions: bool
    """Write names among the items, on small plates that are placed as items are: of groups, where
    the table of --embeddings has a column of texts beside the names; else of the parts of an SVG as
    the container that have titles or ids. Default: False."""

    picture: Value | None
    """A picture that the layout shows from afar: items take on its colours (--tint), photos come to
    lie where theirs fit best. It covers the container's box."""

    tint: float | str | None
    """How far items take on the colours of --picture, as 0.3 or 30%; 0 leaves theirs, and puts each
    where they fit best. Default: 0 of photos, 100% of all else."""

    detail: float | str | None
    """How far sizes follow --picture, as 0.5 or 50%: small items where it has much to show, large
    ones where it has little. Only with --sizes free. Default: 50%, of photos 0."""

    ground: str | None
    """Colour of the gaps, which the colours of --picture make up for. Default: that of
    --background, else the one that shows the picture best, which then is the background."""

    target_coverage: float | str | None
    """Share of the container to cover, as 0.94 or 94%: smaller copies are put into the voids, round
    by round, until it is reached or nothing more fits."""

    max_items: int | None
    """Put smaller copies into the voids until there are so many items in all (default 1000)."""

    smallest: str | float | None
    """Put smaller copies into the voids, down to this longer side, a length as for the padding
    (default 0.5%). Of words: the least font size; smaller ones are left out and named."""

    filler: Value | Iterable[Value] | None
    """Items to put into the voids, in place of smaller copies of the items."""


class _FillWordsPhotosPile(TypedDict, total=False):
    """Options of fill, words, photos, pile."""

    count: int | Literal["auto"] | None
    """How many items in all; the given ones are repeated in turn. Default: one of each. Of words:
    how many at most, those of the largest weights; default 100. auto: as many as it takes for the
    container's shape to show."""


class _FillPhotosPile(TypedDict, total=False):
    """Options of fill, photos, pile."""

    font: str | Path | None
    """Font file (TTF, OTF, TTC) or installed family, for a container text:WORD or for words; for
    these also several in turn. Default: a bundled bold sans, others for what it lacks."""

    weights: str | Path | Mapping[str, float] | Cells | None
    """Shares of area, which shared sizes hold: a CSV file of name,weight (in Python a dict too)."""

    strict: bool
    """Refuse a folder with an unusable file instead of leaving that file out. Default: False."""

    items_from: Literal["seed", "first"]
    """Where folders hold more items than the count: seed draws from all of them, first takes the
    first by name. No others are read, unless weights, vectors or a picture speak of all. Default:
    'seed'."""


class _Every(TypedDict, total=False):
    """Options of fill, words, photos, chart, pile."""

    canvas: str | float | Sequence[float] | None
    """Longer side of the canvas, as 600 (px, 96 to the inch), 200mm or 8in, or a sheet, as
    200x150mm, A4 (A0 to A6, letter) or A4-landscape. Its unit is that of all results. Default: an
    SVG container in mm, cm, in or pt keeps its size; any other becomes 600 px."""

    rotate: str | float | Sequence[float]
    """free (words: within 90 degrees, never upside down; fewer than 60 icons: the nearer to upright
    the fewer, unless 180 is asked), none, 30 (within 30 degrees of upright, as upright) or 0,90
    (only these angles); also horizontal, vertical (read upwards), mixed (one in four vertical).
    Default: 'free' (fill, pile), 'horizontal' (words), '15' (photos), 'none' (chart)."""

    padding: str | float
    """Gap between items and to the container's edge: 4 (in the canvas' unit), 1mm, 3pt, 0.5cm,
    0.1in, or 1% of the canvas' longer side; auto: 0.3% of words, 0.2% in charts, 0.4% of cropped
    photos with borders, less of so many; else none but between icons of one colour. Default:
    'auto'."""

    trim: bool | None
    """Leave out the page round a container's drawing (an SVG or a mask), or keep it. Default: left
    out where the drawing takes less than a third of it across and down, but a page in mm, cm, in or
    pt is kept. Items are their drawings in any case."""

    keep_page: bool | None
    """Whether the white page behind an item's drawing, or the plain background of a picture, is
    part of it. Default: left out where it looks like a page (nothing on it touches its edges, and
    most files of the same folder do not fill theirs)."""

    close_gaps: str | float
    """Slits of a container that are closed, as between the states of a map: auto (up to 0.2% of its
    extent), none, or their width, a length as for the padding. Default: 'auto'."""

    alpha_threshold: float
    """Opacity from which the paint of a picture belongs to its outline, as a share of its most
    opaque pixel: smaller takes soft shadows in, larger leaves more of soft edges out. Default:
    0.5."""

    delimiter: str | None
    """What parts the cells of a table: one character, such as ; or tab. Default: what parts all of
    its lines alike."""

    decimal: Literal[".", ","] | None
    """What parts the whole of a number from its fraction in tables and texts of cells: . or , (the
    other one, spaces and apostrophes then group thousands). Default: as the numbers of the column
    show."""

    encoding: str | None
    """How the letters of a table or a text are stored, such as utf-8, cp1252 or cp1251. Default:
    UTF-8, UTF-16, or the Windows encoding that its letters show."""

    seed: Generator | int | None
    """Same seed, same machine, same versions: same layout. Default: 0."""

    threads: int | None
    """Threads that the run may use; default: as many as there are cores for it. The result is the
    same with any number; 1 where several runs share a machine."""

    start: str | Path | Layout | Poses | None
    """How the first places are found: distance-field (into the largest room), medial-axis (along
    the middle line), auto (of these two), scatter (at random), first-fit (where they touch most;
    for words and shared sizes), or a layout (.geojson, .svg, .dxf, .packwork). Default: what suits
    the sizes, of photos the best of distance-field, medial-axis and scatter."""

    rules: Sequence[RuleTable]
    """What is asked of single items (in Python and recipe files)."""


class _FillPhotos(TypedDict, total=False):
    """Options of fill, photos."""

    least_dpi: float | None
    """Enlarge no picture beyond so many of its own pixels to the inch: those of few pixels stay
    small. Default: pictures are as large as suits the layout."""

    apart: bool
    """Keep copies of one item from lying side by side, as far as that goes. Default: False."""


class _FillWords(TypedDict, total=False):
    """Options of fill, words."""

    outline: Literal["exact", "hull"]
    """What an item is taken for while it is placed: exact (its true outline) or hull (no item in
    another's bays). What is measured and written is the true outline. Default: 'exact'."""

    stay: bool
    """With --start LAYOUT: items stay as near to where they were as the result allows. They are
    told by their names; new ones go into voids, and those no longer asked for leave. Default:
    False."""


class _FillWordsPile(TypedDict, total=False):
    """Options of fill, words, pile."""

    force: str | Force | Sequence[str | Force] | None
    """Pull items about: down, up, left, right, 30deg, towards PLACE, away PLACE, inward, align,
    balance or together; docs/guide/forces.md has all. May be given several times."""

    stroke_width: Literal["scaled", "even"]
    """Lines of items that are drawn in lines, as line icons: scaled (as wide as their sizes make
    them) or even (alike on all of them: of larger ones thinner, before items grow together).
    Default: 'scaled'."""


class _FillWordsChartPile(TypedDict, total=False):
    """Options of fill, words, chart, pile."""

    palette: Colours | None
    """New colours for items, neighbours unlike: #e63946,#457b9d or okabe-ito, tol-bright,
    tol-vibrant, tol-muted, tol-high-contrast; of the values of a column (--color-by) also by name,
    as bear=red,fox=#457b9d. Photographs keep theirs."""

    holes: Literal["fill", "keep"]
    """keep: the holes of items stay free, so that small items may sit in them. Default: 'fill'."""


class _FillPile(TypedDict, total=False):
    """Options of fill, pile."""

    shades: Literal["tint", "nearest", "keep"]
    """What --palette does to drawings of several colours: tint (each in the tints and shades of one
    colour, by lightness), nearest (each of their colours becomes the palette's nearest) or keep
    (they keep their own, as among words). Default: 'tint'."""


class _FillWordsPhotosChart(TypedDict, total=False):
    """Options of fill, words, photos, chart."""

    finish: Literal["exact", "none"]
    """exact: after the levels, items are moved, turned and sized in exact geometry until nothing
    overlaps and nothing sticks out; none: what the levels gave, not certified. Default: 'exact'."""

    effort: Literal["draft", "normal", "best"]
    """How many iterations: draft, normal or best. Default: 'normal'."""

    epochs: int | None
    """Iterations in all, instead of an effort."""

    time: float | None
    """Seconds for the whole run, in place of iterations: results then depend on the machine."""

    levels: str | int | Sequence[int] | None
    """Resolutions from coarse to fine, pixels on the longer side, each with its share of the
    epochs, as 50:9,200:23,600:68 (the default); without shares, as 50,200,600 (the paper's), they
    are even."""

    losses: Mapping[Any, float]
    """Weights of losses, by name, module:function or (in Python) as functions: in place of the
    preset's, or beside them; 0 switches one off."""


class _WordsPhotos(TypedDict, total=False):
    """Options of words, photos."""

    share: str | Mapping[str, float | str] | None
    """Shares of the area where words, photos and other items are mixed:
    words=50%,photos=30%,items=20%."""


class _WordsChart(TypedDict, total=False):
    """Options of words, chart."""

    keep_totals: bool
    """Take rows that are totals of the others, such as one called Total or Sum, for rows like them.
    Default: they are left out and named."""

    background: str | None
    """Any CSS colour, or none. Default: none in SVG and PDF, white in PNG."""


class FillKeywords(
    _FillWordsPhotos,
    _FillWordsPhotosPile,
    _FillPhotosPile,
    _Every,
    _FillPhotos,
    _FillWords,
    _FillWordsPile,
    _FillWordsChartPile,
    _FillPile,
    _FillWordsPhotosChart,
    total=False,
):
    """Options of :func:`packwork.fill`."""

    stretch: float
    """1.5 lets each item become up to 1.5 times as wide for its height as it was drawn, or as high
    for its width, at the same area. 1 keeps all proportions. Default: 1.0."""

    preset: Literal["default", "paper"]
    """Losses, weights and steps: default, or paper (as published by Wang and Lu, 2025)."""


class FillRun(RunKeywords, FillKeywords, total=False):
    """All parameters of :func:`packwork.fill` that are given by name."""


class WordsKeywords(
    _FillWordsPhotos,
    _FillWordsPhotosPile,
    _Every,
    _FillWords,
    _FillWordsPile,
    _FillWordsChartPile,
    _FillWordsPhotosChart,
    _WordsPhotos,
    _WordsChart,
    total=False,
):
    """Options of :func:`packwork.words`."""

    label_by: str | None
    """Column that names marks: in files, tooltips and messages, and on marks that have room; of a
    table of words, their column."""

    size_by: str | None
    """Column of numbers that sizes are in proportion to. Default: of words the weights; in a chart
    all marks are alike."""

    min_count: int
    """How often a word must stand in the text. Default: 1."""

    language: str
    """Whose function words are left out: auto (the language of the text), codes such as en or
    en,de, or none. Default: 'auto'."""

    stopwords: str | Path | Sequence[str | Path] | AbstractSet[str] | None
    """Further words to leave out, with commas between them, or a file of them. A word that is left
    out takes its plural and its other forms along."""

    keep_words: str | Path | Sequence[str | Path] | AbstractSet[str] | None
    """Words to count though they are function words or too short, with commas between them, or a
    file of them."""

    min_word_length: int
    """Letters that a word of a text has at least; one syllable of Korean is a word anyway. Default:
    2."""

    include_numbers: bool
    """Numbers that stand alone count as words too. Default: False."""

    regexp: str | None
    """What counts as a word of a text, as a regular expression of Python such as [#@]\\w+."""

    phrases: int
    """2 also counts pairs of words that often stand together, 3 triples too. Default: 1."""

    plurals: Literal["merge", "keep"]
    """merge: plurals of English, German, French, Spanish, Portuguese, Italian and Dutch count with
    their singular, if both stand in the text. Default: 'merge'."""

    along: Literal["limbs", "edge"] | None
    """Words follow curves, and are set again until these are full; the heaviest are a cloud in what
    is left. limbs: the middle of what is long and thin of the container; edge: its edge."""

    ring: list[str] | tuple[str, ...]
    """Text that follows the edge at the top of the container, as on a badge; a second one at its
    bottom. The words lie inside."""

    photos: Mapping[str, Any] | None
    """Photographs to place: which, and what becomes of their edges (``packwork photos``)."""

    case: Literal["common", "lower", "upper"]
    """How words are written: as they mostly stand in the text, lower or upper. Default:
    'common'."""

    fonts: str | Path | Sequence[str | Path]
    """Font file or installed family; the next ones set what the first cannot. Default: a bundled
    black sans, then whatever is installed and has the letters."""

    container_font: str | Path | None
    """Font file or installed family of a container text:WORD, where it is another than the words'
    first."""

    font_weight: int
    """Weight of a family or a variable font: 400 is regular, 700 bold. Default: 700."""

    nest: bool | None
    """Words may stand in the counters of larger ones, such as in an O. Default: where sizes give
    way."""

    weight_is: Literal["height", "area", "ink"]
    """What is in the proportion of the weights: height (of the letters), area (of the letters:
    their height by the root) or ink (of the whole word: long ones are lower). Default: 'height'."""

    largest: str | float | None
    """Font size of the largest word at most, a length as for the padding, such as 48pt or 10%; all
    others stay in proportion."""

    repeat: Literal["none", "auto"] | None
    """auto: words are set again, smaller and grey, where nothing else finds a place; none: each
    once. Default: none, but words of one weight in letters (text:HELLO) are set again, as large as
    before, for these to be read."""

    color_by: str | Callable[[Word], str | None] | None
    """weight (the palette from small to large), a column of the table, or a picture under the
    words; in Python also a function of a word. Default: neighbours unlike."""

    contrast: float
    """Least contrast of words and background, as WCAG counts it; 1 leaves colours alone. Default:
    3.0."""


class WordsRun(RunKeywords, WordsKeywords, total=False):
    """All parameters of :func:`packwork.words` that are given by name."""


class PhotosKeywords(
    _FillWordsPhotos,
    _FillWordsPhotosPile,
    _FillPhotosPile,
    _Every,
    _FillPhotos,
    _FillWordsPhotosChart,
    _WordsPhotos,
    total=False,
):
    """Options of :func:`packwork.photos`."""

    grid: bool
    """Lay photos as squares in rows, -n of them (1,500 unless given), each where its colours and
    its structure show --picture best. They repeat, and keep apart. Default: False."""

    repeats: int | None
    """With --grid: how often one photo may be used. Default: twice as often as it takes."""

    shape: Value | None
    """Cut photos to a shape: rounded, rounded:20% (radius as a share of the shorter side), or
    whatever can be a container, such as circle, heart or a mask. Default: none."""

    border: str
    """Width of a border around each photo, as a share of its shorter side, such as 4%: it lies
    outside the photo and hides nothing of it. Default: '0%'."""

    border_color: str
    """Colour of the border. Default: 'white'."""

    edge: Literal["inside", "crop"]
    """What becomes of photos at the container's edge: inside (all of each photo is seen) or crop
    (they cover the edge and are cut at its line, for a clean rim). Default: 'inside'."""


class PhotosRun(RunKeywords, PhotosKeywords, total=False):
    """All parameters of :func:`packwork.photos` that are given by name."""


class ChartKeywords(_Every, _FillWordsChartPile, _FillWordsPhotosChart, _WordsChart, total=False):
    """Options of :func:`packwork.chart`."""

    size_by: Cells | None
    """Column of numbers that sizes are in proportion to. Default: of words the weights; in a chart
    all marks are alike."""

    size_is: Literal["area", "height", "width"]
    """What of a mark is in that proportion: its area, height or width. Default: 'area'."""

    unit: float | None
    """One mark for each so many of --size-by (without it: so many rows that are alike in what is
    shown of them); what is left over is a part of a mark."""

    color_by: Cells | None
    """Column that colours come from: of numbers, from small to large along the palette; of anything
    else, a colour for each value."""

    mark: Value | Iterable[Value] | None
    """What stands for a row: an SVG, a picture, a folder or a built-in name. May be given several
    times, with --mark-by. Default: circle."""

    mark_by: Cells | None
    """Column whose values have marks of their own: that of the same name, else in turn."""

    label_by: Cells | None
    """Column that names marks: in files, tooltips and messages, and on marks that have room; of a
    table of words, their column."""

    by: Cells | None
    """Column that parts marks into groups: each has a container of its own or, in container none,
    is a bar that its marks stand in or have fallen into. All marks have one scale."""

    by_step: float | None
    """With --by and a column of numbers: groups of so many, as 10 for decades."""

    in_regions: bool
    """With --by: each group lies in the part of the container that has its name, such as a state of
    a map: GeoJSON whose features have names, or an SVG whose shapes have titles or ids. Default:
    False."""

    title: str | None
    """Line over the chart."""

    legend: bool
    """Keys to sizes, colours and marks under the chart. Default: True."""


class ChartRun(RunKeywords, ChartKeywords, total=False):
    """All parameters of :func:`packwork.chart` that are given by name."""


class PileKeywords(
    _FillWordsPhotosPile,
    _FillPhotosPile,
    _Every,
    _FillWordsPile,
    _FillWordsChartPile,
    _FillPile,
    total=False,
):
    """Options of :func:`packwork.pile`."""

    open: (
        Literal["top", "bottom", "left", "right"]
        | Sequence[Literal["top", "bottom", "left", "right"]]
    )
    """Take the lid off on that side (top, bottom, left or right): items come in through it and may
    heap up beyond it, to the canvas' edge. May be given several times."""

    size: str | float | None
    """Longer side of each item, a length as for the padding; with weights, of one of weight 1.
    Default: in the proportions of their files, and so large that all find room and the pile is
    about two thirds high; without a container as large as in their files."""

    emit: str | None
    """Where items come from: top, bottom, left, right (that edge of the canvas), X,Y (a point), X,Y
    X,Y (a line), FILE.svg (a drawn curve) or in NAME (a region: a file or a built-in name).
    Default: each begins at its lowest free place."""

    release: int
    """With --emit: rounds between one item and the next, so that they pour; 0 lets all begin at
    once. Default: 0."""

    compact: bool
    """Report how tight the pile is: shares of its hull, its smallest circle and its box. Default:
    False."""


class PileRun(RunKeywords, PileKeywords, total=False):
    """All parameters of :func:`packwork.pile` that are given by name."""


class SaveKeywords(TypedDict, total=False):
    """Options of drawing a layout."""

    pixels: int
    """Longer side of a PNG or JPEG. Default: 1600."""

    tiles: int
    """Of a tile, draw so many each way side by side, 3 for a preview of 3 x 3: in SVG by a
    <pattern>. Default: 1."""

    dpi: float | None
    """Pixels to the inch of paper: of photos (default 300), and of a PNG or JPEG in place of
    --pixels."""

    background: str | None
    """Any CSS colour, or none. Default: none in SVG and PDF, white in PNG."""

    halo: Literal["none", "faint", "all"]
    """A rim that makes items stand out from the background, in SVG, PNG, JPEG and PDF: faint (of
    those that are hardly to be seen on it) or all. Default: 'none'."""

    show_container: bool | None
    """Draw the container's line. Default: of a pile in a drawing of open lines, as drawn there."""

    flatten: bool
    """In SVG, repeat each drawing in place, for tools that choke on <use>. Default: False."""

    text: Literal["outlines", "live"]
    """Words in SVG and PDF: outlines, or live text that can be selected and found (in SVG in parts
    of their fonts that the file carries, in PDF unseen over the outlines). Default: 'outlines'."""

    cut: Literal["outlines", "silhouette"] | None
    """Lines for a cutter in SVG and PDF (there in the spot colour CutContour) too: outlines, or
    silhouette: one closed line round each item. Default: outlines in DXF only."""

    kiss_cut: str | float | None
    """Cut at this distance round each item, a length such as 2mm, in DXF, SVG and PDF; the padding
    is at least twice that."""

    bleed: str | float | None
    """Let a PDF's background, and art that touches the sheet's edge, reach beyond the sheet on each
    side, a length such as 3mm; its boxes say where it is trimmed."""

    marks: Literal["none", "crop", "all"]
    """Marks beside the sheet of a PDF, in all inks: crop (where it is trimmed) or all (registration
    marks too). Default: 'none'."""

    icc: str | Path | None
    """Profile of a press (ICC, four inks), as a print shop has it: a PDF's colours become its inks,
    black becomes black ink alone, and the file a PDF/X-4."""

    spot: str | Mapping[str, str] | None
    """Spot inks of a PDF, each with the colour that is printed in it, as 'PANTONE 186
    C=#c8102e,Gold=#b58b2a'."""


class FilmKeywords(TypedDict, total=False):
    """Options of films."""

    fps: float
    """Pictures a second of a film. Any number: they are drawn between what was recorded. Default:
    30.0."""

    seconds: float
    """How long the items of a film move. Default: 5.0."""

    hold: float
    """Seconds for which the last picture of a film stays after that. Default: 1.0."""

    loop: Literal["again", "back", "cycle", "once"]
    """again: at its end a film jumps to its beginning; back: items go back the way they came;
    cycle: they glide to where they began, in half the time; once: it stays. In MP4 and WebM the
    player decides whether it begins again. Default: 'again'."""

    easing: Literal["smooth", "linear", "ease-in", "ease-out", "ease-in-out"]
    """smooth: items of a film set off and stop softly; linear: straight from one recorded place to
    the next; ease-in, ease-out, ease-in-out: slow at the beginning, the end or both. Default:
    'smooth'."""

    film_ratio: str
    """Width by height of a film, as 1:1, 4:5, 9:16 or 16:9, the layout in the middle; canvas: that,
    and what sticks out of it in the first picture or when all have arrived. Default: 'canvas'."""

    film_pixels: int
    """Longer side of a film; MP4 and WebM need an even one. Default: 800."""
