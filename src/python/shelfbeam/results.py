"""What all results have in common."""

from __future__ import annotations

import html
from dataclasses import fields, is_dataclass
from typing import Any


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
