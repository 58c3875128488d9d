"""The mirror symmetry of the environment: x to 20 - x. (From front to back it has none: the freezer is low.)"""

import numpy as np
from scipy.optimize import linear_sum_assignment


def partners(points, normals, axis):
    """For every point the index of its mirror image about x = axis; ValueError where one has none."""

    def key(point, normal):
        return tuple(np.round([*point, *normal], 6) + 0.0)

    where = {key(point, normal): k for k, (point, normal) in enumerate(zip(points, normals))}
    flip = np.array([-1.0, 1.0, 1.0])
    try:
        return np.array(
            [
                where[key(flip * point + [2 * axis, 0, 0], flip * normal)]
                for point, normal in zip(points, normals)
            ]
        )
    except KeyError as error:
        raise ValueError(f"nothing is opposite of {error}") from error


class Mirror:
    """Which label and which candidate lie opposite which."""

    def __init__(self, signals, width):
        self.labels = partners(signals.labels, signals.normals, width / 2)
        self.units = partners(signals.units, np.zeros_like(signals.units), width / 2)

    @property
    def left_labels(self):
        """One label of every pair; those on the axis are their own partners and left out."""
        return np.flatnonzero(np.arange(len(self.labels)) < self.labels)


def distance_to_mirror_image(units, width):
    """How far a placement (k x 3) is from its own mirror image: mean distance, m, of the best pairing in plan."""
    own = units[:, :2]
    images = own * [-1.0, 1.0] + [width, 0]
    apart = np.hypot(*(own[:, None, :] - images[None, :, :]).transpose(2, 0, 1))
    return float(apart[linear_sum_assignment(apart)].mean())
