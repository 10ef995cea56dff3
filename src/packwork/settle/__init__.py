"""Piles and round packs: items of fixed sizes that go down a potential until they are at rest.

Places one by one (bottom-left, front chain), then compaction with the potential as its objective.
"""
