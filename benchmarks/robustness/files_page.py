"""The page docs/benchmarks/files.md; what measures needs more than the page does."""

from __future__ import annotations

PAGE = """# Drawings from anywhere

Made by `packwork bench files FOLDER... {settings}` on {date}, each folder what `npm pack NAME` of
one public collection holds, unpacked.
{machine}.

A file is read as `packwork fill` reads it, then its ink is compared with resvg's rendering of
the file as the gate let it in, both 1,000 px long: intersection over union, of files that
show anything. "Traced" were those that use what shapes do not tell, "disagreed" those whose
shapes agreed less with the picture than a trace does. Seconds are the processor's.

{drawings}

What is empty: symbols without a `use`, fonts, lines without a stroke. resvg shows nothing of
them either. [How it is done and what else was
tried](../decisions/0008-drawings-compared-with-their-rendering.md).

# Files as they come out

{outputs}

The crowd is twenty icons of those collections, a thousand copies in a circle. The browser is
Chromium, headless; without one that row says so. Compared is the coverage of pixels, soft edges
and all, which two renderers draw a little differently. The sheet holds twenty bundled icons.
PDFium reads the PDF back, its curves followed finer than those that were measured, which is most
of that difference. The words are those of the gallery's clouds, `--text live`, within 20 degrees,
in a circle, and 3,200 px too.
"""
