"""Maps of labels and units: with Matplotlib, and as SVG for notebooks."""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .errors import expect

if TYPE_CHECKING:
    from .signals import Signals

_REACHED, _CLOSE, _MISSED = "#2a7f62", "#d9a514", "#b3261e"
_CLOSE_DB = 1.0


def coverage(signals: Signals, selection: Any, z: float | None, unit: str, ax: Any,
             problem: Mapping[str, Any]) -> Any:  # fmt: skip
    """See Signals.plot_coverage."""
    from matplotlib import pyplot  # noqa: PLC0415: optional

    from .placement import evaluate  # noqa: PLC0415: needs this module

    found = evaluate(signals, selection, **problem)
    position = signals.labels["position"]
    shown = np.ones(len(position), dtype=bool) if z is None else np.isclose(position[:, 2], z, atol=0.005)
    expect(
        bool(shown.any()), f"there are no labels at {z} m; heights: {np.unique(position[:, 2].round(3)).tolist()}", "z"
    )
    values = {"dB": (found.margin_db, "margin (dB)"), "W/m2": (found.signal, "signal (W/m²)")}
    expect(unit in values, f"is {unit!r} instead of dB or W/m2", "unit")
    value, name = values[unit]
    figure = None if ax is not None else pyplot.figure(figsize=(7, 5), layout="constrained")
    ax = ax if figure is None else figure.add_subplot()
    x, y, colour = position[shown, 0], position[shown, 1], value[shown]
    finite = np.where(np.isfinite(colour), colour, np.nanmin(colour[np.isfinite(colour)], initial=0))
    filled = _is_plane(signals.labels["normal"][shown]) and _on_grid(x, y)
    if filled:
        marks = ax.tricontourf(x, y, finite, levels=20, cmap="viridis")
    else:
        marks = ax.scatter(x, y, c=finite, s=8, cmap="viridis")
    ax.figure.colorbar(marks, ax=ax, label=name)
    if unit == "dB" and filled and finite.min() < 0 < finite.max():
        ax.tricontour(x, y, finite, levels=[0], colors="white", linewidths=1)
    for outline in _outlines(signals):
        ax.fill(*np.array(outline).T, fill=False, edgecolor="black", linewidth=0.6)
    units = signals.units["position"][found.selected]
    ax.plot(units[:, 0], units[:, 1], "^", color="crimson", markeredgecolor="white", label="units")
    ax.set(xlabel="x (m)", ylabel="y (m)", aspect="equal")
    return ax.figure


def fitted(svg: str) -> str:
    """A drawing that is not wider than its place."""
    return svg.replace("<svg ", '<svg style="max-width: 100%; height: auto" ', 1)


def placement_html(answer: str, signals: Signals | None, selection: Any) -> str:
    """The answer, and the floor plan with the units and the labels coloured by margin."""
    picture = ""
    if signals is not None and len(list(selection)):
        picture = _svg(signals, selection)
    return f"<p>{html.escape(answer)}</p>{picture}"


def _svg(signals: Signals, selection: Any) -> str:
    from .placement import evaluate  # noqa: PLC0415: needs this module

    found = evaluate(signals, selection)
    labels, units = signals.labels["position"], signals.units["position"][found.selected]
    outlines = _outlines(signals)
    every = np.concatenate([labels[:, :2], units[:, :2], *(np.array(one) for one in outlines)])
    (x0, y0), (x1, y1) = every.min(axis=0), every.max(axis=0)
    size = max(x1 - x0, y1 - y0, 1e-6)

    def at(x: float, y: float) -> tuple[float, float]:
        return 10 + 580 * (x - x0) / size, 10 + 580 * (y1 - y) / size

    def points(polygon: Sequence[Sequence[float]]) -> str:
        return " ".join("{:.1f},{:.1f}".format(*at(x, y)) for x, y in polygon)

    parts = [f'<polygon points="{points(one)}" fill="none" stroke="#777"/>' for one in outlines]
    for (x, y, _), margin in zip(labels, found.margin_db):
        colour = _MISSED if margin < 0 else _CLOSE if margin < _CLOSE_DB else _REACHED
        u, v = at(x, y)
        parts.append(f'<circle cx="{u:.1f}" cy="{v:.1f}" r="2" fill="{colour}"/>')
    for (x, y, _), id in zip(units, signals.units["id"][found.selected]):
        u, v = at(x, y)
        parts.append(f'<path d="M{u:.1f} {v - 7:.1f}l6 11h-12z" fill="#1f4e9c" stroke="#fff"/>')
        parts.append(f'<text x="{u + 8:.1f}" y="{v:.1f}" font-size="11">{html.escape(str(id))}</text>')
    width, height = 80 + 580 * (x1 - x0) / size, 20 + 580 * (y1 - y0) / size
    return fitted(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" width="{width:.0f}" '
        f'font-family="sans-serif">{"".join(parts)}</svg>'
    )


def _outlines(signals: Signals) -> list[Any]:
    if signals.scene is None:
        return []
    room = signals.scene.room_outline
    fixtures = [corners for _, corners, _ in signals.scene.outlines if len(corners) > 1]
    return ([room] if room else []) + fixtures


def _is_plane(normals: NDArray[Any]) -> bool:
    """Whether all labels face the same way; those on both sides of shelves have nothing between them."""
    return bool(np.allclose(normals, normals[0]))


def _on_grid(x: NDArray[Any], y: NDArray[Any]) -> bool:
    """Whether the points fill most of a grid, so that they can be a filled map."""
    columns, rows = len(np.unique(x.round(6))), len(np.unique(y.round(6)))
    return min(columns, rows) > 2 and len(x) > 0.5 * columns * rows  # noqa: PLR2004
