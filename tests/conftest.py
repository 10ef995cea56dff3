"""What all tests share: how hypothesis searches, and a seeded generator."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

# Kernels compile on their first call, and run uncompiled under NUMBA_DISABLE_JIT=1: no
# example may fail for being slow. Search wider with `--hypothesis-profile=explore`.
_PATIENT = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("check", _PATIENT, max_examples=40, derandomize=True)
settings.register_profile("explore", _PATIENT, max_examples=2_000)
settings.load_profile("check")


@pytest.fixture
def rng() -> np.random.Generator:
    """Generator with a fixed seed, new for each test."""
    return np.random.default_rng(20_250_711)
