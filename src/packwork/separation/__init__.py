"""Separation of parts that may not grow: overlap is allowed on the way and priced ever higher.

Guided local search in the manner of Umetani and Imamichi, and of sparrow (Gardeyn and Vanden
Berghe, arXiv 2509.13329); places are proposed by an image of all other parts.
"""
