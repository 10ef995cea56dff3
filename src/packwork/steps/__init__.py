"""Steps of a run, one a class: places, levels, exact finish, voids, measures, looks.

Which of them a run takes, and in which order, is a list that its use makes
(:mod:`packwork.uses`).
"""
