"""Matplotlib's pictures as parts of the page: in its colours and type, and identical in every run."""

import io
import itertools
import re

import matplotlib
from cycler import cycler

from study.core.page import STYLE
from study.core.text import escape

_NAMES = list(dict.fromkeys(re.findall(r"--([\w-]+):#", STYLE.read_text(encoding="utf-8"))))
_NUMBERS = itertools.count()


def colour(name):
    """A placeholder for a colour of page.css, which `svg` replaces by its name there (for light and dark pages)."""
    return f"#5b{_NAMES.index(name):04x}"


matplotlib.rcParams.update(
    {
        "axes.autolimit_mode": "round_numbers",
        "axes.axisbelow": True,
        "axes.edgecolor": colour("edge"),
        "axes.facecolor": "none",
        "axes.grid": True,
        "axes.grid.axis": "y",
        "axes.labelcolor": colour("muted"),
        "axes.labelpad": 12,
        "axes.prop_cycle": cycler(color=[colour(f"s{k}") for k in range(4)])
        + cycler(linestyle=["-", (0, (4, 1.5)), (0, (1.5, 1.5)), (0, (5, 1.5, 1, 1.5))])
        + cycler(marker=["o", "^", "s", "D"]),
        "axes.spines.left": False,
        "axes.spines.right": False,
        "axes.spines.top": False,
        "axes.titlecolor": colour("muted"),
        "axes.titlelocation": "left",
        "axes.titlesize": "medium",
        "axes.titlepad": 14,
        "axes.xmargin": 0,
        "axes.ymargin": 0,
        "figure.constrained_layout.use": True,
        "figure.dpi": 72,
        "figure.facecolor": "none",
        "font.size": 14,
        "grid.color": colour("line"),
        "legend.borderaxespad": 0,
        "legend.frameon": False,
        "legend.handlelength": 3,
        "legend.labelcolor": colour("muted"),
        "lines.linewidth": 2,
        "lines.markeredgecolor": colour("card"),
        "lines.markersize": 10,
        "text.color": colour("ink"),
        "xtick.color": colour("edge"),
        "xtick.major.pad": 6,
        "xtick.labelcolor": colour("muted"),
        "ytick.color": colour("edge"),
        "ytick.labelcolor": colour("muted"),
        "ytick.left": False,
    }
)


def svg(figure, description, css_class):
    """The picture as SVG with unique identifiers. A picture without a description is decorative."""
    text = io.StringIO()
    with matplotlib.rc_context({"svg.fonttype": "none", "svg.hashsalt": str(next(_NUMBERS))}):
        figure.savefig(text, format="svg", metadata=dict.fromkeys(("Creator", "Date", "Format", "Type")))
    body = re.sub(r"<metadata>.*?</metadata>|<style.*?</style>|<!--.*?-->", "", text.getvalue(), flags=re.DOTALL)
    body = re.sub(r'<g id="[^"]*"', "<g", body).replace("xlink:href", "href")
    body = re.sub("<[^>]*>", lambda tag: re.sub(r"(?<=\.\d\d)\d+", "", tag[0]), body)  # precise enough for positions
    body = re.sub("#5b([0-9a-f]{4})", lambda found: f"var(--{_NAMES[int(found[1], 16)]})", body)
    view, content = re.search(r'<svg [^>]*(viewBox="[^"]*")[^>]*>(.*)', body, flags=re.DOTALL).groups()
    label = f'role="img" aria-label="{escape(description)}"' if description else 'aria-hidden="true"'
    return f'<svg {view} class="{css_class}" {label}>{content}'
