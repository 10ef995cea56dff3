"""Files of the package: `icons/` to place, `containers/` to fill, `fonts/` to write in.

The drawings are our own but for the outlines of countries, which are from maps in the public
domain; the font has a licence of its own (see `LICENCE.txt`). A file's stem is the picture's
name. Icons are drawn on a square of 100 units in one palette of eight colours; some are stroked
lines, some have holes. A container is one filled path on a canvas of its own shape; `ring`,
`dragon`, `guitar` and `snake` have holes, `islands` and `australia` several parts. Ids inside the
icons begin with the icon's name, so that any of them can stand in one document.
"""
