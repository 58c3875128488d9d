"""Reads signal files (docs/formats/signal.md), and writes variants with fewer or other entries."""

from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

LABEL_SETS = ("id", "type", "position", "normal", "requirement", "link_cost", "signal_cost", "batches", "samples")
UNIT_SETS = ("id", "type", "position", "axis", "cost", "installed")


@dataclass(frozen=True)
class Signals:
    path: Path
    mean: np.ndarray  # m x n
    error: np.ndarray  # m x n, standard errors
    direct: np.ndarray  # m x n
    label_ids: list
    labels: np.ndarray  # m x 3, m
    normals: np.ndarray  # m x 3
    requirement: np.ndarray  # m
    unit_ids: list
    units: np.ndarray  # n x 3, m
    batches: int  # minimum over the rows
    samples: int  # minimum over the rows
    estimator: str

    def columns(self, ids):
        return [self.unit_ids.index(one) for one in ids]

    def unit_at(self, x, y):
        """The column of the candidate nearest to a point of the floor; the first if several are equally near."""
        return int(np.argmin(np.hypot(self.units[:, 0] - x, self.units[:, 1] - y).round(9)))


def read_signals(path):
    with h5py.File(path) as file:
        return Signals(
            Path(path),
            file["mean"][:].astype(float),
            file["standard_error"][:].astype(float),
            file["direct"][:].astype(float),
            list(file["labels/id"].asstr()[:]),
            file["labels/position"][:],
            file["labels/normal"][:],
            file["labels/requirement"][:],
            list(file["transceivers/id"].asstr()[:]),
            file["transceivers/position"][:],
            int(file["labels/batches"][:].min()),
            int(file["labels/samples"][:].min()),
            file.attrs["estimator"].decode(),
        )


def write_variant(source, path, mean=None, columns=None, costs=None):
    """Writes a copy of the signal file `source` with other entries (m x n), fewer columns, or other costs.

    An existing file that is newer than its source is kept, so every variant needs its own name.
    """
    path = Path(path)
    if path.exists() and path.stat().st_mtime > Path(source).stat().st_mtime:
        return path
    new = path.with_name(path.name + ".new")
    with h5py.File(source) as old, h5py.File(new, "w", libver="latest") as file:
        chosen = slice(None) if columns is None else np.asarray(columns)
        values = old["mean"][:] if mean is None else np.asarray(mean, dtype="<f4")
        file["mean"] = np.ascontiguousarray(values[:, chosen])
        for name in ("standard_error", "direct"):
            file[name] = np.ascontiguousarray(old[name][:][:, chosen])
        for name in LABEL_SETS:
            file[f"labels/{name}"] = old[f"labels/{name}"][:]
        for name in UNIT_SETS:
            file[f"transceivers/{name}"] = old[f"transceivers/{name}"][:][chosen]
        if costs is not None:
            file["transceivers/cost"][:] = costs
        for name, value in old.attrs.items():
            if name != "bounce_layers":
                file.attrs[name] = value
    new.replace(path)
    return path
