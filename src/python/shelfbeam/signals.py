"""Simulation of the signal matrix."""

from __future__ import annotations

import html
import json
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _core, pictures
from .errors import expect, warn
from .options import Path, ProgressOption, as_list, lines_of, options
from .scene import Scene
from .store import Store, name_of, scene_of
from .tables import Chosen, Records, Result, floats, ids_of, numbers, plain, records, some_numbers

if TYPE_CHECKING:
    from .placement import Selection

Layer = NDArray[np.float32]
_MOST_STATES = 100_000


@dataclass(frozen=True, repr=False)
class StateSignals(Result):
    """The signals of a changing shop in its states, multiplied by the relative sensitivities of the labels."""

    count: int  #: of states
    deviation: Layer  #: labels x units: standard deviation between states, with their sampling noise
    labels: NDArray[np.uint32]  #: numbers of the hardest labels, ascending, whose signals follow
    signal: Layer  #: states x hardest labels x units
    error: Layer | None  #: standard errors of `signal`; None unless they were asked for

    def __repr__(self) -> str:
        return f"<StateSignals: {self.count} states, {len(self.labels)} labels>"


class Signals(Result):
    """The signal matrix M of a scene: m labels x n candidates (2.14), in W/m² for labels with a cosine response.

    All arrays are read-only views of the memory of the simulation, without a copy.
    """

    def __init__(self, core: _core.Signals, scene: Scene | None = None, summary: str = "") -> None:
        self._core = core
        self.scene = scene
        #: Effort and errors of the simulation, with the keys that `shelfbeam simulate --json` prints.
        self.summary: dict[str, Any] = json.loads(summary) if summary else {}
        self.mean: Layer = core.mean  #: near 0, noise may be negative; plans and exported matrices count it as 0
        self.standard_error: Layer = core.standard_error  #: of `mean`, from independent batches
        self.direct: Layer = core.direct  #: the part of `mean` without any reflection
        self.flags: NDArray[np.uint8] | None = core.flags  #: 1 if the standard error is not reliable
        self.labels: Records = records(core.labels())
        self.units: Records = records(core.units())
        states = core.states()
        self.states: StateSignals | None = StateSignals(**states) if states else None

    @classmethod
    def read(cls, path: Path) -> Signals:
        """A signal file (HDF5), or that of a plan in a folder. Read files from trusted sources only."""
        return cls(_core.Signals.read(path))

    def save(self, path: Path) -> None:
        """Writes the signal file, the same bytes as `shelfbeam simulate`."""
        self._core.write(path)

    def with_mean(self, mean: Any) -> Signals:
        """The same labels, units, costs and exclusions with other means, m x n: such as mean - 2 error, at least 0."""
        return Signals(self._core.with_mean(floats(mean, "mean").astype(np.float32)), self.scene)

    def __array__(self, dtype: Any = None, copy: Any = None) -> NDArray[Any]:
        return np.array(self.mean, dtype=dtype, copy=True) if copy or dtype is not None else self.mean

    def __reduce__(self) -> Any:
        with tempfile.TemporaryDirectory(prefix="shelfbeam-") as folder:
            self.save(FilePath(folder) / "signal.h5")
            return _from_bytes, ((FilePath(folder) / "signal.h5").read_bytes(), self.scene, self.summary)

    @property
    def error(self) -> Layer:
        """The same as `standard_error`."""
        return self.standard_error

    @property
    def requirement(self) -> NDArray[np.float64]:
        """gamma tau of each label (3.6), in the unit of the signals."""
        requirement: NDArray[np.float64] = self.labels["requirement"]
        return requirement

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of labels and of candidates."""
        return self._core.rows, self._core.columns

    @property
    def by_bounce(self) -> list[tuple[Layer, Layer]]:
        """Mean and standard error of the paths with k bounces, for k = 0, 1, ..."""
        return self._core.by_bounce

    @property
    def by_length(self) -> list[tuple[Layer, Layer]]:
        """Mean and standard error of the paths from k to k + 1 times `length_step` long; the last: all longer ones."""
        return self._core.by_length

    @property
    def length_step(self) -> float:
        """Length of a step of `by_length` (m)."""
        return self._core.length_step

    @property
    def seed(self) -> int:
        """Seed of the random numbers."""
        return self._core.seed

    @property
    def estimator(self) -> str:
        """The estimator, in a few words."""
        return self._core.estimator

    @property
    def store_hash(self) -> str:
        """Identifies the simulated scene (`Scene.hash`); empty for a matrix from elsewhere."""
        return self._core.store_hash

    @property
    def wavelength_nm(self) -> float:
        """The wavelength to which all reflectances apply."""
        return self._core.wavelength_nm

    @property
    def currency(self) -> str:
        """Of the costs of the units; may be empty."""
        return self._core.currency

    @property
    def complete(self) -> bool:
        """Whether the simulation was not interrupted."""
        return self._core.complete

    def label_numbers(self, chosen: Chosen) -> list[int]:
        """The rows of labels that are given by ids, numbers, a mask, or records."""
        return numbers(chosen, ids_of(self.labels), "label")

    def unit_numbers(self, chosen: Chosen) -> list[int]:
        """The columns of units that are given by ids, numbers, a mask, or records."""
        return numbers(chosen, ids_of(self.units), "unit")

    def plot_coverage(self, selection: Selection, z: float | None = None, unit: str = "dB", ax: Any = None,
                      **problem: Any) -> Any:  # fmt: skip
        """A map of the signal of a selection at the labels, with Matplotlib; returns the figure.

        `unit`: "dB" for the margin over the requirement, or "W/m2". `z`: only labels at this height (m). `problem`:
        keywords of `evaluate`.
        """
        return pictures.coverage(self, selection, z, unit, ax, problem)

    def to_pandas(self) -> Any:
        """The means as a pandas.DataFrame with the ids of labels and units."""
        import pandas  # noqa: PLC0415: optional

        return pandas.DataFrame(self.mean, index=self.labels["id"], columns=self.units["id"])

    def to_xarray(self) -> Any:
        """Mean, standard error and direct part as an xarray.Dataset with ids, positions and requirements."""
        import xarray  # noqa: PLC0415: optional

        matrix = ("label", "unit")
        names = ("mean", "standard_error", "direct")
        data: dict[str, Any] = {name: (matrix, getattr(self, name), {"units": "W m-2"}) for name in names}
        data["requirement"] = ("label", self.requirement, {"units": "W m-2"})
        data["cost"] = ("unit", self.units["cost"])
        coordinates: dict[str, Any] = {"label": self.labels["id"], "unit": self.units["id"]}
        for table, dimension in ((self.labels, "label"), (self.units, "unit")):
            for axis, name in enumerate("xyz"):
                coordinates[f"{dimension}_{name}"] = (dimension, table["position"][:, axis], {"units": "m"})
        return xarray.Dataset(data, coordinates, {"seed": self.seed, "estimator": self.estimator})

    def to_dict(self) -> dict[str, Any]:
        """Labels, units, mean, standard error and direct part as lists, and the summary of the simulation."""
        names = ("labels", "units", "mean", "standard_error", "direct", "summary")
        return {name: plain(getattr(self, name)) for name in names}

    def __repr__(self) -> str:
        rows, columns = self.shape
        of_states = f", mean of {self.states.count} states" if self.states else ""
        return f"<Signals: {rows} labels x {columns} candidates{of_states}; {self.estimator}, seed {self.seed}>"

    def _repr_html_(self) -> str:
        picture = pictures.fitted(self.scene.svg()) if self.scene else ""
        return f"<p>{html.escape(repr(self)[1:-1])}</p>{picture}"


def _from_bytes(content: bytes, scene: Scene | None, summary: dict[str, Any]) -> Signals:
    """Signals of a pickle."""
    with tempfile.TemporaryDirectory(prefix="shelfbeam-") as folder:
        file = FilePath(folder) / "signal.h5"
        file.write_bytes(content)
        return Signals(_core.Signals.read(file), scene, json.dumps(summary))


def simulate(shop: Store | Scene | Path, *, output: Path | None = None, samples: int | None = None,
             relative_error: float | None = None, above: float | None = None,
             max_samples: int | None = None, time: float | None = None, estimator: str | None = None,
             direct: str | None = None, strategy: str | None = None, heuristic: str | None = None,
             max_bounces: int | None = None, by_bounce: bool = False, by_length: float | None = None,
             lengths: int | None = None, labels: Chosen | None = None, units: Chosen | None = None,
             states: int = 0, hard_labels: int | None = None, for_plan: bool = False, state: int | None = None,
             without: str | Sequence[str] = (), seed: int = 1, threads: int = 0, memory: float | str | None = None,
             resume: bool = False, checkpoint_interval: float | None = None, strict: bool = False,
             progress: ProgressOption = None) -> Signals:  # fmt: skip
    """The signal of every label from every candidate, with standard errors (`shelfbeam simulate`).

    `samples` per label (default 10000), or `relative_error` of the entries above the share `above` (0.3) of their
    requirement, or `time` (s) end the simulation. `by_length` (m) and `max_bounces`, with `by_bounce`, need the paper's
    estimator and select it. `labels` and `units` restrict the simulation. With `states`, the result is the mean over
    random states of a changing shop: `Signals.states` has the signals of the `hard_labels` (1000) hardest labels in
    each. `state` simulates one of them. The result is the same for any number of threads. With `output`, the signal
    file is written, and `resume` continues an interrupted simulation. Warns if the relative error was not reached.
    Raises InputError for wrong or contradictory keywords and for a wrong store, and OutputError.
    """
    part = labels is not None or units is not None
    for name, given in (("relative_error", relative_error), ("time", time), ("by_bounce", by_bounce),
                        ("by_length", by_length), ("labels", part), ("state", state is not None)):  # fmt: skip
        expect(not (states and given), "excludes states: use one of them", name)
    for name, given in (("hard_labels", hard_labels is not None), ("for_plan", for_plan)):
        expect(bool(states) or not given, "has no effect without states", name)
    expect(not (for_plan and hard_labels is not None), "has no effect with for_plan", "hard_labels")
    expect(output is None or not part, "excludes labels and units: use one of them", "output")
    for name, given in (("resume", resume), ("checkpoint_interval", checkpoint_interval is not None)):
        expect(output is not None or not given, "has no effect without output", name)
    expect(hard_labels is None or hard_labels > 0, "is not above 0", "hard_labels")
    expect(0 <= states <= _MOST_STATES, f"is not from 0 to {_MOST_STATES}", "states")
    left_out = as_list(without) or None
    scene = scene_of(shop)
    if state is not None:
        scene, left_out = scene.state(state, seed, left_out or ()), None
    job = options(
        name_of(shop), samples=samples, relative_error=relative_error, above=above, max_samples=max_samples, time=time,
        estimator=estimator, direct=direct, strategy=strategy, heuristic=heuristic, max_bounces=max_bounces,
        without=left_out, seed=seed, threads=threads or None, memory=memory, resume=resume,
        checkpoint_interval=checkpoint_interval, strict=strict,
    )  # fmt: skip
    more: dict[str, Any] = {"by_bounce": by_bounce, "by_length": by_length, "lengths": lengths, "states": states,
                            "hard_labels": hard_labels, "for_plan": for_plan}  # fmt: skip
    if labels is not None:
        more["labels"] = some_numbers(labels, ids_of(scene.labels), "labels")
    if units is not None:
        more["units"] = some_numbers(units, ids_of(scene.units), "units")
    with lines_of(progress) as lines:
        core, summary = _core.simulate(scene._core, job, lines, more, output or "")
    signals = Signals(core, scene, summary)
    if signals.summary.get("unmet"):
        entries = signals.summary["unmet"]["entries"]
        warn(f"{entries} entries have not reached the relative error")
    return signals
