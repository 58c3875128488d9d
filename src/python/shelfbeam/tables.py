"""Tables of labels and units as structured arrays, selections, and results."""

from __future__ import annotations

import html
import operator
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import InputError, expect, make

Records = NDArray[np.void]
# Ids or numbers of labels or units, a mask, or records of a table.
Chosen = str | int | Iterable[Any] | NDArray[Any]

_TYPES = {"position": (np.float64, 3), "normal": (np.float64, 3), "axis": (np.float64, 3),
          "installed": np.bool_, "pinned": np.bool_, "batches": np.uint32, "samples": np.uint64}  # fmt: skip


def records(columns: Mapping[str, Sequence[Any]]) -> Records:
    """A structured array with a field per column: `id` and `type` as texts, positions and directions as triples."""
    kinds: list[Any] = []
    for name, values in columns.items():
        if name in ("id", "type"):
            kinds.append((name, f"U{max(map(len, values), default=1) or 1}"))
        else:
            kind = _TYPES.get(name, np.float64)
            kinds.append((name, *kind) if isinstance(kind, tuple) else (name, kind))
    count = len(next(iter(columns.values())))
    table = np.zeros(count, dtype=kinds)
    for name, values in columns.items():
        if count:
            table[name] = values
    table.flags.writeable = False
    return table


def ids_of(table: Records) -> list[str]:
    """The ids of a table."""
    return [str(one) for one in table["id"]]


def numbers(chosen: Chosen, ids: Sequence[str], kind: str) -> list[int]:
    """The numbers of chosen members of a table, in their order."""
    names = chosen.dtype.names if isinstance(chosen, (np.void, np.ndarray)) else None
    expect(names is None and not isinstance(chosen, np.void) or "id" in (names or ()), "has no field 'id'", kind)
    if isinstance(chosen, np.void):
        chosen = [str(chosen["id"])]
    elif isinstance(chosen, (str, int, np.integer)):
        chosen = [chosen]
    members = chosen["id"] if isinstance(chosen, np.ndarray) and chosen.dtype.names else chosen
    members = members.tolist() if isinstance(members, np.ndarray) else list(members)
    if members and all(isinstance(one, (bool, np.bool_)) for one in members):
        expect(len(members) == len(ids), f"is a mask of {len(members)} values instead of {len(ids)}", kind)
        return [k for k, one in enumerate(members) if one]
    places = {id: k for k, id in enumerate(ids)}
    found = []
    for one in members:
        if isinstance(one, np.void):
            one = str(one["id"])
        try:
            number = places.get(one, -1) if isinstance(one, str) else operator.index(one)
        except TypeError:
            number = -1
        expect(0 <= number < len(ids), f"has no member {one!r}", kind)
        found.append(number)
    return found


def some_numbers(chosen: Chosen, ids: Sequence[str], kind: str) -> list[int]:
    """The same, of at least one member, each once."""
    found = numbers(chosen, ids, kind)
    expect(bool(found), "has no members", kind)
    expect(len(set(found)) == len(found), "lists a member twice", kind)
    return found


def selected_numbers(chosen: Chosen, ids: Sequence[str]) -> list[int]:
    """The columns of a selection, ascending."""
    found = sorted(numbers(chosen, ids, "selection"))
    expect(len(set(found)) == len(found), "lists a unit twice", "selection")
    return found


def floats(values: Any, name: str) -> NDArray[np.float64]:
    """An array of numbers."""
    expect(not isinstance(values, np.ma.MaskedArray), "is a masked array: fill it", name)
    try:
        expect(not np.iscomplexobj(values), "is complex", name)
        return np.asarray(values, dtype=np.float64)
    except InputError:
        raise
    except (TypeError, ValueError) as error:
        raise make("input", f"is not an array of numbers: {error}", 2, "", name) from None


def decibels(ratio: Any) -> NDArray[np.float64]:
    """10 log10 of a ratio; -inf for 0."""
    with np.errstate(divide="ignore"):
        return np.asarray(10 * np.log10(ratio), dtype=np.float64)


class Result:
    """A result with the representations of a notebook, and its fields as a dictionary."""

    def to_dict(self) -> dict[str, Any]:
        """The fields, with arrays as lists."""
        names = [field.name for field in fields(self)] if is_dataclass(self) else [n for n in vars(self) if n[0] != "_"]
        return {name: plain(getattr(self, name)) for name in names}

    def _repr_html_(self) -> str:
        return f"<p>{html.escape(repr(self)[1:-1])}</p>"


def plain(value: Any) -> Any:
    """Arrays as lists, records as dictionaries."""
    if getattr(getattr(value, "dtype", None), "names", None):
        return [{name: plain(row[name]) for name in value.dtype.names} for row in value]
    if hasattr(value, "tolist"):
        return value.tolist()
    return value.to_dict() if isinstance(value, Result) else value
