"""What a print shop asks of a PDF: boxes, marks, bleed, inks, PDF/X-4."""
