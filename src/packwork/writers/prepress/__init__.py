"""Parts of a PDF that a print shop asks for: boxes, marks, bleed, inks, PDF/X-4."""
