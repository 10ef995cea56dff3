"""Texts and tables to words with weights, and words to items."""
