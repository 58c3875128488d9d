"""Impulse responses, delay spread and bandwidth."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import expect
from .options import Path
from .signals import simulate
from .scene import Scene
from .store import Store, scene_of
from .tables import Chosen, Records, Result

_METRES_PER_NS = 0.299792458
_MOST_STEPS = 10000


@dataclass(frozen=True, repr=False)
class ImpulseResponse(Result):
    """The signal of labels from units over time; bin k contains paths from k to k + 1 times `step` long."""

    labels: Records
    units: Records
    step: float  #: m
    response: NDArray[np.float32]  #: labels x units x bins, W/m² per bin; the last contains all longer paths
    standard_error: NDArray[np.float32]  #: of `response`

    @property
    def time_ns(self) -> NDArray[np.float64]:
        """The middles of the bins (ns)."""
        bins: NDArray[np.float64] = np.arange(self.response.shape[2], dtype=np.float64) + 0.5
        return bins * (self.step / _METRES_PER_NS)

    @property
    def signal(self) -> NDArray[np.float64]:
        """The sums over time, labels x units."""
        total: NDArray[np.float64] = self.response.sum(axis=2, dtype=np.float64)
        return total

    @property
    def mean_delay_ns(self) -> NDArray[np.float64]:
        """mu = sum h_k t_k / sum h_k, labels x units."""
        return self._moment(self.time_ns)

    @property
    def delay_spread_ns(self) -> NDArray[np.float64]:
        """The rms delay spread, sqrt(sum h_k (t_k - mu)² / sum h_k), labels x units."""
        deviation = self.time_ns - self.mean_delay_ns[..., None]
        spread: NDArray[np.float64] = np.sqrt(self._moment(np.square(deviation)))
        return spread

    @property
    def bandwidth_MHz(self) -> NDArray[np.float64]:
        """The lowest frequency at which |H(f)|² is half of |H(0)|² (Kahn and Barry 1997), labels x units.

        Infinite where no frequency below the limit of the bins, c / (2 step), has it; nan without a signal.
        """
        count = 1 << max(16, int(self.response.shape[2] - 1).bit_length() + 3)
        frequency = np.fft.rfftfreq(count, self.step / _METRES_PER_NS * 1e-3)  # MHz
        result = np.full(self.response.shape[:2], math.inf)
        for place in np.ndindex(result.shape):
            power = np.abs(np.fft.rfft(self.response[place].astype(np.float64), count)) ** 2
            below = np.flatnonzero(power < power[0] / 2)
            if len(below):
                result[place] = frequency[below[0]]
            elif power[0] == 0:
                result[place] = math.nan
        return result

    def _moment(self, values: NDArray[Any]) -> NDArray[np.float64]:
        with np.errstate(invalid="ignore", divide="ignore"):
            moment: NDArray[np.float64] = (self.response * values).sum(axis=2, dtype=np.float64) / self.signal
        return moment

    def __repr__(self) -> str:
        rows, columns, bins = self.response.shape
        return f"<ImpulseResponse: {rows} labels x {columns} units, {bins} bins of {self.step} m>"


def impulse_response(shop: Store | Scene | Path, labels: Chosen | None = None,
                     units: Chosen | None = None, step: float = 0.25, max_bounces: int = 10,
                     max_length: float | None = None, samples: int | None = None,
                     **keywords: Any) -> ImpulseResponse:  # fmt: skip
    """The impulse response between labels and units, by the paper's estimator with layers by path length.

    `step`: length of a bin (m). `max_length`: length up to which paths have bins of their own (m); default:
    (max_bounces + 1) times the diagonal of the scene. There are at most 10000 bins. `samples` per label: 100000.
    `keywords`: further ones of `simulate`. Raises InputError.
    """
    scene = scene_of(shop)
    for name, length in (("step", step), ("max_length", max_length)):
        expect(length is None or math.isfinite(length) and length > 0, "is not a length above 0", name)
    if samples is None and not {"relative_error", "time"} & set(keywords):
        samples = 100_000
    if max_length is None:
        low, high = scene.bounds
        max_length = float((max_bounces + 1) * np.linalg.norm(high - low))
    count, least = max_length / step, max_length / _MOST_STEPS
    expect(count <= _MOST_STEPS, f"makes {count:.6g} bins: use a step from {least:.3g} m on, or a max_length", "step")
    bins = max(1, math.ceil(count))
    signals = simulate(scene, labels=labels, units=units, by_length=step, lengths=bins, max_bounces=max_bounces,
                       samples=samples, **keywords)  # fmt: skip
    mean, error = (np.stack(layers, axis=2) for layers in zip(*signals.by_length))
    return ImpulseResponse(signals.labels, signals.units, step, mean, error)
