"""Floor plans of the store, with marks for labels and transceivers."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from study.core.text import escape
from study.draw.picture import colour, svg

SCALE = 40 / 72  # inches per metre
MARGIN = 0.2  # m
CLASSES = 8
DECADES = 2  # span of the signal classes


def _mark(shape, size, fill, edge, width):
    fills = "none" if fill == "none" else colour(fill)
    return {"marker": shape, "ms": size, "mfc": fills, "mec": colour(edge), "mew": width}


STAR = [(0, 15), (4, 4), (15, 0), (4, -4), (0, -15), (-4, -4), (-15, 0), (-4, 4), (0, 15)]
# Sizes in picture units, 40 per metre.
MARKS = {f"g{k}": _mark("o", 10 + 2.2 * k, f"g{k}", "edge", 0.6) for k in range(CLASSES)} | {
    "gz": _mark("o", 7, "none", "edge", 1),
    "faint": _mark("o", 6, "cand", "cand", 0),
    "missed": _mark("^", 20, "low", "strong", 1.4),
    "once": _mark("o", 14, "mid", "edge", 0.8),
    "often": _mark("o", 19, "high", "edge", 0.8),
    "unit": _mark("o", 30, "unit", "floor", 2.5),
    "source": _mark(STAR, 30, "source", "floor", 1.5),
    "cross": _mark("+", 12, "cand", "cand", 1.2),
}


def signal_class(share):
    """The class of a signal, given as a share of the strongest: 7 is the highest; -1 is below all classes."""
    if share <= 0:
        return -1
    return min(CLASSES - 1, int(np.floor(CLASSES * (1 + np.log10(share) / DECADES) + 1e-9)))


def class_floor(k):
    return 10 ** (DECADES * (k / CLASSES - 1))


def _plan(left, right, low, high):
    """Axes without a frame, in metres."""
    figure = Figure(figsize=(SCALE * (right - left), SCALE * (high - low)), layout="none")
    axes = figure.add_axes((0, 0, 1, 1), xlim=(left, right), ylim=(low, high))
    axes.set_axis_off()
    return axes


def _draw(axes, symbol, points):
    axes.plot(*np.reshape(points, (-1, 2)).T, linestyle="none", clip_on=False, **MARKS[symbol])


class StoreMap:
    def __init__(self, store):
        self.store = store
        self.width, self.depth = store["room"]["size"][:2]

    def picture(self, layers, description):
        """Draws layers of (symbol, points k x 2) on top of each other, and numbers the transceivers."""
        axes = _plan(-MARGIN, self.width + MARGIN, -MARGIN, self.depth + MARGIN)
        axes.add_patch(Rectangle((0, 0), self.width, self.depth, fc=colour("floor"), ec=colour("edge"), lw=1.6))
        for fixture in self.store["fixtures"]:
            fill = colour("fx-f" if fixture["type"] == "freezer" else "fx")
            size = fixture["length"], fixture["depth"]
            axes.add_patch(Rectangle(fixture["at"], *size, fc=fill, ec=colour("fx-line"), lw=0.8))
        for symbol, points in layers:
            _draw(axes, symbol, points)
            if symbol == "unit":
                for k, point in enumerate(points, 1):
                    axes.text(*point, k, color=colour("unit-ink"), size=19, weight="bold", ha="center", va="center")
        return svg(axes.figure, description, "m")

    def places(self, signals):
        """Positions of the label marks (m x 2), each on its own side of the shelf."""
        return signals.labels[:, :2] + 0.12 * signals.normals[:, :2]

    def signals(self, signals, rows, column, strongest, threshold, description):
        """Draws one transceiver's signal at some labels; with a threshold, only at the labels that it reaches."""
        places = self.places(signals)[rows]
        values = signals.mean[rows, column]
        classes = [signal_class(value / strongest) for value in values]
        symbols = np.array([f"g{k}" if k >= 0 else "gz" for k in classes], dtype=object)
        if threshold is not None:
            symbols[values < threshold[rows]] = "faint"
        layers = [(symbol, places[symbols == symbol]) for symbol in MARKS if symbol in symbols]
        return self.picture([*layers, ("source", signals.units[column, :2])], description)


def _key(symbol):
    axes = _plan(-0.4, 0.4, -0.4, 0.4)
    _draw(axes, symbol, (0, 0))
    return svg(axes.figure, "", "key")


def legend(items):
    """A legend of symbols and their meanings."""
    keys = "".join(f"<li>{_key(symbol)}{escape(words)}</li>" for symbol, words in items)
    return f'<ul class="legend">{keys}</ul>\n'


def signal_legend():
    classes = [(f"g{k}", f"from {100 * class_floor(k):.2g} %") for k in reversed(range(CLASSES))]
    return legend([("source", "the transceiver"), *classes, ("gz", "less"), ("faint", "below the threshold")])
