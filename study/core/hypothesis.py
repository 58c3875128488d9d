"""A statistical test on pairs of estimates."""

import math
from dataclasses import dataclass

import numpy as np
from scipy.stats import norm, t as student


@dataclass(frozen=True)
class PairTest:
    """The result of testing whether both estimates of each pair have the same mean."""

    z: np.ndarray
    largest: float
    limit: float  # the largest accepted value of `largest`
    mean_square: float
    expected_square: float
    spread_z: float  # the mean square minus its expectation, in standard deviations
    spread_limit: float
    beyond: float  # share of |z| above 1.96
    passes: bool


def pair_test(a, b, error_a, error_b, freedom, level=0.01):
    """Two z-tests at `level` / 2 each: of the largest |z| (Sidak), and of the mean square.

    All estimates must be independent. `freedom` are the degrees of freedom of one standard error. The difference has
    more, so both tests are conservative. Pairs without a hit on either side are omitted.
    """
    a, b, error = np.ravel(a), np.ravel(b), np.hypot(np.ravel(error_a), np.ravel(error_b))
    known = error > 0
    z = (a[known] - b[known]) / error[known]
    if len(z) == 0 or freedom <= 4:
        raise ValueError("the test needs pairs with an error, from more than five batches")
    tail = -math.expm1(math.log1p(-level / 2) / len(z))
    limit = float(student.isf(tail / 2, freedom))
    expected = freedom / (freedom - 2)
    fourth = 3 * freedom**2 / ((freedom - 2) * (freedom - 4))
    spread_z = float((np.mean(z**2) - expected) / math.sqrt((fourth - expected**2) / len(z)))
    spread_limit = float(norm.isf(level / 2))
    largest = float(np.abs(z).max())
    return PairTest(
        z,
        largest,
        limit,
        float(np.mean(z**2)),
        expected,
        spread_z,
        spread_limit,
        float(np.mean(np.abs(z) > 1.96)),
        largest <= limit and spread_z <= spread_limit,
    )
