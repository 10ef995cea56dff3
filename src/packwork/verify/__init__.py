"""Files held against what was measured, by their text and as they are painted."""

from packwork.verify.paint import PAINTED_BYTES, PaintedPixels, painted_pixels
from packwork.verify.text import UNREADABLE, faults_in_file, on_trust_in_file

__all__ = [
    "PAINTED_BYTES",
    "UNREADABLE",
    "PaintedPixels",
    "faults_in_file",
    "on_trust_in_file",
    "painted_pixels",
]
