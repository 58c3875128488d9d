"""Previews of units at any place, by the light operator of a scene."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _core
from .errors import expect
from .options import Path, ProgressOption, as_list, lines_of, options
from .plans import Plan
from .signals import Signals
from .tables import Result, floats
from .scene import Scene
from .store import Store, name_of, scene_of


class Column(NamedTuple):
    """The signals of all labels from one unit (W/m²): approximations with a standard error per label."""

    signal: NDArray[np.float32]
    direct: NDArray[np.float32]  #: the part without a reflection
    error: NDArray[np.float32]  #: 95 % of the truths are within 1.96 errors
    doubts: NDArray[np.uint8]  #: bits: 1 near a surface, 2 mirrors, 4 unexplored surfaces, 8 skewed, 16 gap


class LightOperator:
    """The light between the surfaces and labels of a scene, computed once; any unit then takes milliseconds."""

    def __init__(self, shop: Store | Scene | Path, *, seed: int = 1, coarse: bool = False, threads: int = 0,
                 progress: ProgressOption = None) -> None:  # fmt: skip
        self.scene = scene_of(shop)
        self._threads = threads
        job = options(name_of(shop), seed=seed, threads=threads or None)
        with lines_of(progress) as lines:
            self._core = _core.LightOperator.make(self.scene._core, job, coarse, lines)

    def column(self, position: Sequence[float], axis: Sequence[float] = (0, 0, -1), type: str = "") -> Column:
        """The signals from a unit at a position (m). `type`: needed if the candidates have several."""
        unit = unit_text(position, axis, type)
        return Column(**self._core.column(unit, self._threads))

    def signals(self, progress: ProgressOption = None) -> Signals:
        """Previews of the whole signal matrix."""
        with lines_of(progress) as lines:
            return Signals(self._core.matrix(self._threads, lines), self.scene)

    @property
    def nbytes(self) -> int:
        """Memory of the operator."""
        return self._core.bytes

    def __repr__(self) -> str:
        return f"<LightOperator of {self.scene!r}: {self.nbytes / 1e6:.0f} MB>"


class WhatIf(Result):
    """The labels if units are added, moved or removed."""

    def __init__(self, found: dict[str, Any]) -> None:
        self.answer: str = found["answer"]  #: one sentence
        self.remarks: str = found["remarks"]
        self.not_kept: str = found["not_kept"]  #: why the light operator could not be kept for the next preview
        self._content: dict[str, Any] = json.loads(found["json"])

    def to_dict(self) -> dict[str, Any]:
        """What `shelfbeam preview --json` prints (docs/formats/preview.md)."""
        return dict(self._content)

    def __repr__(self) -> str:
        return f"<WhatIf: {self.answer}>"


def what_if(shop: Store | Scene | Path, *, plan: Plan | Path | None = None,
            unit: str | Sequence[str] = (), move: str | Sequence[str] = (),
            remove: str | Sequence[str] = (), refine: float | None = None, coarse: bool = False,
            seed: int = 1, threads: int = 0, progress: ProgressOption = None) -> WhatIf:  # fmt: skip
    """Previews added, moved and removed units (`shelfbeam preview`).

    `plan`: whose units stay, instead of those that the store selects. `unit` adds "x,y,z[,ax,ay,az][,type]", `move`
    takes "ID,x,y,z[,ax,ay,az][,type]", both in m. `refine` (s) simulates the added units without bias.
    """
    folder = plan.folder if isinstance(plan, Plan) else plan
    expect(folder is None or isinstance(folder, (str, os.PathLike)), "is not a plan or a folder", "plan")
    expect(refine is None or math.isfinite(refine) and refine > 0, "is not a time above 0", "refine")
    for name, texts in (("unit", unit), ("move", move), ("remove", remove)):
        expect(all(isinstance(one, str) for one in as_list(texts)), "is not a text such as x,y,z", name)
    job = options(name_of(shop), seed=seed, threads=threads or None)
    with lines_of(progress) as lines:
        return WhatIf(_core.what_if(scene_of(shop)._core, job, lines, folder or "", as_list(unit), as_list(move),
                                    as_list(remove), refine, coarse))  # fmt: skip


def unit_text(position: Sequence[float], axis: Sequence[float] = (0, 0, -1), type: str = "") -> str:
    """A unit as the command line takes it."""
    numbers: list[float] = []
    for name, values in (("position", position), ("axis", axis)):
        three = floats(values, name)
        expect(three.shape == (3,) and bool(np.isfinite(three).all()), "is not three finite numbers", name)
        numbers += three.tolist()
    text = ",".join(map(repr, numbers))
    return f"{text},{type}" if type else text
