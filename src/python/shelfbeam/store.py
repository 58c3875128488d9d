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
from .errors import InputError, expect, warn
from .options import Path, options, to_json
from .parts import Emitter, Material, material
from .pictures import fitted
from .places import spaces
from .tables import Records, records

_FILES = ("file", "csv", "picture")
_IN_THE_AIR = ["label_in_mid_air", "label_height", "label_sideways"]  # warnings that do not apply to receivers


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

    def __repr__(self) -> str:
        name = f" {self.name!r}" if self.name else ""
        return (
            f"<Scene{name}: {len(self.labels)} labels, {len(self.units)} candidates, {len(self.triangles)} triangles>"
        )

    def _repr_html_(self) -> str:
        return fitted(self.svg())


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
        self._text, self._parsed = "", ""

    @classmethod
    def read(cls, path: Path, allow_outside: bool = False) -> Store:
        """A store file. Comments in it are lost when the store is saved."""
        file = FilePath(path)
        try:
            text = file.read_text(encoding="utf-8-sig")
        except OSError as error:
            raise InputError(f"{file}: cannot be read: {error.strerror}", 2, str(file)) from None
        except UnicodeDecodeError:
            raise InputError(f"{file}: is not UTF-8", 2, str(file)) from None
        return cls.parse(text, file.parent, str(file), allow_outside)

    @classmethod
    def parse(cls, text: str, folder: Path = ".", name: str = "store", allow_outside: bool = False) -> Store:
        """The text of a store file; files that it names are relative to `folder`."""
        document = json.loads(_core.plain_json(text, name))
        store = cls({}, folder, name, allow_outside)
        store.document = document
        store._text, store._parsed = text, to_json(document)
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
        if self._text and to_json(self.document) == self._parsed:
            return self._text
        return to_json(self.document, 2) + "\n"

    def problems(self) -> list[Problem]:
        """All problems of the document; an empty list if `scene` accepts it."""
        found = _core.problems_of(self.text(), self.name, self.folder, self.allow_outside)
        return [Problem(*one) for one in found]

    def scene(self) -> Scene:
        """Checks the document and freezes it. Raises InputError, which names the place."""
        scene = Scene(_core.Scene.parse(self.text(), self.name, self.folder, self.allow_outside))
        if scene.warnings:
            others = len(scene.warnings) - 1
            warn(scene.warnings[0].sentence + (f" (Scene.warnings has {others} more)" if others else ""))
        return scene

    def save(self, path: Path) -> None:
        """Writes the store file. Names of files become relative to its folder."""
        file = FilePath(path)
        document = _with_files(self.document, lambda name: os.path.relpath(self.folder / name, file.parent))
        _core.write_text(to_json(document, 2) + "\n", file)

    def copy(self) -> Store:
        """A store to edit; this one stays."""
        return Store(self.document, self.folder, self.name, self.allow_outside)

    def bounds(self) -> NDArray[np.float64]:
        """The lowest and the highest corner of all surfaces (m), 2 x 3. Labels and candidates may be missing."""
        return self._surfaces().bounds

    def add_emitter(self, emitter: Emitter) -> str:
        """Adds a transceiver type, and returns its name."""
        self._add("transceiver_types", emitter.name, emitter.keys)
        return emitter.name

    def add_receivers(self, id: str, plane: float, spacing: float, threshold: float,
                      responsivity: Mapping[str, Any] | None = None, margin: float = 0,
                      area: Sequence[Sequence[float]] | None = None) -> None:  # fmt: skip
        """Adds receivers that face upwards, on a grid at the height `plane` (m).

        `threshold` is their requirement (W/m²), `area` the two corners of a rectangle; default: the bounds of all
        surfaces. `margin` (m) is left out all around. In a store without a room, such as one from a mesh, places within
        furniture are left out, too.
        """
        self._add(
            "label_types", id, {"threshold": threshold, **({"responsivity": responsivity} if responsivity else {})}
        )
        low, high = np.asarray(area, dtype=float) if area is not None else self.bounds()[:, :2]
        low, size = low + margin, high - low - 2 * margin
        if "room" not in self.document:
            kind: dict[str, Any] = {"normal": [0, 0, 1], "type": id, "ignore": _IN_THE_AIR}
            self.document.setdefault("labels", []).extend(
                {"id": f"{id}-{place}", "position": [x, y, plane], **kind}
                for place, x, y, floor, ceiling in spaces(self._surfaces(), low, low + size, spacing)
                if floor < plane < ceiling
            )
            return
        grid = {"origin": [*low, plane], "axes": [[1, 0, 0], [0, 1, 0]], "size": size, "spacing": spacing}
        self.document.setdefault("measuring_planes", []).append({"id": id, "type": id, **_plain(grid)})

    def add_candidates(self, emitters: Emitter | Sequence[Emitter], spacing: float,
                       area: str | Sequence[Sequence[float]] = "room", below_ceiling: float | None = None,
                       z: float | None = None, axes: Sequence[Sequence[float]] = ((0, 0, -1),)) -> None:  # fmt: skip
        """Adds candidates on a grid over an area: "room", the id of a zone, or a polygon.

        Give their height by `z` or `below_ceiling` (m). Several emitters or axes at one point exclude one another. In a
        store without a room, such as one from a mesh, the area must be "room": the bounds of all surfaces. There, the
        ceiling is the upper end of the highest space of at least half a metre, and points without one are left out.
        """
        expect((z is None) != (below_ceiling is None), "excludes below_ceiling: give one of them", "z")
        has_room = "room" in self.document
        expect(has_room or isinstance(area, str) and area == "room", 'must be "room" in a store without a room', "area")
        points: list[tuple[str, list[float]]] = []
        if not has_room:
            scene = self._surfaces()
            low, high = scene.bounds[:, :2]
            for place, x, y, _, ceiling in spaces(scene, low, high, spacing):
                points.append((place, [x, y, ceiling - (below_ceiling or 0) if z is None else z]))
        units = self.document.setdefault("transceivers", {})
        for emitter in [emitters] if isinstance(emitters, Emitter) else emitters:
            name = self.add_emitter(emitter)
            if has_room:
                members: dict[str, Any] = {"type": name, "area": area, "spacing": spacing, "axes": axes}
                members["z" if z is not None else "below_ceiling"] = z if z is not None else below_ceiling
                units.setdefault("areas", []).append(_plain(members))
            for number, axis in enumerate(axes if points else ()):
                aim = f"/a{number + 1}" if len(axes) > 1 else ""
                units.setdefault("list", []).extend(
                    {"id": f"{name}-{place}{aim}", "position": position, "axis": list(axis), "type": name}
                    for place, position in points
                )

    def with_people(self, number: float, size: Sequence[float] = (0.5, 0.3, 1.75),
                    reflectance: Material = "dyed_textile") -> Store:  # fmt: skip
        """A copy in which people (Poisson, `number` on average) walk through the room in every state."""
        store = self.copy()
        store._add("materials", "people", material(reflectance))
        area: Any = "room"
        if "room" not in store.document:
            (x0, y0), (x1, y1) = self.bounds()[:, :2].tolist()
            area = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
        people = {"area": area, "number": {"poisson": number}, "size": list(size), "material": "people"}
        store.document.setdefault("variation", {}).setdefault("people", []).append(people)
        return store

    def _add(self, section: str, name: str, keys: Mapping[str, Any]) -> None:
        """Adds a named member; the same member may be there already."""
        members = self.document.setdefault(section, {})
        member = copy.deepcopy(dict(keys))
        taken = name in members and to_json(members[name]) != to_json(member)
        expect(not taken, f"{section} has another member {name!r}: use another name", "name")
        members[name] = member

    def _surfaces(self) -> Scene:
        """The scene with a label and a unit in place of those of the document."""
        probe = self.copy()
        for section in ("planogram", "measuring_planes", "variation"):
            probe.document.pop(section, None)
        for fixture in probe.document.get("fixtures", []):
            fixture.pop("labels", None)
        low: dict[str, Any] = {"position": [0, 0, 0.5], "type": "probe"}
        probe.document["label_types"] = {"probe": {"threshold": 1}}
        probe.document["transceiver_types"] = {"probe": Emitter.lambertian(1).keys}
        probe.document["labels"] = [{"id": "probe", "normal": [0, 0, 1], **low}]
        probe.document["transceivers"] = {"list": [{"id": "probe", **low}]}
        return Scene(_core.Scene.parse(probe.text(), self.name, self.folder, self.allow_outside))

    def __repr__(self) -> str:
        title = self.document.get("name") or self.name
        return f"<Store {title!r}: {', '.join(self.document)}>"

    def _repr_html_(self) -> str:
        return fitted(self.scene().svg())


def scene_of(shop: Store | Scene | Path) -> Scene:
    """The scene of a store, or of a store file."""
    if isinstance(shop, Scene):
        return shop
    return (shop if isinstance(shop, Store) else Store.read(shop)).scene()


def name_of(shop: Store | Scene | Path) -> str:
    """The name of a store in messages."""
    if isinstance(shop, Scene):
        return "store"
    return shop.name if isinstance(shop, Store) else os.fspath(shop)


def _plain(members: Mapping[str, Any]) -> Any:
    """Without NumPy values."""
    return json.loads(to_json(members))


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
