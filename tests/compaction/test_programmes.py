import numpy as np

from packwork.compaction.compact import in_twos
from packwork.compaction.kernels import interior_point


def test_programmes_in_twos_have_the_same_best_value() -> None:
    rng = np.random.default_rng(0)
    n, m = 6, 40
    first, second = rng.integers(n, size=m), rng.integers(-1, n, size=m)
    second[second == first] = -1
    coefficients = rng.normal(size=(m, 8))
    coefficients[second < 0, 4:] = 0.0
    limits = rng.uniform(0.1, 1.0, m)
    gain, high = rng.normal(size=(n, 4)), np.ones((n, 4))
    high[:, 2:] = gain[:, 2:] = 0.0
    rows = interior_point.Rows(first, second, coefficients, limits)
    whole = interior_point.maximise(rows, gain.ravel(), -high.ravel(), high.ravel(), 1e-6)
    moves = [np.ascontiguousarray(one[:, :2]).ravel() for one in (gain, -high, high)]
    half = interior_point.maximise(in_twos(rows), *moves, 1e-6)
    own = gain.ravel() @ whole
    assert abs(moves[0] @ half - own) < 1e-4 * own
