"""Scenes: checked, frozen stores."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from .errors import expect
from .options import options
from .pictures import fitted
from .tables import Records, records

if TYPE_CHECKING:
    from .store import Store


class Problem(NamedTuple):
    """A problem of a store, or a warning about it (docs/formats/store/errors.md)."""

    code: str
    path: str  #: of the element in the document ("fixtures[3].depth")
    sentence: str


class Scene:
    """A store, checked and frozen: the input of a simulation. Made by `Store.scene`."""

    def __init__(self, core: _core.Scene) -> None:
        self._core = core

    @property
    def name(self) -> str:
        """The title of the store."""
        return self._core.name

    @property
    def hash(self) -> str:
        """Identifies the store in results."""
        return self._core.hash

    @property
    def varies(self) -> bool:
        """Whether the store has a section `variation`."""
        return self._core.varies

    @cached_property
    def labels(self) -> Records:
        """id, type, position (m), normal, requirement (W/m²) of each label."""
        return records(self._core.labels())

    @cached_property
    def units(self) -> Records:
        """id, type, position (m), axis, cost, installed, pinned of each candidate."""
        return records(self._core.units())

    @property
    def warnings(self) -> list[Problem]:
        """Values that a simulation accepts, but that are probably not intended."""
        return [Problem(*one) for one in self._core.warnings]

    @property
    def bounds(self) -> NDArray[np.float64]:
        """The lowest and the highest corner of all surfaces (m), 2 x 3."""
        return np.array(self._core.bounds, dtype=np.float64)

    @property
    def vertices(self) -> NDArray[np.float64]:
        """Corners of the triangles (m), v x 3, without a copy."""
        return self._core.vertices

    @property
    def triangles(self) -> NDArray[np.uint32]:
        """Numbers of the corners of each triangle, t x 3, without a copy."""
        return self._core.triangles

    @property
    def triangle_materials(self) -> NDArray[np.uint32]:
        """The number of the material of each triangle, in `materials`, without a copy."""
        return self._core.triangle_materials

    @property
    def materials(self) -> list[str]:
        """Names of the materials."""
        return self._core.materials

    @property
    def outlines(self) -> list[tuple[str, list[tuple[float, float]], float]]:
        """Id, corners in plan (m) and height (m) of each fixture and inner wall."""
        return self._core.outlines()

    @property
    def room_outline(self) -> list[tuple[float, float]] | None:
        """Corners of the room in plan (m); None without a room."""
        return self._core.room_outline()

    def svg(self, ids: bool = False) -> str:
        """The floor plan."""
        return self._core.svg(ids)

    def glb(self) -> bytes:
        """The 3-D model as binary glTF."""
        return self._core.glb()

    def resolved(self) -> Store:
        """The store without references: labels and candidates are listed, meshes and thresholds inlined."""
        from .store import Store  # noqa: PLC0415: which makes scenes

        return Store.parse(self._core.resolved())

    def state(self, number: int, seed: int = 1, without: Sequence[str] = ()) -> Scene:
        """A state of a changing shop: one draw of its variation, which depends on the store, number and seed only.

        `without`: causes that are left out. `resolved` gives the state as a store.
        """
        expect(number >= 0, "is negative", "state")
        return Scene(self._core.state(options(seed=seed, without=without or None), number))

    def states(self, count: int, first: int = 0, seed: int = 1, without: Sequence[str] = ()) -> Iterator[Scene]:
        """An iterator over states."""
        return (self.state(number, seed, without) for number in range(first, first + count))

    def __reduce__(self) -> Any:
        return _from_text, (self._core.resolved(),)

    def __repr__(self) -> str:
        name = f" {self.name!r}" if self.name else ""
        return (
            f"<Scene{name}: {len(self.labels)} labels, {len(self.units)} candidates, {len(self.triangles)} triangles>"
        )

    def _repr_html_(self) -> str:
        return fitted(self.svg())


def _from_text(text: str) -> Scene:
    """The scene of a pickle."""
    return Scene(_core.Scene.parse(text, "store", ".", False))
