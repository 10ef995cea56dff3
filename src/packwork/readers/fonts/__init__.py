"""Fonts: files are checked, words shaped, glyphs made curves and regions; fallback among fonts."""
