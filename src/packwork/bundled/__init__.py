"""Pictures that travel with the package: `icons/` to place and `containers/` to fill.

All are our own drawings (see `LICENCE.txt`). A file's stem is the picture's name. Icons are drawn
on a square of 100 units in one palette of eight colours; some are stroked lines, some have holes.
A container is one filled path on a canvas of its own shape; `ring`, `dragon`, `guitar` and
`snake` have holes, `islands` has several parts. Ids inside the icons begin with the icon's name,
so that any of them can stand in one document.
"""
