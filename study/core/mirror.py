"""The mirror symmetry of the environment: x to 20 - x. (The low freezer breaks the symmetry from front to back.)"""

import numpy as np
from scipy.optimize import linear_sum_assignment


def partners(points, normals, axis):
    """The index of every point's mirror image about x = axis; ValueError if a point has none."""

    def key(point, normal):
        return tuple(np.round([*point, *normal], 6) + 0.0)

    where = {key(point, normal): k for k, (point, normal) in enumerate(zip(points, normals))}
    flip = np.array([-1.0, 1.0, 1.0])
    try:
        return np.array(
            [where[key(flip * point + [2 * axis, 0, 0], flip * normal)] for point, normal in zip(points, normals)]
        )
    except KeyError as error:
        raise ValueError(f"{error} has no mirror image") from error


class Mirror:
    """Pairs of opposite labels and of opposite candidates."""

    def __init__(self, signals, width):
        self.labels = partners(signals.labels, signals.normals, width / 2)
        self.units = partners(signals.units, np.zeros_like(signals.units), width / 2)

    @property
    def left_labels(self):
        """One label of every pair, without labels on the axis, which are their own partners."""
        return np.flatnonzero(np.arange(len(self.labels)) < self.labels)


def distance_to_mirror_image(units, width):
    """The mean horizontal distance, m, of a placement (k x 3) from its mirror image in the best pairing."""
    own = units[:, :2]
    images = own * [-1.0, 1.0] + [width, 0]
    apart = np.hypot(*(own[:, None, :] - images[None, :, :]).transpose(2, 0, 1))
    return float(apart[linear_sum_assignment(apart)].mean())
