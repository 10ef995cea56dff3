"""Compaction and separation of polygons in exact geometry, shared by the stages finish and settle.

Separation takes polygons that overlap apart; compaction moves polygons that do not overlap by
linear programmes over their contacts until an objective gets no better. After Z. Li and V.
Milenkovic, "Compaction and separation algorithms for non-convex polygons and their applications",
European Journal of Operational Research 84 (1995), 539-561, doi:10.1016/0377-2217(95)00021-H.

To be read in this order: ``arrangement`` (polygons in place), ``separate``, ``compact`` (blocks of
neighbours), ``objective``; then the kernels ``contacts`` (constraints), ``interior_point`` (solves
the programme), ``steps`` (what is moved, and its exact check), ``trials``.
"""
