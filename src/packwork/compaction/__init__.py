"""Compaction and separation of polygons in exact geometry, shared by the stages finish and settle.

Compaction moves polygons that do not overlap by linear programmes over their contacts until an
objective gets no better; separation takes those apart that do overlap. After Z. Li and
V. Milenkovic, "Compaction and separation algorithms for non-convex polygons and their
applications", European Journal of Operational Research 84 (1995), 539-561,
doi:10.1016/0377-2217(95)00021-H.
"""
