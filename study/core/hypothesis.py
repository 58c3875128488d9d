"""Tests of hypotheses with plain arithmetic: what the figures of a finding rest on."""

import math
from dataclasses import dataclass

import numpy as np


def _beta_fraction(a, b, x):
    """Continued fraction of the incomplete beta function (Lentz)."""
    tiny = 1e-300
    c, d = 1.0, 1 - (a + b) * x / (a + 1)
    d = 1 / (d if abs(d) > tiny else tiny)
    result = d
    for m in range(1, 400):
        for numerator in (
            m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
            -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1)),
        ):
            d = 1 + numerator * d
            d = 1 / (d if abs(d) > tiny else tiny)
            c = 1 + numerator / c
            c = c if abs(c) > tiny else tiny
            result *= c * d
        if abs(c * d - 1) < 1e-14:
            break
    return result


def incomplete_beta(a, b, x):
    """The regularised incomplete beta function I_x(a, b)."""
    if x <= 0 or x >= 1:
        return float(x >= 1)
    front = math.exp(
        math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) + b * math.log1p(-x)
    )
    if x < (a + 1) / (a + b + 2):
        return front * _beta_fraction(a, b, x) / a
    return 1 - front * _beta_fraction(b, a, 1 - x) / b


def student_tail(t, freedom):
    """The probability that |T| exceeds t, of Student's distribution."""
    return incomplete_beta(freedom / 2, 0.5, freedom / (freedom + t * t))


def student_limit(tail, freedom):
    """The t that |T| exceeds with probability `tail`."""
    low, high = 0.0, 1e6
    for _ in range(200):
        middle = (low + high) / 2
        if student_tail(middle, freedom) > tail:
            low = middle
        else:
            high = middle
    return high


def normal_tail(z):
    """The probability that a standard normal number exceeds z."""
    return math.erfc(z / math.sqrt(2)) / 2


@dataclass(frozen=True)
class PairTest:
    """What pairs of estimates say to the claim that both of each pair estimate the same number."""

    z: np.ndarray
    largest: float
    limit: float  # what `largest` may be
    mean_square: float
    expected_square: float
    spread_z: float  # how far the mean square lies above what is expected, in its standard deviations
    spread_limit: float
    beyond: float  # share of |z| above 1.96
    passes: bool


def pair_test(a, b, error_a, error_b, freedom, level=0.01):
    """Two z-tests at `level` / 2 each: of the largest |z| (Sidak), and of the mean square.

    The pairs must be independent of each other and of one another's halves; `freedom` is that of one standard
    error, so both tests rather pass too often (that of a difference has more). Pairs that were never hit on
    either side say nothing and are left out.
    """
    a, b, error = np.ravel(a), np.ravel(b), np.hypot(np.ravel(error_a), np.ravel(error_b))
    known = error > 0
    z = (a[known] - b[known]) / error[known]
    if len(z) == 0 or freedom <= 4:
        raise ValueError("the test needs pairs with an error, from more than five batches")
    tail = -math.expm1(math.log1p(-level / 2) / len(z))
    limit = student_limit(tail, freedom)
    expected = freedom / (freedom - 2)
    fourth = 3 * freedom**2 / ((freedom - 2) * (freedom - 4))
    spread_z = float((np.mean(z**2) - expected) / math.sqrt((fourth - expected**2) / len(z)))
    spread_limit = next(k / 1000 for k in range(10000) if normal_tail(k / 1000) <= level / 2)
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


def rank_correlation(a, b):
    """Spearman's, for values without ties to speak of."""
    ranks = [np.argsort(np.argsort(values)) for values in (a, b)]
    return float(np.corrcoef(*ranks)[0, 1])
