"""Numbers and lists in words."""

from html import escape as _escape


def escape(text):
    return _escape(str(text), quote=True)


def grouped(number):
    return f"{number:,}"


def percent(share, digits=0):
    return f"{100 * share:.{digits}f}\u00a0%"


def plural(count, noun, nouns=None):
    return f"{grouped(count)} {noun if count == 1 else nouns or noun + 's'}"


def listed(items):
    """a, b and c"""
    items = [str(item) for item in items]
    return items[0] if len(items) == 1 else ", ".join(items[:-1]) + " and " + items[-1]


def spread(values, form):
    """The smallest and the largest value, or one value if both are equal."""
    low, high = form(min(values)), form(max(values))
    return low if low == high else f"{low} to {high}"


def seconds(value):
    return f"{value:.2f} s" if value < 10 else f"{value:.0f} s"


def minus(value, digits=2):
    """A number with a true minus sign."""
    return f"{value:.{digits}f}".replace("-", "−")
