"""Charts with axes: histograms, bars and lines, in one frame of 560 x 340."""

import math

from study.draw import svg

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 560, 340, 76, 30, 48, 62
SHAPES = (
    "M0 -5.5A5.5 5.5 0 1 1 0 5.5A5.5 5.5 0 1 1 0 -5.5Z",
    "M0 -7L6.5 5H-6.5Z",
    "M-5 -5H5V5H-5Z",
    "M0 -7L7 0L0 7L-7 0Z",
)


def round_step(most, steps=4.5):
    """A step of 1, 2 or 5 times a power of ten that gives about so many ticks."""
    raw = most / steps
    power = 10 ** math.floor(math.log10(raw)) if raw > 0 else 1
    return next(k * power for k in (1, 2, 5, 10) if k * power >= raw * 0.999)


def decades(low, high):
    return [
        10.0**k for k in range(math.floor(math.log10(low) + 1e-9), math.ceil(math.log10(high) - 1e-9) + 1)
    ]


def short(value):
    """A tick's number."""
    if value == 0:
        return "0"
    if abs(value) >= 1000:
        return f"{value:,.0f}"
    return f"{value:.10g}" if abs(value) >= 0.001 else f"{value:.0e}".replace("e-0", "e-")


class Chart:
    def __init__(self, x_range, y_range, x_title, y_title, log_x=False, log_y=False):
        self.x_range, self.y_range = x_range, y_range
        self.log_x, self.log_y = log_x, log_y
        self.x_title, self.y_title = x_title, y_title
        self.grid, self.body = "", ""

    @staticmethod
    def _share(value, low_high, is_log):
        low, high = low_high
        if is_log:
            value, low, high = math.log(value), math.log(low), math.log(high)
        return (value - low) / (high - low)

    def x(self, value):
        return LEFT + self._share(value, self.x_range, self.log_x) * (WIDTH - LEFT - RIGHT)

    def y(self, value):
        return HEIGHT - BOTTOM - self._share(value, self.y_range, self.log_y) * (HEIGHT - TOP - BOTTOM)

    def ticks(self, x_ticks, y_ticks, x_words=None, y_words=None):
        floor = HEIGHT - BOTTOM
        for value, words in zip(y_ticks, y_words or map(short, y_ticks)):
            self.grid += svg.line(LEFT, self.y(value), WIDTH - RIGHT, self.y(value), "grid")
            self.grid += svg.text(LEFT - 8, self.y(value) + 4, words, "t end")
        for value, words in zip(x_ticks, x_words or map(short, x_ticks)):
            self.grid += svg.line(self.x(value), floor, self.x(value), floor + 5, "tick")
            self.grid += svg.text(self.x(value), floor + 22, words, "t mid")
        return self

    def bar(self, low, high, height, css_class="bar", title=""):
        if height <= 0:
            return
        floor = HEIGHT - BOTTOM
        top = min(self.y(height), floor - 1)  # a single count among many stays visible
        left, right = self.x(low), self.x(high)
        self.body += svg.rect(left + 0.5, top, max(right - left - 1, 0.8), floor - top, css_class, title)

    def line(self, points, series, titles=None):
        """A line with marks: series 0 to 3 have their colour, dashes and shape."""
        places = [(self.x(x), self.y(y)) for x, y in points]
        self.body += svg.path(places, f"line s{series}")
        for k, (x, y) in enumerate(places):
            title = f"<title>{titles[k]}</title>" if titles else ""
            self.body += (
                f'<path class="dot s{series}" transform="translate({svg.number(x)} {svg.number(y)})" '
                f'd="{SHAPES[series]}">{title}</path>\n'
            )

    def guide(self, points):
        self.body += svg.path([(self.x(x), self.y(y)) for x, y in points], "guide")

    def mark(self, value, words):
        """A dashed line at a value of x."""
        x = self.x(value)
        to_left = x > (LEFT + WIDTH) / 2
        self.body += svg.line(x, TOP - 14, x, HEIGHT - BOTTOM, "mark")
        self.body += svg.text(
            x + (-6 if to_left else 6), TOP - 2, words, "t strong end" if to_left else "t strong"
        )

    def svg(self, description):
        floor = HEIGHT - BOTTOM
        axis = svg.line(LEFT, floor, WIDTH - RIGHT, floor, "axis")
        titles = svg.text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 10, self.x_title, "t mid")
        titles += svg.text(8, 18, self.y_title)
        return svg.picture(WIDTH, HEIGHT, "chart", description, self.grid + self.body + axis + titles)


def histogram(
    edges, counts, x_title, y_title, description, mark=None, ticks=None, words=None, log_x=False, most=None
):
    most = most or max(1, max(counts))
    step = round_step(most)
    chart = Chart((edges[0], edges[-1]), (0, 1.05 * most), x_title, y_title, log_x=log_x)
    chart.ticks(ticks, [k * step for k in range(int(most / step) + 1)], words)
    for low, high, count in zip(edges, edges[1:], counts):
        chart.bar(low, high, count, "bar", f"{short(low)} to {short(high)}: {count:,}")
    if mark:
        chart.mark(*mark)
    return chart.svg(description)


def series_legend(names):
    items = ""
    for k, name in enumerate(names):
        items += (
            f'<li><svg class="key" viewBox="-16 -16 32 32" aria-hidden="true"><path class="line s{k}" '
            f'd="M-15 0H15"/><path class="dot s{k}" d="{SHAPES[k]}"/></svg>{name}</li>'
        )
    return f'<ul class="legend">{items}</ul>\n'
