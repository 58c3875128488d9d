"""Placement on signals of any source, and evaluation of selections."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, pictures
from .errors import InputError
from .options import Path, ProgressOption, as_list, callback, options, problem
from .signals import Signals
from .tables import Chosen, decibels, numbers

Source = Signals | ArrayLike | Path


class Placement:
    """The answer of `place`: the selection, and the proven bound."""

    def __init__(self, answer: dict[str, Any], unit_ids: Sequence[str], signals: Signals | None) -> None:
        self.ids: list[str] = answer["ids"]  #: of the chosen units
        places = {id: number for number, id in enumerate(unit_ids)}
        self.selected: NDArray[np.intp] = np.array(
            [places[id] for id in self.ids], dtype=np.intp
        )  #: columns, ascending
        self.status: str = answer["status"]  #: optimal, feasible, infeasible or stopped
        self.has_selection: bool = answer["has_selection"]
        self.reached: int = answer["reached"]  #: labels that the selection reaches
        self.value: float = answer["value"]  #: number of units, cost, new spend or, with `at_most`, reached labels
        self.bound: float = answer["bound"]  #: proven on `value`: from below or, with `at_most`, from above
        self.code: int = answer["code"]  #: exit code of the command line
        self.seconds: float = answer["seconds"]
        self.steps: list[dict[str, Any]] = json.loads(answer["steps"])  #: record of the search
        self.text: str = answer["text"]  #: the lines that the command line prints
        self.signals = signals
        self._json: str = answer["json"]

    @property
    def count(self) -> int:
        """Number of chosen units."""
        return len(self.ids)

    @property
    def lower_bound(self) -> float:
        """The same as `bound`."""
        return self.bound

    @property
    def proven(self) -> bool:
        """Whether the answer is proven to be optimal."""
        return self.status == "optimal"

    def to_dict(self) -> dict[str, Any]:
        """The content of placement.json (docs/formats/placement.md)."""
        content: dict[str, Any] = json.loads(self._json)
        return content

    def save(self, path: Path) -> None:
        """Writes placement.json, the same bytes as `shelfbeam place`."""
        _core.write_text(self._json, path)

    def __len__(self) -> int:
        return self.count

    def __iter__(self) -> Any:
        return iter(self.ids)

    def __repr__(self) -> str:
        return f"<Placement: {self.text.strip().splitlines()[0]}>"

    def _repr_html_(self) -> str:
        return pictures.placement_html(self.text.strip().splitlines()[0], self.signals, self.ids)


Selection = Placement | Chosen


@dataclass(frozen=True, repr=False)
class Evaluation:
    """The labels with a selection, computed in double precision from the matrix alone."""

    selected: list[int]  #: columns
    signal: NDArray[np.float64]  #: of each label (3.5); with `survive_failure`, after the worst failure
    requirement: NDArray[np.float64]
    serving: NDArray[np.uint32]  #: number of chosen units that reach each label alone
    missed: NDArray[np.uint32]  #: numbers of the labels that are not reached
    allowed: bool  #: no two units exclude one another
    cost: float  #: of the chosen units

    @property
    def margin_db(self) -> NDArray[np.float64]:
        """10 log10(signal / requirement) of each label; -inf without a signal."""
        return decibels(self.signal / self.requirement)

    @property
    def reached(self) -> NDArray[np.bool_]:
        """Whether each label is reached."""
        mask = np.ones(len(self.signal), dtype=np.bool_)
        mask[self.missed] = False
        return mask

    @property
    def feasible(self) -> bool:
        """Whether all labels are reached, and no two units exclude one another."""
        return self.allowed and not len(self.missed)

    def __repr__(self) -> str:
        labels = len(self.signal)
        return f"<Evaluation: {len(self.selected)} units reach {labels - len(self.missed)} of {labels} labels>"


def place(signals: Source, *, requirement: ArrayLike | None = None, threshold: float | None = None,
          read_as: str = "auto", model: str = "cooperative", survive_failure: bool = False, objective: str = "count",
          weighted: bool = False, lexicographic: bool = False, share: float | None = None,
          at_most: int | None = None, reach: float | None = None, curve: bool = False,
          weights: ArrayLike | Path | None = None, start: Selection | Path | None = None,
          costs: ArrayLike | Path | Sequence[Path] | None = None, min_spacing: float | None = None,
          forbid: Path | Sequence[Path] | None = None, pin: str | Sequence[str] = (),
          exclude: str | Sequence[str] = (), solver: str = "auto", backend: str | None = None,
          time_limit: float = 60, seed: int = 1, threads: int = 0,
          progress: ProgressOption = None) -> Placement:  # fmt: skip
    """The fewest or cheapest units that reach all labels, with a proven bound (`shelfbeam place`).

    `signals`: of a simulation, an m x n array, or the file of a matrix. An array needs its `requirement`, one number or
    one per label (W/m²); `threshold` is the same for all. `model`: "cooperative", signals add up (3.5), or
    "non-cooperative", one unit alone must reach a label. `at_most` and `reach` ask for the most labels with so many
    units, and for the fewest units that reach a share of them. `costs` and `weights`: one per unit and per label, or
    CSV files. `pin` and `exclude`: ids or patterns. `start`: a selection to begin with.
    """
    table = _table(signals, threshold if threshold is not None else requirement, read_as)
    if weights is not None:
        if at_most is None and reach is None and not curve:
            raise InputError(
                "weights apply only if some labels may be missed: add at_most, reach or curve", 2, "weights"
            )
        if isinstance(weights, (str, os.PathLike)):
            table.read_weights(weights)
        else:
            table.set_weights(np.asarray(weights, dtype=np.float64))
    files = costs
    if costs is not None and not _are_paths(costs):
        table.set_costs(np.asarray(costs, dtype=np.float64))
        files = None
    begin = []
    if start is not None:
        file = _file_of(start, table)
        chosen = table.read_selection(file) if file else _columns(start, table.units)
        begin = [table.units[number] for number in chosen]
    job = options(
        **problem(model, weighted, lexicographic, objective=objective, share=share, survive_failure=survive_failure),
        at_most=at_most, reach=reach, curve=curve, costs=files, min_spacing=min_spacing, forbid=forbid,
        pin=as_list(pin) or None, exclude=as_list(exclude) or None, solver=solver, backend=backend,
        time_limit=time_limit, seed=seed, threads=threads or None,
    )  # fmt: skip
    answer = table.place(job, callback(progress), begin)
    return Placement(answer, table.units, signals if isinstance(signals, Signals) else None)


def evaluate(signals: Source, selection: Selection, *, requirement: ArrayLike | None = None,
             threshold: float | None = None, model: str = "cooperative",
             survive_failure: bool = False) -> Evaluation:  # fmt: skip
    """The labels that a selection reaches: ids, numbers, a mask, or a `Placement`."""
    table = _table(signals, threshold if threshold is not None else requirement)
    selected = _columns(selection, table.units)
    job = options(**problem(model, False, False, survive_failure=survive_failure))
    return Evaluation(selected, **table.check(job, selected))


def _table(signals: Source, requirement: ArrayLike | None, read_as: str = "auto") -> _core.Table:
    if isinstance(signals, Signals):
        table = _core.Table.of_signals(signals._core)
    elif isinstance(signals, (str, os.PathLike)):
        table = _core.Table.read(signals, read_as)
    else:
        array = np.asarray(signals, dtype=np.float64)
        if array.ndim != 2:  # noqa: PLR2004
            raise InputError(f"the signals have {array.ndim} dimensions instead of 2, labels x units", 2, "signals")
        if requirement is None:
            raise InputError("an array has no requirements: give requirement (requirement)", 2, "", "requirement")
        labels, units = ([f"{kind}{k + 1}" for k in range(n)] for kind, n in zip("LT", array.shape))
        table = _core.Table.of_array(array, labels, units)
    if requirement is not None:
        values = np.asarray(requirement, dtype=np.float64)
        table.set_requirement(np.full(len(table.labels), values) if values.ndim == 0 else values)
    return table


def _columns(selection: Any, units: Sequence[str]) -> list[int]:
    return sorted(numbers(selection.ids if isinstance(selection, Placement) else selection, units, "unit"))


def _file_of(start: Any, table: _core.Table) -> FilePath | None:
    if isinstance(start, os.PathLike) or isinstance(start, str) and start not in table.units:
        return FilePath(start)
    return None


def _are_paths(costs: Any) -> bool:
    if isinstance(costs, (str, os.PathLike)):
        return True
    return isinstance(costs, Sequence) and bool(costs) and all(isinstance(one, (str, os.PathLike)) for one in costs)
