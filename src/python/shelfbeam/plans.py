"""Certified plans, their reports, and the verification of mounted units."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import tempfile
import weakref
from collections.abc import Iterator, Sequence
from functools import cached_property
from pathlib import Path as FilePath
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core, pictures
from .errors import InputError, expect, warn
from .options import Path, ProgressOption, as_list, goal, lines_of, options, pair_files, problem
from .placement import Placement, Question, Selection
from .signals import Signals
from .scene import Scene
from .store import Store, name_of, scene_of
from .tables import Result, decibels, ids_of, selected_numbers

_FINISHED = "placement.json"
_ASSUMED_ERROR = 0.2  # of reflectances without a given range


class Plan(Result):
    """The folder of a plan (docs/formats/report.md), from `plan` or from `shelfbeam plan`."""

    def __init__(self, folder: Path, outcome: dict[str, Any] | None = None) -> None:
        self.folder = FilePath(folder)
        outcome = outcome or {}
        self.code: int | None = outcome.get("code")  #: exit code of the command line; None for a plan that was read
        self.answer: str = outcome.get("answer", "")  #: the first line that the command line prints
        self.open: str = outcome.get("open", "")  #: the part of the question that is open
        self.details: str = outcome.get("details", "")  #: the selection, its proof and alternatives

    @classmethod
    def read(cls, folder: Path) -> Plan:
        """A plan that an earlier run has written."""
        plan = cls(folder)
        if not (plan.folder / _FINISHED).is_file():
            raise InputError(f"{plan.folder}: is not the folder of a plan: it has no {_FINISHED}", 2, str(plan.folder))
        return plan

    @cached_property
    def _content(self) -> dict[str, Any]:
        content: dict[str, Any] = json.loads((self.folder / _FINISHED).read_text(encoding="utf-8"))
        return content

    @property
    def question(self) -> Question:
        """What the plan was asked."""
        failure = bool(self._content.get("survives_failure"))
        return Question(None, self._content["model"], failure, None, np.zeros(0), None)

    @property
    def ids(self) -> list[str]:
        """Ids of the chosen units."""
        ids: list[str] = self._content["selected"]
        return ids

    @property
    def count(self) -> int:
        """Number of chosen units."""
        return len(self.ids)

    @property
    def certificate(self) -> dict[str, Any] | None:
        """The statements from independent samples, or from fresh states of a shop that changes; None without."""
        return self._content.get("certificate") or self._content.get("states")

    @cached_property
    def signals(self) -> Signals:
        """The signals on which the units were placed."""
        return Signals.read(self.folder)

    @property
    def report(self) -> FilePath:
        """The path of report.html, which exists as long as the plan."""
        return self.folder / "report.html"

    @property
    def store(self) -> Store:
        """The resolved store."""
        return Store.read(self.folder / "store.json")

    def rebuild_report(self, safe_csv: bool = False, store: Path | None = None) -> FilePath:
        """Writes the report, the mounting files and the tables again (`shelfbeam report`)."""
        return _core.rebuild_report(self.folder, safe_csv, None if store is None else FilePath(store))

    def save(self, folder: Path) -> Plan:
        """A copy of the plan in a new folder."""
        expect(not FilePath(folder).exists(), f"{folder} exists: name a new folder", "folder")
        shutil.copytree(self.folder, folder)
        return Plan.read(folder)

    def to_dict(self) -> dict[str, Any]:
        """The content of placement.json (docs/formats/placement.md)."""
        return dict(self._content)

    def __iter__(self) -> Any:
        return iter(self.ids)

    def __repr__(self) -> str:
        return f"<Plan: {self.answer or f'{self.count} transceivers, in {self.folder}'}>"

    def _repr_html_(self) -> str:
        self.signals.scene = self.signals.scene or self.store.scene()
        return pictures.placement_html(self.answer or repr(self)[1:-1], self.signals, self.ids)


class Verification(Result):
    """The labels that mounted units reach, from independent samples, or from states of a shop that changes."""

    def __init__(self, found: dict[str, Any], scene: Scene) -> None:
        self.scene = scene
        self.units: list[str] = found["units"]  #: ids
        self.answer: str = found["answer"]  #: the sentence of the command line
        self.code: int = found["code"]  #: exit code: 0 all reached, 1 some missed, 3 undecided
        self.certified: bool = self.code == 0
        #: reached, missed, undecided or "not verified yet"; arrays are empty if states were examined.
        self.verdict: NDArray[np.str_] = np.array(found.get("verdict", []), dtype=np.str_)
        nothing = np.zeros(0)
        self.requirement: NDArray[np.float64] = found.get("requirement", nothing)
        self.signal: NDArray[np.float64] = found.get("signal", nothing)  #: of each label, W/m²
        self.standard_error: NDArray[np.float64] = found.get("standard_error", nothing)
        self.lower: NDArray[np.float64] = found.get("lower", nothing)  #: one-sided limits
        self.upper: NDArray[np.float64] = found.get("upper", nothing)
        self._json: str = found["json"]
        self._csv: str = found["csv"]

    @property
    def margin_db(self) -> NDArray[np.float64]:
        """10 log10(signal / requirement) of each label."""
        return decibels(self.signal / self.requirement)

    def to_dict(self) -> dict[str, Any]:
        """What `shelfbeam verify --json` prints."""
        content: dict[str, Any] = json.loads(self._json)
        return content

    def save(self, path: Path) -> None:
        """Writes verification.csv (docs/formats/report.md), the same bytes as `shelfbeam verify -o`."""
        _core.write_text(self._csv, path)

    def __repr__(self) -> str:
        return f"<Verification: {self.answer}>"


def plan(shop: Store | Scene | Path, output: Path | None = None, *, samples: int | None = None,
         relative_error: float | None = None, above: float | None = None, max_samples: int | None = None,
         time: float | None = None, estimator: str | None = None, direct: str | None = None,
         strategy: str | None = None, heuristic: str | None = None, max_bounces: int | None = None,
         signal: Signals | Plan | Path | None = None, at_most: int | None = None,
         reach: float | None = None, model: str = "cooperative", survive_failure: bool = False,
         objective: str = "count", weighted: bool = False, lexicographic: bool = False,
         share: float | None = None, costs: Path | Sequence[Path] | None = None,
         min_spacing: float | None = None, forbid: Path | Sequence[Path] | Sequence[tuple[str, str]] | None = None,
         pin: str | Sequence[str] = (), exclude: str | Sequence[str] = (), solver: str = "auto",
         backend: str | None = None, time_limit: float = 60, certificate: bool = True, confidence: float = 0.99,
         budget: float = 600, curve: bool = False, sensitivity: bool = False, reflectance_error: float | None = None,
         states: int | None = None, availability: float | None = None, all_at_once: float | None = None,
         mean_missed: float | None = None, without: str | Sequence[str] = (),
         sampled: Path | Sequence[Path] | None = None, seed: int = 1, threads: int = 0,
         memory: float | str | None = None, resume: bool = False, checkpoint_interval: float | None = None,
         overwrite: bool = False, strict: bool = False, safe_csv: bool = False,
         progress: ProgressOption = None) -> Plan:  # fmt: skip
    """Simulates, places, certifies and reports (`shelfbeam plan`), also a shop that changes.

    `output`: the folder of the plan, whose files are the same bytes as those of the command line; without, a temporary
    folder that lives as long as the plan. `signal`: signals to reuse if they fit. `certificate` is False for
    `--no-certificate`; `reflectance_error` (0.2) applies to `sensitivity`. Ctrl-C keeps the results so far in the
    folder, which a note of the KeyboardInterrupt names; with `output`, `resume` continues. Raises InputError and
    OutputError.
    """
    expect(reflectance_error is None or sensitivity, "has no effect without sensitivity", "reflectance_error")
    expect(output is not None or not (resume or overwrite or checkpoint_interval), "have no effect without output",
           "resume, overwrite, checkpoint_interval")  # fmt: skip
    scene = scene_of(shop)
    folder = FilePath(tempfile.mkdtemp(prefix="shelfbeam-")) / "plan" if output is None else FilePath(output)
    if sensitivity and reflectance_error is None:
        reflectance_error = _ASSUMED_ERROR
    with _temporary(folder, output), _file_of(signal) as file, pair_files(forbid) as pairs, lines_of(progress) as lines:
        job = options(
            name_of(shop), folder, samples=samples, relative_error=relative_error, above=above,
            max_samples=max_samples, time=time, estimator=estimator, direct=direct, strategy=strategy,
            heuristic=heuristic, max_bounces=max_bounces, signal=file, at_most=at_most, reach=reach,
            **problem(model, weighted, lexicographic, objective=objective, share=share,
                      survive_failure=survive_failure),
            costs=costs, min_spacing=min_spacing, forbid=pairs, pin=as_list(pin) or None,
            exclude=as_list(exclude) or None, solver=solver, backend=backend, time_limit=time_limit,
            certificate=certificate, confidence=confidence, budget=budget, curve=curve,
            reflectance_error=reflectance_error, states=states,
            goal=goal(availability, all_at_once, mean_missed), without=as_list(without) or None, sampled=sampled,
            seed=seed, threads=threads or None, memory=memory, resume=resume,
            checkpoint_interval=checkpoint_interval, overwrite=overwrite, strict=strict, safe_csv=safe_csv,
        )  # fmt: skip
        outcome = _core.plan(scene._core, job, lines)
    made = Plan(folder, outcome)
    if output is None:
        weakref.finalize(made, shutil.rmtree, folder.parent, ignore_errors=True)
    if outcome["imprecise"]:
        warn("some entries have not reached the relative error")
    if outcome["misfit"]:
        warn(outcome["given"])
    return made


@contextlib.contextmanager
def _temporary(folder: FilePath, output: Path | None) -> Iterator[None]:
    """Removes a temporary folder after an error; after Ctrl-C, it has the results so far."""
    try:
        yield
    except Exception:
        if output is None:
            shutil.rmtree(folder.parent, ignore_errors=True)
        raise


@contextlib.contextmanager
def _file_of(signal: Signals | Plan | Path | None) -> Iterator[Path | None]:
    """Signals as a file, which may be temporary."""
    if not isinstance(signal, Signals):
        yield signal.folder if isinstance(signal, Plan) else signal
        return
    with tempfile.TemporaryDirectory(prefix="shelfbeam-") as folder:
        file = FilePath(folder) / "signal.h5"
        signal.save(file)
        yield file


def verify(shop: Store | Scene | Path, selection: Selection | Plan | Path | None = None, *,
           confidence: float = 0.99, budget: float = 600, model: str | None = None, survive_failure: bool | None = None,
           states: int | None = None, availability: float | None = None, all_at_once: float | None = None,
           mean_missed: float | None = None, without: str | Sequence[str] = (),
           samples: int | None = None, relative_error: float | None = None, above: float | None = None,
           max_samples: int | None = None, time: float | None = None, estimator: str | None = None,
           direct: str | None = None, strategy: str | None = None, heuristic: str | None = None,
           max_bounces: int | None = None, seed: int = 1, threads: int = 0,
           memory: float | str | None = None, progress: ProgressOption = None) -> Verification:  # fmt: skip
    """Verifies with independent samples which labels units reach (`shelfbeam verify`).

    `selection`: ids or numbers of candidates, a `Placement`, a `Plan`, a placement.json, or a CSV of mounted units;
    default: the units that the store chooses. `model` and `survive_failure` are those of a `Placement`, `Plan` or
    placement.json by default. With `states`, in so many fresh states of a shop that changes. All verdicts hold together
    with the confidence, for the requirements of the store. Raises InputError.
    """
    scene = scene_of(shop)
    file: Path | None = None
    chosen: list[int] | None = None
    if isinstance(selection, Plan):
        file = selection.folder / _FINISHED
    elif isinstance(selection, os.PathLike) or isinstance(selection, str) and selection not in scene.units["id"]:
        file = selection
    elif selection is not None:
        ids: Any = selection
        if isinstance(selection, Placement):
            ids = selection.ids
            model = model or selection.question.model
            if survive_failure is None:
                survive_failure = selection.question.survive_failure
        chosen = selected_numbers(ids, ids_of(scene.units))
        expect(bool(chosen), "has no units", "selection")
        model = model or "cooperative"
    job = options(
        name_of(shop), selection=file, model=model, survive_failure=survive_failure, confidence=confidence,
        budget=budget, states=states, goal=goal(availability, all_at_once, mean_missed),
        without=as_list(without) or None, samples=samples, relative_error=relative_error, above=above,
        max_samples=max_samples, time=time, estimator=estimator, direct=direct, strategy=strategy,
        heuristic=heuristic, max_bounces=max_bounces, seed=seed, threads=threads or None, memory=memory,
    )  # fmt: skip
    with lines_of(progress) as lines:
        return Verification(_core.verify(scene._core, job, lines, chosen), scene)
