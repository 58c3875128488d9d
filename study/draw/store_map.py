"""Floor plans: the store once, and marks for labels and transceivers on it."""

import numpy as np

from study.draw import svg
from study.core.text import escape

SCALE = 40  # units of the picture a metre
MARGIN = 8
CLASSES = 8
DECADES = 2  # that the classes of signal span


def signal_class(share):
    """The class of a signal, given as a share of the strongest: 7 is the highest, -1 below all."""
    if share <= 0:
        return -1
    return min(CLASSES - 1, int(np.floor(CLASSES * (1 + np.log10(share) / DECADES) + 1e-9)))


def class_floor(k):
    return 10 ** (DECADES * (k / CLASSES - 1))


class StoreMap:
    def __init__(self, store):
        self.store = store
        self.width, self.depth = store["room"]["size"][:2]

    def at(self, x, y):
        return MARGIN + SCALE * x, MARGIN + SCALE * (self.depth - y)

    def definitions(self):
        """Marks and the store itself, for all maps of a page."""
        marks = "".join(
            f'<g id="g{k}"><circle class="k g" style="fill:var(--g{k})" r="{5 + 1.1 * k:.1f}"/></g>\n'
            for k in range(CLASSES)
        )
        marks += (
            '<g id="gz"><circle class="k gz" r="3.5"/></g>\n<g id="faint"><circle class="k faint"'
            ' r="3"/></g>\n'
        )
        marks += '<g id="missed"><path class="k missed" d="M0 -12L10.5 6H-10.5Z"/></g>\n'
        marks += (
            '<g id="once"><circle class="k once" r="7"/></g>\n<g id="often"><circle class="k often"'
            ' r="9.5"/></g>\n'
        )
        marks += (
            '<g id="lost"><circle class="k lost" r="9"/></g>\n<g id="won"><circle class="k won" r="9"/></g>\n'
        )
        marks += '<g id="unit"><circle class="k unit" r="15"/></g>\n'
        marks += (
            '<g id="source"><path class="k source" d="M0 -15L4 -4L15 0L4 4L0 15L-4 4L-15 0L-4 -4Z"/></g>\n'
        )
        marks += '<g id="cross"><path class="cand" d="M-6 0h12m-6 -6v12"/></g>\n'
        return (
            f'<svg class="defs" width="0" height="0" aria-hidden="true"><defs>\n{marks}'
            f'<g id="store-layer">\n{self._store()}</g>\n</defs></svg>\n'
        )

    def _store(self):
        x, y = self.at(0, self.depth)
        body = svg.rect(x, y, SCALE * self.width, SCALE * self.depth, "floor")
        for fixture in self.store["fixtures"]:
            left, top = self.at(fixture["at"][0], fixture["at"][1] + fixture["depth"])
            body += svg.rect(
                left, top, SCALE * fixture["length"], SCALE * fixture["depth"], f"fx {fixture['type']}"
            )
        return body

    def picture(self, marks, description, css_class="m"):
        return svg.picture(
            2 * MARGIN + SCALE * self.width,
            2 * MARGIN + SCALE * self.depth,
            css_class,
            description,
            '<use href="#store-layer"/>\n' + marks,
        )

    def label_place(self, position, normal):
        """Where a label's mark stands: on its own side of the shelf."""
        return self.at(position[0] + 0.12 * normal[0], position[1] + 0.12 * normal[1])

    def signals(self, signals, rows, column, strongest, threshold=None):
        """Marks of one transceiver's signal at some labels; with a threshold only of those that it reaches."""
        body = ""
        for i in rows:
            value = signals.mean[i, column]
            if threshold is not None and value < threshold[i]:
                symbol = "faint"
            else:
                k = signal_class(value / strongest)
                symbol = f"g{k}" if k >= 0 else "gz"
            body += svg.use(symbol, *self.label_place(signals.labels[i], signals.normals[i]))
        return body + svg.use("source", *self.at(*signals.units[column, :2]))

    def units(self, positions):
        body = ""
        for k, position in enumerate(positions):
            x, y = self.at(*position[:2])
            body += svg.use("unit", x, y) + svg.text(x, y, k + 1, "num")
        return body

    def crosses(self, positions):
        return "".join(svg.use("cross", *self.at(*position[:2])) for position in positions)

    def labels(self, signals, rows, symbols):
        return "".join(
            svg.use(symbol, *self.label_place(signals.labels[i], signals.normals[i]))
            for i, symbol in zip(rows, symbols)
        )


def key(symbol, words):
    return (
        f'<li><svg class="key" viewBox="-16 -16 32 32" aria-hidden="true"><use href="#{symbol}"/></svg>'
        f"{escape(words)}</li>"
    )


def legend(items):
    return '<ul class="legend">' + "".join(key(*item) for item in items) + "</ul>\n"


def signal_legend():
    def words(k):
        return f"{100 * class_floor(k):.2g} %"

    return legend(
        [("source", "the transceiver")]
        + [(f"g{k}", f"from {words(k)}") for k in reversed(range(CLASSES))]
        + [("gz", "less"), ("faint", "below the threshold")]
    )
