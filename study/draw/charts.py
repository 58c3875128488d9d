"""Charts with axes: histograms and lines."""

from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator, NullLocator
from matplotlib.transforms import offset_copy

from study.draw.picture import colour, svg

SIZE = (7.8, 4.7)  # inches of 72 units


def axes(x_title, y_title, log="", percent="", x_ticks=None):
    """Axes in a separate figure; `log` and `percent` name the logarithmic and the percent axes: "", "x", "y" or "xy".

    With `x_ticks`, the axis ends just beyond them.
    """
    result = Figure(figsize=SIZE).add_subplot()
    result.set_xlabel(x_title)
    result.set_title(y_title)
    for name, axis in (("x", result.xaxis), ("y", result.yaxis)):
        if name in log:
            getattr(result, f"set_{name}scale")("log")
            axis.set_minor_locator(NullLocator())
        else:
            axis.set_major_locator(MaxNLocator(6, steps=[1, 2, 5, 10]))
        axis.set_major_formatter((lambda share, _: f"{100 * share:g} %") if name in percent else "{x:,g}")
    if x_ticks is not None:
        scale = result.xaxis.get_transform()
        low, high = scale.transform([min(x_ticks), max(x_ticks)])
        margin = 0.05 * (high - low)
        result.set_xticks(x_ticks)
        result.set_xlim(scale.inverted().transform([low - margin, high + margin]))
    return result


def chart(drawn, description):
    """The axes as a picture, with a legend of the labelled lines below it."""
    if drawn.get_legend_handles_labels()[0]:
        below = offset_copy(drawn.transAxes, drawn.figure, y=-60, units="points")
        drawn.legend(loc="upper left", bbox_to_anchor=(0, 0), bbox_transform=below)
    return svg(drawn.figure, description, "chart")


def histogram(edges, counts, x_title, y_title, description, mark=None, log="", ticks=None, most=None):
    """`mark` is a value of x and its name; `most` is the top of the count axis, to compare charts."""
    drawn = axes(x_title, y_title, log)
    bars = [(low, high - low, count) for low, high, count in zip(edges, edges[1:], counts) if count]
    starts, widths, heights = zip(*bars)
    # The outline keeps a bar of one count visible beside large ones.
    drawn.bar(starts, heights, [0.92 * width for width in widths], align="edge", ec=colour("s0"), lw=0.8)
    drawn.set_xlim(edges[0], edges[-1])
    drawn.set_ylim(0, 1.05 * (most or max(counts)))
    if ticks is not None:
        drawn.set_xticks(ticks)
    if mark:
        value, words = mark
        drawn.axvline(value, color=colour("strong"), lw=1.6, linestyle=(0, (3, 2)))
        drawn.text(value, 1.02, words, weight="bold", ha="center", transform=drawn.get_xaxis_transform())
    return chart(drawn, description)
