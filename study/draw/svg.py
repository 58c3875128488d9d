"""Pieces of SVG. Colours and sizes of text come from the classes of page.css."""

from study.core.text import escape


def number(value):
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def picture(width, height, css_class, description, body):
    return (
        f'<svg viewBox="0 0 {number(width)} {number(height)}" class="{css_class}" role="img" '
        f'aria-label="{escape(description)}">\n{body}</svg>\n'
    )


def line(x1, y1, x2, y2, css_class):
    return f'<path class="{css_class}" d="M{number(x1)} {number(y1)}L{number(x2)} {number(y2)}"/>\n'


def path(points, css_class):
    return (
        f'<path class="{css_class}" d="M' + "L".join(f"{number(x)} {number(y)}" for x, y in points) + '"/>\n'
    )


def rect(x, y, width, height, css_class, title=""):
    head = (
        f'<rect class="{css_class}" x="{number(x)}" y="{number(y)}" width="{number(width)}" '
        f'height="{number(height)}"'
    )
    return f"{head}><title>{escape(title)}</title></rect>\n" if title else f"{head}/>\n"


def text(x, y, words, css_class="t"):
    return f'<text class="{css_class}" x="{number(x)}" y="{number(y)}">{escape(words)}</text>\n'


def use(symbol, x, y, title=""):
    head = f'<use href="#{symbol}" x="{number(x)}" y="{number(y)}"'
    return f"{head}><title>{escape(title)}</title></use>\n" if title else f"{head}/>\n"
