"""Stores as documents that can be edited, and as frozen scenes."""

from __future__ import annotations

import copy
import json
import os
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path as FilePath
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from .errors import InputError
from .options import Path
from .parts import Emitter, Material, material
from .tables import Records, records

_FILES = ("file", "csv", "picture")


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
        """Values that a simulation accepts, but that are hardly intended."""
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
        return Store.parse(self._core.resolved())

    def state(self, number: int, seed: int = 1) -> Store:
        """A state of a changing shop: one draw of its variation, which depends on the store, number and seed only."""
        return Store.parse(self._core.state(seed, number))

    def states(self, count: int, first: int = 0, seed: int = 1) -> Iterator[Store]:
        """States one after another, as stores."""
        return (self.state(number, seed) for number in range(first, first + count))

    def __repr__(self) -> str:
        name = f" {self.name!r}" if self.name else ""
        return (
            f"<Scene{name}: {len(self.labels)} labels, {len(self.units)} candidates, {len(self.triangles)} triangles>"
        )

    def _repr_html_(self) -> str:
        return self.svg()


class Store:
    """The document of a store file (docs/formats/store.md), with the folder of the files that it names.

    `document` is a dict to edit; nothing is checked before `problems`, `scene`, or a function that needs the scene.
    """

    def __init__(self, document: Mapping[str, Any], folder: Path = ".", name: str = "store",
                 allow_outside: bool = False) -> None:  # fmt: skip
        self.document: dict[str, Any] = copy.deepcopy(dict(document))
        self.folder = FilePath(folder)
        self.name = name
        self.allow_outside = allow_outside
        # A text that was read, and its document: it gives errors their lines, until the document is edited.
        self._text: str | None = None
        self._parsed: Any = None

    @classmethod
    def read(cls, path: Path, allow_outside: bool = False) -> Store:
        """A store file. Comments in it are lost when the store is saved."""
        file = FilePath(path)
        try:
            text = file.read_text(encoding="utf-8-sig")
        except OSError as error:
            raise InputError(f"{file}: cannot be read: {error.strerror}", 2, str(file)) from None
        return cls.parse(text, file.parent, str(file), allow_outside)

    @classmethod
    def parse(cls, text: str, folder: Path = ".", name: str = "store", allow_outside: bool = False) -> Store:
        """The text of a store file; files that it names are relative to `folder`."""
        document = json.loads(_core.plain_json(text, name))
        store = cls({}, folder, name, allow_outside)
        store.document = document
        store._text, store._parsed = text, copy.deepcopy(document)
        return store

    @classmethod
    def from_mesh(cls, path: Path, materials: Mapping[str, Material], scale: float = 1, up: str | None = None,
                  at: Sequence[float] = (0, 0, 0), name: str = "") -> Store:  # fmt: skip
        """A glTF, OBJ, STL or PLY file as the only surfaces.

        `materials`: pattern of material names in the file -> reflectance, name of a material, or its keys. Add
        receivers and candidates afterwards.
        """
        file = FilePath(path)
        fixture: dict[str, Any] = {"type": "mesh", "id": file.stem, "at": list(at), "file": file.name}
        fixture["materials"] = {pattern: pattern for pattern in materials}
        if scale != 1:
            fixture["scale"] = scale
        if up is not None:
            fixture["up"] = up
        return cls(
            {
                "name": name or file.stem,
                "materials": {pattern: material(value) for pattern, value in materials.items()},
                "label_types": {},
                "transceiver_types": {},
                "fixtures": [fixture],
                "transceivers": {},
            },
            file.parent,
            allow_outside=True,
        )

    def text(self) -> str:
        """The document as JSON."""
        if self._text is not None and self.document == self._parsed:
            return self._text
        return json.dumps(self.document, ensure_ascii=False, indent=2) + "\n"

    def problems(self) -> list[Problem]:
        """All problems of the document; an empty list if `scene` accepts it."""
        found = _core.problems_of(self.text(), self.name, self.folder, self.allow_outside)
        return [Problem(*one) for one in found]

    def scene(self) -> Scene:
        """Checks the document and freezes it. Raises InputError, which names the place."""
        return Scene(_core.Scene.parse(self.text(), self.name, self.folder, self.allow_outside))

    def save(self, path: Path) -> None:
        """Writes the store file. Names of files become relative to its folder."""
        file = FilePath(path)
        document = _with_files(self.document, lambda name: os.path.relpath(self.folder / name, file.parent))
        text = json.dumps(document, ensure_ascii=False, indent=2) + "\n"
        _core.write_text(text, file)

    def copy(self) -> Store:
        """A store to edit; this one stays."""
        return Store(self.document, self.folder, self.name, self.allow_outside)

    def bounds(self) -> NDArray[np.float64]:
        """The lowest and the highest corner of all surfaces (m), 2 x 3. Labels and candidates may be missing."""
        probe = self.copy()
        probe.document["label_types"] = {"probe": {"threshold": 1}}
        probe.document["transceiver_types"] = {"probe": Emitter.lambertian(1).keys}
        middle = {"position": [0, 0, 0.5], "type": "probe"}
        for section in ("planogram", "measuring_planes", "variation"):
            probe.document.pop(section, None)
        probe.document["labels"] = [{"id": "probe", "normal": [0, 0, 1], **middle}]
        probe.document["transceivers"] = {"list": [{"id": "probe", **middle}]}
        for fixture in probe.document.get("fixtures", []):
            fixture.pop("labels", None)
        return probe.scene().bounds

    def add_emitter(self, emitter: Emitter) -> str:
        """Adds a transceiver type, and returns its name."""
        self.document.setdefault("transceiver_types", {})[emitter.name] = copy.deepcopy(dict(emitter.keys))
        return emitter.name

    def add_receivers(self, id: str, plane: float, spacing: float, threshold: float,
                      responsivity: Mapping[str, Any] | None = None, margin: float = 0,
                      area: Sequence[Sequence[float]] | None = None) -> None:  # fmt: skip
        """Adds receivers that face upwards, on a grid at the height `plane` (m): a measuring plane.

        `threshold` is their requirement (W/m²), `area` the two corners of a rectangle; default: the bounds of all
        surfaces. `margin` (m) is left out all around.
        """
        kind: dict[str, Any] = {"threshold": threshold}
        if responsivity is not None:
            kind["responsivity"] = dict(responsivity)
        self.document.setdefault("label_types", {})[id] = kind
        low, high = np.asarray(area, dtype=float) if area is not None else self.bounds()[:, :2]
        low, size = low + margin, high - low - 2 * margin
        self.document.setdefault("measuring_planes", []).append(
            {
                "id": id,
                "type": id,
                "origin": [float(low[0]), float(low[1]), plane],
                "axes": [[1, 0, 0], [0, 1, 0]],
                "size": [float(size[0]), float(size[1])],
                "spacing": spacing,
            }
        )

    def add_candidates(self, emitters: Emitter | Sequence[Emitter], spacing: float,
                       area: str | Sequence[Sequence[float]] = "room", below_ceiling: float | None = None,
                       z: float | None = None,
                       axes: Sequence[Sequence[float]] = ((0, 0, -1),)) -> None:  # fmt: skip
        """Adds candidates on a grid over an area: "room", the id of a zone, or a polygon.

        Give their height by `z` or `below_ceiling` (m). Several emitters or axes at one point exclude one another. A
        store without a room, such as one from a mesh, has the bounds of its surfaces as its room.
        """
        units = self.document.setdefault("transceivers", {})
        for emitter in [emitters] if isinstance(emitters, Emitter) else emitters:
            common: dict[str, Any] = {"type": self.add_emitter(emitter), "spacing": spacing}
            if "room" in self.document or not isinstance(area, str):
                common["area"] = area if isinstance(area, str) else [list(corner) for corner in area]
                common["axes"] = [list(axis) for axis in axes]
                if z is not None:
                    common["z"] = z
                else:
                    common["below_ceiling"] = below_ceiling
                units.setdefault("areas", []).append(common)
                continue
            low, high = self.bounds()
            level = z if z is not None else high[2] - (below_ceiling or 0)
            for axis in axes:
                grid: dict[str, Any] = {"axis": list(axis), "z": float(level)}
                grid["min"], grid["max"] = (low[:2] + spacing / 2).tolist(), (high[:2] - spacing / 2).tolist()
                units.setdefault("grids", []).append({**common, **grid})

    def with_people(self, number: float, size: Sequence[float] = (0.5, 0.3, 1.75),
                    reflectance: Material = "dyed_textile") -> Store:  # fmt: skip
        """A copy in which people (Poisson, `number` on average) walk through the room in every state."""
        store = self.copy()
        store.document["materials"]["people"] = material(reflectance)
        area: Any = "room"
        if "room" not in store.document:
            (x0, y0), (x1, y1) = self.bounds()[:, :2].tolist()
            area = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
        people = {"area": area, "number": {"poisson": number}, "size": list(size), "material": "people"}
        store.document.setdefault("variation", {}).setdefault("people", []).append(people)
        return store

    def __repr__(self) -> str:
        title = self.document.get("name") or self.name
        return f"<Store {title!r}: {', '.join(self.document)}>"

    def _repr_html_(self) -> str:
        return self.scene().svg()


def scene_of(shop: Store | Scene | Path) -> Scene:
    """The scene of a store, or of a store file."""
    if isinstance(shop, Scene):
        return shop
    return (shop if isinstance(shop, Store) else Store.read(shop)).scene()


def _with_files(part: Any, rename: Any) -> Any:
    """A copy of a document with other names of files."""
    if isinstance(part, list):
        return [_with_files(one, rename) for one in part]
    if not isinstance(part, dict):
        return part
    renamed = {}
    for key, value in part.items():
        if key in _FILES and isinstance(value, str) and not value.startswith("data:"):
            value = rename(value)
        elif key == "catalogues" and isinstance(value, list):
            value = [rename(one) for one in value]
        renamed[key] = _with_files(value, rename)
    return renamed
