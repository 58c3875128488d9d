"""Tables of labels and units as structured arrays, and selections."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import InputError

Records = NDArray[np.void]
# Ids or numbers of labels or units, a mask, or records of a table.
Chosen = str | int | Iterable[Any] | NDArray[Any]

_TYPES = {"position": (np.float64, 3), "normal": (np.float64, 3), "axis": (np.float64, 3),
          "installed": np.bool_, "pinned": np.bool_, "batches": np.uint32, "samples": np.uint64}  # fmt: skip


def records(columns: Mapping[str, Sequence[Any]]) -> Records:
    """A structured array with a field per column: `id` and `type` as texts, positions and directions as triples."""
    fields: list[Any] = []
    for name, values in columns.items():
        if name in ("id", "type"):
            fields.append((name, f"U{max(map(len, values), default=1) or 1}"))
        else:
            kind = _TYPES.get(name, np.float64)
            fields.append((name, *kind) if isinstance(kind, tuple) else (name, kind))
    count = len(next(iter(columns.values())))
    table = np.zeros(count, dtype=fields)
    for name, values in columns.items():
        if count:
            table[name] = values
    table.flags.writeable = False
    return table


def numbers(chosen: Chosen, ids: Sequence[str], kind: str) -> list[int]:
    """The numbers of chosen members of a table, in their order."""
    if isinstance(chosen, (str, int, np.integer)):
        chosen = [chosen]
    array = np.asarray(chosen if isinstance(chosen, np.ndarray) else list(chosen))
    if array.dtype.names is not None:
        array = np.atleast_1d(array["id"])
    if array.dtype == np.bool_:
        if array.shape != (len(ids),):
            raise InputError(f"the mask has the shape {array.shape} instead of ({len(ids)},)", 2, kind)
        return [int(k) for k in np.flatnonzero(array)]
    if array.dtype.kind in "iu":
        for k in array:
            if not 0 <= k < len(ids):
                raise InputError(f"there is no {kind} {k}: they are numbered from 0 to {len(ids) - 1}", 2, kind)
        return [int(k) for k in array]
    places = {id: k for k, id in enumerate(ids)}
    found = []
    for id in map(str, array.ravel()):
        if id not in places:
            raise InputError(f"there is no {kind} {id!r}", 2, kind)
        found.append(places[id])
    return found


def decibels(ratio: Any) -> NDArray[np.float64]:
    """10 log10 of a ratio; -inf for 0."""
    with np.errstate(divide="ignore"):
        return np.asarray(10 * np.log10(ratio), dtype=np.float64)
