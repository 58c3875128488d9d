"""Comparison of measured with simulated signals."""

from __future__ import annotations

import csv
import html
import json
import os
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path as FilePath
from typing import Any

from . import _core
from .errors import InputError, expect
from .options import Path
from .placement import Selection, columns_of
from .signals import Signals
from .tables import Result

_LEAST, _MOST = 0.5, 0.9999  # of the confidence
_CSV, _PAGE = "comparison.csv", "comparison.html"


class Comparison(Result):
    """The factor between measured and simulated signals (docs/methods/comparison.md)."""

    def __init__(self, found: dict[str, Any]) -> None:
        self._content: dict[str, Any] = json.loads(found["json"])
        self.statements: list[str] = found["statements"]  #: sentences
        self.factor: float = self._content["factor"]  #: measured / simulated
        self.interval: tuple[float, float] = (self._content["factor_low"], self._content["factor_high"])
        self.spread_db: float = self._content["spread_db"]  #: in excess of all known errors
        self.outliers: list[dict[str, Any]] = self._content["outliers"]  #: pairs, largest residual first
        self.worst: list[dict[str, Any]] = self._content["worst"]  #: the other pairs, largest residual first
        self.csv: str = found["csv"]  #: a row per pair
        self.html: str = found["html"]  #: the page

    def save(self, folder: Path) -> None:
        """Writes comparison.csv and comparison.html into a folder."""
        FilePath(folder).mkdir(parents=True, exist_ok=True)
        _core.write_text(self.csv, FilePath(folder) / _CSV)
        _core.write_text(self.html, FilePath(folder) / _PAGE)

    def to_dict(self) -> dict[str, Any]:
        """What `shelfbeam compare --json` prints."""
        return dict(self._content)

    def _repr_html_(self) -> str:
        return f'<iframe srcdoc="{html.escape(self.html)}" width="100%" height="700"></iframe>'

    def __repr__(self) -> str:
        return f"<Comparison: {self.statements[0]}>"


def compare(signals: Signals, measured: Path | Mapping[str, Sequence[Any]],
            placement: Selection | None = None, *, confidence: float = 0.95) -> Comparison:  # fmt: skip
    """Fits the factor between measurements and signals, and finds outliers (`shelfbeam compare`).

    `measured`: a CSV with the columns label, transceiver, signal, and optionally error, or a mapping of these names to
    sequences, such as a pandas.DataFrame. Without `transceiver`, the units of `placement` were on at once.
    """
    expect(_LEAST <= confidence <= _MOST, f"is not from {_LEAST} to {_MOST}", "confidence")
    units = placement
    columns = [] if units is None else columns_of(units, _core.Table.of_signals(signals._core))
    if isinstance(measured, (str, os.PathLike)):
        return Comparison(_core.compare(signals._core, measured, columns, confidence))
    names = [name for name in ("label", "transceiver", "signal", "error") if name in measured]
    expect({"label", "signal"} <= set(names), "has no 'label' and 'signal': add them", "measured")
    expect(len({len(measured[name]) for name in names}) == 1, "has columns of different lengths", "measured")
    with tempfile.TemporaryDirectory() as folder:
        path = FilePath(folder) / "measured.csv"
        with path.open("w", newline="", encoding="utf-8") as file:
            rows = csv.writer(file)
            rows.writerow(names)
            rows.writerows(zip(*(measured[name] for name in names)))
        try:
            return Comparison(_core.compare(signals._core, path, columns, confidence))
        except InputError as error:
            text, where = (text.replace(str(path), "measured") for text in (str(error), error.where))
            raise InputError(text, error.code, where, error.setting) from None
