"""Places within a mesh: where there is room between its surfaces."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from .scene import Scene

_LEAST_SPACE = 0.5  # m


class Place(NamedTuple):
    """A point of the plan, and the highest space above it (m)."""

    number: str  #: "column-row"
    x: float
    y: float
    floor: float
    ceiling: float


def grid(low: NDArray[Any], high: NDArray[Any], spacing: float) -> Iterator[tuple[str, float, float]]:
    """The middles of the cells over a rectangle, with their numbers, "column-row"."""
    columns, rows = ([float(x) for x in np.arange(low[k] + spacing / 2, high[k], spacing)] for k in (0, 1))
    for (i, x), (j, y) in itertools.product(enumerate(columns, 1), enumerate(rows, 1)):
        yield f"{i}-{j}", x, y


def covers(outline: Sequence[Sequence[float]], x: float, y: float) -> bool:
    """Whether a point lies within a polygon."""
    inside = False
    for (x0, y0), (x1, y1) in zip(outline, [*outline[1:], outline[0]]):
        if (y0 > y) != (y1 > y) and x < x0 + (y - y0) / (y1 - y0) * (x1 - x0):
            inside = not inside
    return inside


def spaces(scene: Scene, low: NDArray[Any], high: NDArray[Any], spacing: float) -> list[Place]:
    """The middles of the cells over a rectangle above which there is a space of at least half a metre.

    The space inside solids counts if there is none outside, as in a room whose faces look outwards.
    """
    places: dict[bool, list[Place]] = {True: [], False: []}
    corners = scene.vertices[scene.triangles]
    for number, x, y in grid(low, high, spacing):
        height, looks_up = _surfaces_above(corners, x, y)
        is_solid = ~looks_up[:-1] & looks_up[1:]
        for solid in (True, False):
            found = np.flatnonzero((np.diff(height) >= _LEAST_SPACE) & (is_solid == solid))
            if len(found):
                places[solid].append(Place(number, x, y, float(height[found[-1]]), float(height[found[-1] + 1])))
    return places[False] or places[True]


def _surfaces_above(corners: NDArray[Any], x: float, y: float) -> tuple[NDArray[Any], NDArray[Any]]:
    """The heights of the surfaces at a point of the plan, ascending, and whether each looks up."""
    a, b, c = (corners[:, k] for k in range(3))
    u, v, p = b[:, :2] - a[:, :2], c[:, :2] - a[:, :2], np.array([x, y]) - a[:, :2]
    area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        s, t = (p[:, 0] * v[:, 1] - p[:, 1] * v[:, 0]) / area, (u[:, 0] * p[:, 1] - u[:, 1] * p[:, 0]) / area
        height = a[:, 2] + s * (b[:, 2] - a[:, 2]) + t * (c[:, 2] - a[:, 2])
        met = np.flatnonzero((area != 0) & (s >= 0) & (t >= 0) & (s + t <= 1))
    order = met[np.argsort(height[met])]
    return height[order], area[order] > 0
