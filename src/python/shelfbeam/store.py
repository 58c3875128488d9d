"""Stores as documents that can be edited."""

from __future__ import annotations

import copy
import html
import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path as FilePath
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from .errors import InputError, expect, warn
from .options import Path, to_json
from .parts import Emitter, Material, material
from .pictures import fitted
from .places import covers, grid, spaces
from .scene import Problem, Scene

_FILES = ("file", "csv", "picture")
_IN_THE_AIR = ["label_in_mid_air", "label_height", "label_sideways"]  # warnings that do not apply to receivers


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
        expect(isinstance(document, dict), f"{name} is not an object of JSON", "store")
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
        """The lowest and the highest corner of the room or, without one, of all surfaces (m), 2 x 3.

        Labels and candidates may be missing.
        """
        self._expect_metres()
        room = self.document.get("room")
        if room is None:
            return self._surfaces().bounds
        corners = np.array(room["outline"] if "outline" in room else [[0, 0], room["size"][:2]], dtype=np.float64)
        height = room["height"] if "outline" in room else room["size"][2]
        tops = [point[2] for point in height] if isinstance(height, list) else [height]
        return np.array([[*corners.min(axis=0), 0], [*corners.max(axis=0), max(tops)]])

    def add_emitter(self, emitter: Emitter) -> str:
        """Adds a transceiver type, and returns its name."""
        self._add("transceiver_types", emitter.name, emitter.keys)
        return emitter.name

    def add_receivers(self, id: str, plane: float, spacing: float, threshold: float,
                      responsivity: Mapping[str, Any] | None = None, margin: float = 0,
                      area: Sequence[Sequence[float]] | None = None) -> None:  # fmt: skip
        """Adds receivers that face upwards, on a grid at the height `plane` (m).

        `threshold` is their requirement (W/m²), `area` the two corners of a rectangle; default: the bounds of all
        surfaces. `margin` (m) is left out all around. In a room with an outline, places beyond it are left out; in a
        store without a room, such as one from a mesh, places within furniture.
        """
        self._expect_metres()
        expect(spacing > 0, "is not above 0", "spacing")
        self._add(
            "label_types", id, {"threshold": threshold, **({"responsivity": responsivity} if responsivity else {})}
        )
        room = self.document.get("room")
        surfaces = self._surfaces() if room is None else None
        bounds = surfaces.bounds if surfaces is not None else self.bounds()
        low, high = np.asarray(area, dtype=float) if area is not None else bounds[:, :2]
        low, size = low + margin, high - low - 2 * margin
        if room is None or "outline" in room:
            labels = self.document.setdefault("labels", [])
            expect(isinstance(labels, list), "come from a CSV file: list them to add others", "labels")
            expect(not any(label["id"].startswith(f"{id}-") for label in labels), f"{id!r} is taken", "id")
            kind: dict[str, Any] = {"normal": [0, 0, 1], "type": id, "ignore": _IN_THE_AIR}
            if surfaces is not None:
                found = spaces(surfaces, low, low + size, spacing)
                places = [(place, x, y) for place, x, y, floor, ceiling in found if floor < plane < ceiling]
            else:
                places = [
                    one for one in grid(low, low + size, spacing) if covers(self.document["room"]["outline"], *one[1:])
                ]
            labels.extend({"id": f"{id}-{place}", "position": [x, y, plane], **kind} for place, x, y in places)
            return
        cells = {"origin": [*low, plane], "axes": [[1, 0, 0], [0, 1, 0]], "size": size, "spacing": spacing}
        self.document.setdefault("measuring_planes", []).append({"id": id, "type": id, **_plain(cells)})

    def add_candidates(self, emitters: Emitter | Sequence[Emitter], spacing: float,
                       area: str | Sequence[Sequence[float]] = "room", below_ceiling: float | None = None,
                       z: float | None = None, axes: Sequence[Sequence[float]] = ((0, 0, -1),)) -> None:  # fmt: skip
        """Adds candidates on a grid over an area: "room", the id of a zone, or a polygon.

        Give their height by `z` or `below_ceiling` (m). Several emitters or axes at one point exclude one another. In a
        store without a room, such as one from a mesh, the area must be "room": the bounds of all surfaces. There, the
        ceiling is the upper end of the highest space of at least half a metre, and points without one are left out.
        """
        self._expect_metres()
        expect(spacing > 0, "is not above 0", "spacing")
        expect((z is None) != (below_ceiling is None), "give exactly one of z and below_ceiling", "z")
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
            listed = units.setdefault("list", []) if points else []
            group = 1 + len({unit["id"].split("-")[0] for unit in listed})
            for number, axis in enumerate(axes if points else ()):
                aim = f"/a{number + 1}" if len(axes) > 1 else ""
                listed.extend(
                    {"id": f"M{group}-{place}{aim}", "position": position, "axis": list(axis), "type": name}
                    for place, position in points
                )

    def with_people(self, number: float, size: Sequence[float] = (0.5, 0.3, 1.75),
                    reflectance: Material = "dyed_textile") -> Store:  # fmt: skip
        """A copy in which people (Poisson, `number` on average) walk through the room in every state."""
        store = self.copy()
        store._add("materials", "people", material(reflectance))
        area: Any = "room"
        if "room" not in store.document:
            x0, y0, _, x1, y1, _ = (float(value) for value in self.bounds().ravel())
            area = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
        people = {"area": area, "number": {"poisson": number}, "size": list(size), "material": "people"}
        store.document.setdefault("variation", {}).setdefault("people", []).append(people)
        return store

    def _expect_metres(self) -> None:
        expect(
            self.document.get("units", "m") == "m", "of the store are not m: convert it, or edit the document", "units"
        )

    def _add(self, section: str, name: str, keys: Mapping[str, Any]) -> None:
        """Adds a named member; the same member may be there already."""
        members = self.document.setdefault(section, {})
        member = copy.deepcopy(dict(keys))
        taken = name in members and to_json(members[name]) != to_json(member)
        expect(not taken, f"{name!r} is another member: use another name", section)
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
        try:
            return fitted(self.scene().svg())
        except InputError as error:
            return f"<p>{html.escape(repr(self)[1:-1])}</p><p>{html.escape(str(error))}</p>"


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
