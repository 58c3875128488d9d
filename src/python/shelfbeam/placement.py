"""Placement on signals of any source, and evaluation of selections."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, pictures
from .errors import expect, warn
from .options import Path, ProgressOption, as_list, lines_of, options, pair_files, problem
from .signals import Signals
from .tables import Chosen, Result, decibels, floats, numbers, selected_numbers

Source = Signals | ArrayLike | Path | Sequence[Path]


@dataclass(frozen=True, repr=False)
class Question:
    """What a placement was asked, which `evaluate` and `verify` ask again."""

    signals: Signals | None
    model: str
    survive_failure: bool
    requirement: NDArray[np.float64] | None  #: instead of those of the signals
    costs: NDArray[np.float64]  #: of all units
    at_most: int | None


class Placement(Result):
    """The answer of `place`: the selection, the proven bound, and the question that it answers."""

    def __init__(self, answer: dict[str, Any], unit_ids: Sequence[str], question: Question) -> None:
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
        self.question = question
        self._json: str = answer["json"]

    @property
    def count(self) -> int:
        """Number of chosen units."""
        return len(self.ids)

    @property
    def lower_bound(self) -> float | None:
        """`bound`, if it is a lower one; None with `at_most`."""
        return None if self.question.at_most else self.bound

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
        return pictures.placement_html(self.text.strip().splitlines()[0], self.question.signals, self)


Selection = Placement | Chosen | Path


@dataclass(frozen=True, repr=False)
class Evaluation(Result):
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
          weights: ArrayLike | Path | None = None, start: Selection | None = None,
          costs: ArrayLike | Path | Sequence[Path] | None = None, min_spacing: float | None = None,
          forbid: Path | Sequence[Path] | Sequence[tuple[str, str]] | None = None, pin: Chosen = (),
          exclude: Chosen = (), solver: str = "auto", backend: str | None = None,
          time_limit: float = 60, seed: int = 1, threads: int = 0,
          progress: ProgressOption = None) -> Placement:  # fmt: skip
    """The fewest or cheapest units that reach all labels, with a proven bound (`shelfbeam place`).

    `signals`: of a simulation, an m x n array, the file of a matrix, or several files, each a scenario. An array needs
    its `requirement`, one number or one per label (W/m²); `threshold` is the same for all. Of the signals of a
    simulation, at most one option of a mounting point is chosen; `Signals.with_mean` keeps this for an array. `model`:
    "cooperative", signals add up (3.5), or "non-cooperative", one unit alone must reach a label. `at_most` reaches as
    many labels as possible with at most so many units, `reach` a share of the labels with as few units as possible.
    `costs` and `weights`: one per unit and per label, or CSV files. `pin` and `exclude`: ids, patterns, numbers or a
    mask. `forbid`: pairs of ids, or CSV files. `start`: a selection to begin with. Ties go to the largest minimum
    margin. Raises InputError.
    """
    partial = at_most is not None or reach is not None
    expect(weights is None or partial or curve, "apply only if some labels may be missed: add at_most, reach or curve",
           "weights")  # fmt: skip
    expect(not (curve and partial), "excludes at_most and reach: use one of them", "curve")
    table = _table(signals, requirement, threshold, read_as)
    if isinstance(weights, (str, os.PathLike)):
        table.read_weights(weights)
    elif weights is not None:
        table.set_weights(np.atleast_1d(floats(weights, "weights")))
    prices = None if costs is None or _are_paths(costs) else floats(costs, "costs")
    if prices is not None:
        table.set_costs(prices)
    begin = [] if start is None else [table.units[number] for number in columns_of(start, table)]
    with pair_files(forbid) as files, lines_of(progress) as lines:
        job = options(
            **problem(model, weighted, lexicographic, objective=objective, share=share,
                      survive_failure=survive_failure),
            at_most=at_most, reach=reach, curve=curve, costs=costs if prices is None else None,
            min_spacing=min_spacing, forbid=files, pin=_patterns(pin, table), exclude=_patterns(exclude, table),
            solver=solver, backend=backend,
            time_limit=time_limit, seed=seed, threads=threads or None,
        )  # fmt: skip
        answer = table.place(job, lines, begin)
    given = threshold if threshold is not None else requirement
    question = Question(signals if isinstance(signals, Signals) else None, model, survive_failure,
                        None if given is None else floats(given, "requirement"), answer["costs"], at_most)  # fmt: skip
    return Placement(answer, table.units, question)


def evaluate(signals: Source, selection: Selection, *, requirement: ArrayLike | None = None,
             threshold: float | None = None, model: str | None = None, survive_failure: bool | None = None,
             costs: ArrayLike | None = None) -> Evaluation:  # fmt: skip
    """The labels that a selection reaches: ids, numbers, a mask, a placement.json, a `Placement` or a `Plan`.

    Of a `Placement` or a `Plan`, the keywords have the values with which it was made. Raises InputError.
    """
    asked: Question | None = getattr(selection, "question", None)
    if requirement is None and threshold is None and asked is not None:
        requirement = asked.requirement
    if costs is None and asked is not None and len(asked.costs):
        costs = asked.costs
    table = _table(signals, requirement, threshold)
    if costs is not None:
        table.set_costs(np.atleast_1d(floats(costs, "costs")))
    selected = columns_of(selection, table)
    model = model or (asked.model if asked else "cooperative")
    failure = survive_failure if survive_failure is not None else bool(asked and asked.survive_failure)
    job = options(**problem(model, False, False, survive_failure=failure))
    return Evaluation(selected, **table.check(job, selected))


def _table(
    signals: Source, requirement: ArrayLike | None, threshold: float | None, read_as: str = "auto"
) -> _core.Table:
    expect(requirement is None or threshold is None, "excludes threshold: use one of them", "requirement")
    given = requirement if threshold is None else threshold
    if isinstance(signals, Signals):
        table = _core.Table.of_signals(signals._core)
    elif _are_paths(signals):
        table, remarks = _core.Table.read(as_list(signals), read_as)  # type: ignore[arg-type]
        for remark in remarks:
            warn(remark)
    else:
        array = floats(signals, "signals")
        expect(array.ndim == 2, f"has {array.ndim} dimensions instead of 2, labels x units", "signals")  # noqa: PLR2004
        expect(given is not None, "is missing: an array of signals has none", "requirement")
        labels, units = ([f"{kind}{k + 1}" for k in range(n)] for kind, n in zip("LT", array.shape))
        table = _core.Table.of_array(array, labels, units)
    if given is not None:
        values = floats(given, "requirement")
        expect(values.ndim < 2, "has more than one dimension", "requirement")  # noqa: PLR2004
        table.set_requirement(np.full(len(table.labels), values) if values.ndim == 0 else values)
    return table


def columns_of(selection: Any, table: _core.Table) -> list[int]:
    """The columns of a selection, ascending; a text other than an id names a placement.json."""
    if hasattr(selection, "ids"):
        selection = selection.ids
    units = table.units
    if isinstance(selection, os.PathLike) or isinstance(selection, str) and selection not in units:
        return table.read_selection(selection)
    return selected_numbers(selection, units)


def _patterns(chosen: Chosen, table: _core.Table) -> list[str] | None:
    """Ids and patterns as they are; numbers and masks as ids."""
    if isinstance(chosen, str) or isinstance(chosen, (list, tuple)) and all(isinstance(one, str) for one in chosen):
        return as_list(chosen) or None
    units = table.units
    return [units[number] for number in numbers(chosen, units, "pin or exclude")] or None


def _are_paths(values: Any) -> bool:
    if isinstance(values, (str, os.PathLike)):
        return True
    return isinstance(values, Sequence) and bool(values) and all(isinstance(one, (str, os.PathLike)) for one in values)
