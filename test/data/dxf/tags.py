"""DXF files as text."""


def tags(*pairs):
    return "".join(f"{code}\n{value}\n" for code, value in zip(pairs[::2], pairs[1::2]))


def section(name, *content):
    return tags(0, "SECTION", 2, name) + "".join(content) + tags(0, "ENDSEC")


def line(x0, y0, x1, y1, layer="0"):
    return tags(0, "LINE", 8, layer, 10, x0, 20, y0, 11, x1, 21, y1)


def insert(name, *more):
    return tags(0, "INSERT", 8, "0", 2, name, 10, 0, 20, 0, *more)


def block(name, *content):
    return tags(0, "BLOCK", 8, "0", 2, name, 70, 0, 10, 0, 20, 0) + "".join(content) + tags(0, "ENDBLK")


END = tags(0, "EOF")
