"""Usage: dxf_corpus.py FOLDER

Writes DXF files, and expected.json with what ezdxf (0.18 or later) says about each: the length and the bounds of the
lines of each layer, the texts, the unit, or the code of the error. Files that ezdxf cannot write are written by hand.
"""

import json
import math
import pathlib
import re
import sys

import ezdxf
from ezdxf import path as paths
from ezdxf.math import OCS, Matrix44, Vec3

folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)
expected = {}

VERSIONS = ["R12", "R2000", "R2004", "R2007", "R2010", "R2013", "R2018"]
SHOWN_TEXTS = ("TEXT", "ATTRIB", "MTEXT")


# What ezdxf says.


def points_of(entity):
    """Polylines that show an entity in the coordinates of its block."""
    kind = entity.dxftype()
    if kind in ("SOLID", "TRACE", "3DFACE"):
        yield list(entity.wcs_vertices(close=True))
    elif kind == "LEADER":
        yield [Vec3(vertex) for vertex in entity.vertices]
    elif kind == "SPLINE":
        # Its path would run through the ends of the control polygon, even where the spline does not.
        yield list(entity.construction_tool().approximate(2000))
    elif kind in ("MLINE", "DIMENSION"):
        for part in entity.virtual_entities():
            yield from points_of(part)
    elif kind == "HATCH":
        ocs, elevation = entity.ocs(), entity.dxf.elevation.z
        for boundary in entity.paths:
            # Edge by edge, because ezdxf joins the edges of a path.
            for points in edges_of(boundary) if hasattr(boundary, "edges") else [polyline_of(boundary)]:
                yield [ocs.to_wcs(Vec3(point.x, point.y, elevation)) for point in points]
    elif kind not in SHOWN_TEXTS and kind not in ("INSERT", "ATTDEF", "POINT", "VIEWPORT"):
        yield fine(paths.make_path(entity))


def polyline_of(boundary):
    path = paths.Path()
    paths.add_2d_polyline(path, boundary.vertices, close=boundary.is_closed, ocs=OCS(), elevation=0)
    return fine(path)


def edges_of(boundary):
    for edge in boundary.edges:
        if hasattr(edge, "start"):
            yield [Vec3(edge.start), Vec3(edge.end)]
        elif hasattr(edge, "radius"):
            yield list(edge.construction_tool().flattening(edge.radius * 1e-5))
        else:
            yield list(edge.construction_tool().flattening(1e-5, 16))


def fine(path):
    corners = list(path.control_vertices())
    size = max((corner - corners[0]).magnitude for corner in corners)
    return list(path.flattening(max(size, 1e-9) * 1e-5, 16))


def unescaped(text):
    return re.sub(r"\\U\+([0-9a-fA-F]{4})", lambda found: chr(int(found[1], 16)), text)


class Walk:
    def __init__(self, doc):
        self.doc = doc
        self.layers = {}
        self.texts = []

    def is_frozen(self, name):
        return name in self.doc.layers and self.doc.layers.get(name).is_frozen()

    def layer(self, name):
        entry = self.doc.layers.get(name) if name in self.doc.layers else None
        is_on = entry is None or (entry.is_on() and not entry.is_frozen())
        empty = {"length": 0, "bounds": [math.inf, math.inf, -math.inf, -math.inf], "texts": 0, "on": is_on}
        return self.layers.setdefault(name, empty)

    def add(self, entities, matrix, inherited="0", forced=None):
        for entity in entities:
            if entity.dxf.get("invisible", 0) or entity.dxf.get("paperspace", 0):
                continue
            name = entity.dxf.layer if entity.dxf.layer != "0" else inherited
            shown = forced or name
            kind = entity.dxftype()
            if kind == "INSERT":
                hidden = forced or (name if self.is_frozen(name) else None)
                for one in entity.multi_insert() if entity.mcount > 1 else [entity]:
                    if one.block() is not None:
                        self.add(one.block(), one.matrix44() * matrix, name, hidden)
                self.add(entity.attribs, matrix, inherited, forced)
                continue
            if kind == "DIMENSION":
                self.add(entity.virtual_entities(), matrix, name, forced)
                continue
            if kind in SHOWN_TEXTS:
                if not (kind == "ATTRIB" and entity.is_invisible):
                    self.texts.append([shown, unescaped(entity.plain_text())])
                    self.layer(shown)["texts"] += 1
                continue
            for points in points_of(entity):
                self.line(shown, [matrix.transform(Vec3(point)) for point in points])

    def line(self, name, points):
        layer = self.layer(name)
        bounds = layer["bounds"]
        for a, b in zip(points, points[1:]):
            layer["length"] += math.hypot(b.x - a.x, b.y - a.y)
        for point in points:
            bounds[0], bounds[1] = min(bounds[0], point.x), min(bounds[1], point.y)
            bounds[2], bounds[3] = max(bounds[2], point.x), max(bounds[3], point.y)


def facts(doc, unit=None, **more):
    walk = Walk(doc)
    walk.add(doc.modelspace(), Matrix44())
    layers = {
        name: layer if layer["length"] else {**layer, "bounds": None}
        for name, layer in walk.layers.items()
        if layer["length"] or layer["texts"]
    }
    return {"version": doc.dxfversion, "unit": unit, "layers": layers, "texts": sorted(walk.texts), **more}


# Files.


def save(doc, name, unit=None, kind="asc", **more):
    doc.saveas(folder / name, fmt=kind)
    expected[name] = facts(ezdxf.readfile(folder / name), unit, **more)


def write(name, content, **facts_or_error):
    (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
    expected[name] = facts_or_error


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


def new(version="R2010"):
    doc = ezdxf.new(version)
    doc.units = 0
    for name in ("WALL", "ROUND", "FILL", "TEXT", "SHELF"):
        doc.layers.new(name)
    return doc


def shop(space, scale=1.0):
    """A room of 60 m x 40 m with shelves; `scale` is the length of 1 m."""
    space.add_line((0, 0), (60 * scale, 0), dxfattribs={"layer": "WALL"})
    space.add_line((60 * scale, 0), (60 * scale, 40 * scale), dxfattribs={"layer": "WALL"})
    space.add_line((60 * scale, 40 * scale), (0, 40 * scale), dxfattribs={"layer": "WALL"})
    space.add_line((0, 40 * scale), (0, 0), dxfattribs={"layer": "WALL"})
    for k in range(8):
        x, y = (5 + 6 * k) * scale, 5 * scale
        corners = [(x, y), (x + scale, y), (x + scale, y + 25 * scale), (x, y + 25 * scale)]
        for a, b in zip(corners, corners[1:] + corners[:1]):
            space.add_line(a, b, dxfattribs={"layer": "SHELF"})


def mixed(version):
    doc = new(version)
    space = doc.modelspace()
    shop(space)
    layer = {"layer": "ROUND"}
    space.add_circle((10, 50), 4, dxfattribs=layer)
    space.add_arc((20, 50), 4, 30, 300, dxfattribs=layer)
    space.add_arc((30, 50), 4, 300, 30, dxfattribs=layer)
    bent = [(0, 60, 0.5), (10, 60, -0.3), (10, 70, 0), (0, 70, 1)]
    space.add_polyline2d(bent, format="xyb", close=True, dxfattribs={"layer": "SHELF"})
    space.add_polyline2d(bent, format="xyb", dxfattribs={"layer": "SHELF"})
    space.add_polyline3d([(0, 0, 0), (3, 4, 5), (6, 0, 1)], dxfattribs=layer)
    space.add_solid([(40, 50), (45, 50), (40, 55), (45, 55)], dxfattribs={"layer": "FILL"})
    space.add_trace([(50, 50), (55, 50), (50, 55)], dxfattribs={"layer": "FILL"})
    space.add_3dface([(60, 50, 1), (65, 50, 2), (65, 55, 3), (60, 55, 4)], dxfattribs={"layer": "FILL"})
    space.add_text("Plan 1:50", dxfattribs={"layer": "TEXT", "height": 0.5, "insert": (1, 1)})
    space.add_text("90%%d %%c30 %%p5", dxfattribs={"layer": "TEXT", "height": 0.5, "insert": (1, 3)})
    if version == "R12":
        return doc
    space.add_lwpolyline(bent, format="xyb", close=True, dxfattribs={"layer": "WALL"})
    space.add_ellipse((80, 50), (6, 2), 0.4, dxfattribs=layer)
    space.add_ellipse((80, 60), (6, 2), 0.4, 1, 4, dxfattribs=layer)
    space.add_open_spline([(0, 80), (5, 90), (10, 70), (15, 85), (20, 80)], dxfattribs=layer)
    space.add_spline(dxfattribs=layer).set_closed([(30, 80, 0), (35, 90, 0), (40, 70, 0), (45, 85, 0)])
    points = [(50, 80, 0), (55, 90, 0), (60, 70, 0), (65, 80, 0)]
    space.add_spline(dxfattribs=layer).set_open_rational(points, [1, 3, 2, 1])
    hatch = space.add_hatch(dxfattribs={"layer": "FILL"})
    hatch.paths.add_polyline_path([(0, 100, 0.4), (10, 100), (10, 110), (0, 110)])
    edges = hatch.paths.add_edge_path()
    edges.add_line((20, 100), (30, 100))
    edges.add_arc((30, 105), 5, 270, 90)
    edges.add_line((30, 110), (20, 110))
    edges.add_arc((20, 105), 5, 270, 90, ccw=False)
    edges = hatch.paths.add_edge_path()
    edges.add_ellipse((45, 105), (5, 1), 0.5, 0, 360)
    edges = hatch.paths.add_edge_path()
    edges.add_ellipse((65, 105), (5, 1), 0.5, 10, 190, ccw=False)
    edges.add_spline(
        control_points=[(60, 104), (63, 95), (67, 115), (70, 106)], degree=3, knot_values=[0, 0, 0, 0, 1, 1, 1, 1]
    )
    space.add_mtext("{\\fArial|b1;Kasse} 1\\PZeile \\H2x;2 \\{x\\} \\S1/2;", dxfattribs={"layer": "TEXT"})
    space.add_leader([(0, 120), (5, 125), (10, 125)], dxfattribs=layer)
    space.add_mline([(20, 120), (40, 120), (40, 130)], close=True, dxfattribs={"layer": "WALL"})
    space.add_linear_dim((0, 140), (0, 135), (20, 135), dxfattribs={"layer": "TEXT"}).render()
    return doc


def blocks(version):
    doc = new(version)
    space = doc.modelspace()
    desk = doc.blocks.new("DESK", base_point=(1, 2))
    desk.add_line((0, 0), (3, 0))
    desk.add_line((3, 0), (3, 1), dxfattribs={"layer": "WALL"})
    desk.add_circle((1, 1), 0.5, dxfattribs={"layer": "ROUND"})
    desk.add_polyline2d([(0, 0, 0.7), (2, 0, 0), (2, 2, -0.2)], format="xyb", close=True)
    desk.add_text("Tisch", dxfattribs={"height": 0.2, "layer": "TEXT"})
    row = doc.blocks.new("ROW")
    row.add_blockref("DESK", (0, 0))
    row.add_blockref("DESK", (5, 0), dxfattribs={"xscale": -1})
    row.add_blockref("DESK", (10, 1), dxfattribs={"xscale": 2, "yscale": 0.5, "rotation": 30})
    hall = doc.blocks.new("HALL", base_point=(-3, 4))
    hall.add_blockref("ROW", (0, 0), dxfattribs={"rotation": 90, "layer": "SHELF"})
    hall.add_blockref("ROW", (20, 0), dxfattribs={"yscale": -2, "xscale": 3})
    space.add_blockref("DESK", (100, 100))
    space.add_blockref("DESK", (110, 100), dxfattribs={"layer": "SHELF", "rotation": 45})
    grid = {"row_count": 3, "column_count": 4, "row_spacing": 6, "column_spacing": -7, "rotation": 20}
    space.add_blockref("ROW", (0, 0), dxfattribs={**grid, "xscale": -1.5, "layer": "WALL"})
    space.add_blockref("HALL", (-50, 50), dxfattribs={"rotation": -70, "xscale": -1, "yscale": 2})
    space.add_blockref("HALL", (50, 50), dxfattribs={"extrusion": (0, 0, -1), "rotation": 25, "layer": "ROUND"})
    one = space.add_blockref("DESK", (70, 0))
    one.add_attrib("NUMBER", "A-17", (70, 1), dxfattribs={"layer": "TEXT", "height": 0.3})
    one.add_attrib("HIDDEN", "secret", (70, 2), dxfattribs={"layer": "TEXT"}).is_invisible = True
    return doc


def mirrored():
    """Entities whose plane is seen from below."""
    doc = new()
    space = doc.modelspace()
    below = {"extrusion": (0, 0, -1), "layer": "ROUND"}
    space.add_circle((10, 0), 3, dxfattribs=below)
    space.add_arc((20, 0), 3, 10, 100, dxfattribs=below)
    space.add_lwpolyline([(0, 10, 0.5), (5, 10), (5, 15)], format="xyb", close=True, dxfattribs=below)
    space.add_polyline2d([(10, 10, 0.5), (15, 10), (15, 15)], format="xyb", dxfattribs=below)
    space.add_solid([(30, 10), (35, 10), (30, 15), (36, 16)], dxfattribs=below)
    space.add_ellipse((40, 40), (6, 2), 0.4, 1, 4, dxfattribs=below)
    space.add_line((0, 0), (7, 7), dxfattribs=below)
    hatch = space.add_hatch(dxfattribs=below)
    hatch.paths.add_polyline_path([(50, 0, 0.4), (60, 0), (60, 10)])
    edges = hatch.paths.add_edge_path()
    edges.add_arc((70, 0), 5, 20, 130)
    edges.add_arc((90, 0), 5, 20, 130, ccw=False)
    space.add_text("below", dxfattribs={**below, "height": 1})
    return doc


def tilted():
    doc = new()
    space = doc.modelspace()
    for k, extrusion in enumerate([(1, 0, 0), (0.3, -0.4, 0.8), (0.01, 0.005, 1), (0, 0.5, -0.5)]):
        space.add_circle((10 * k, 4, 2), 3, dxfattribs={"extrusion": extrusion, "layer": "ROUND"})
        space.add_lwpolyline(
            [(0, 10, 0.5), (5, 10), (5, 15)],
            format="xyb",
            dxfattribs={"extrusion": extrusion, "elevation": 3 * k, "layer": "WALL"},
        )
        major = OCS(extrusion).to_wcs(Vec3(6, 2, 0))
        space.add_ellipse((40, 10 * k), major, 0.4, 1, 4, dxfattribs={"extrusion": extrusion, "layer": "WALL"})
    return doc


for version in VERSIONS:
    save(mixed(version), f"mixed_{version}.dxf")
    save(blocks(version), f"blocks_{version}.dxf", notes={"invisible": None})
save(mirrored(), "mirrored.dxf")
save(tilted(), "tilted.dxf", notes={"tilted": None})

# Texts.

TEXTS = {
    "cp1252": "Möbel für 5 € – Größe",
    "cp1250": "Łóżka, židle",
    "cp1251": "Отдел мебели",
    "cp1253": "Έπιπλα",
    "cp1254": "Şişe ğ",
    "cp932": "売場ソ表",
    "gbk": "货架平面图",
    "cp949": "선반 평면도",
    "cp950": "貨架許功蓋",
}
for encoding, text in TEXTS.items():
    for version in ("R12", "R2000"):
        doc = new(version)
        doc.encoding = encoding
        shop(doc.modelspace())
        layer = text.split()[0].strip(",")
        doc.layers.new(layer)
        doc.modelspace().add_text(text, dxfattribs={"layer": layer, "height": 1})
        # Some characters that the code page lacks. Windows has more of them in page 950 than browsers.
        doc.modelspace().add_text(f"{text} 家具" + ("" if encoding == "cp950" else " Ж"), dxfattribs={"height": 1})
        save(doc, f"text_{encoding}_{version}.dxf")
doc = new("R2018")
shop(doc.modelspace())
for text in TEXTS.values():
    doc.modelspace().add_text(text, dxfattribs={"height": 1})
save(doc, "text_utf8.dxf")

# Units.

for code, unit, length in [(1, "in", 39.37), (2, "ft", 3.281), (4, "mm", 1000), (5, "cm", 100), (6, "m", 1)]:
    doc = new()
    doc.header["$INSUNITS"] = code
    doc.header["$MEASUREMENT"] = 0 if code < 3 else 1
    shop(doc.modelspace(), length)
    save(doc, f"unit_{unit}.dxf", unit=unit, proposed=[unit, "header"])
    doc.header["$INSUNITS"] = 0
    save(doc, f"unit_none_{unit}.dxf", proposed=[unit, "size"])
doc = new()
doc.header["$INSUNITS"] = 4
doc.header["$MEASUREMENT"] = 1
shop(doc.modelspace(), 39.37)
for k, text in enumerate(["58'-0\"", "7'-2\"", "12'", "13' 6\""]):
    doc.modelspace().add_text(text, dxfattribs={"height": 10, "insert": (100 * k, -100)})
save(doc, "unit_wrong_inches.dxf", unit="mm", proposed=["in", "texts"])
doc = new()
doc.header["$INSUNITS"] = 4
shop(doc.modelspace(), 1)
save(doc, "unit_wrong_metres.dxf", unit="mm", proposed=["m", "size"])
doc = new()
doc.header["$INSUNITS"] = 4
shop(doc.modelspace(), 1000)
doc.modelspace().add_line((5e6, 5e6), (5e6 + 10, 5e6), dxfattribs={"layer": "WALL"})
save(doc, "unit_outlier.dxf", unit="mm", proposed=["mm", "header"])

# Layers, and what is not in model space.

doc = new()
for name, is_off, is_frozen in [("OFF", True, False), ("FROZEN", False, True)]:
    layer = doc.layers.new(name, dxfattribs={"color": 3})
    if is_off:
        layer.off()
    if is_frozen:
        layer.freeze()
    doc.modelspace().add_line((0, 0), (5, 5), dxfattribs={"layer": name})
    part = doc.blocks.new(f"PART_{name}")
    part.add_line((0, 0), (1, 0))
    part.add_line((0, 0), (2, 0), dxfattribs={"layer": "WALL"})
    doc.modelspace().add_blockref(part.name, (10, 10), dxfattribs={"layer": name})
doc.layout("Layout1").add_line((0, 0), (1000, 1000))
doc.layout("Layout1").add_circle((0, 0), 1000)
shop(doc.modelspace())
save(doc, "layers.dxf", notes={"paper_space": None})

doc = new()
doc.layout("Layout1").add_line((0, 0), (1000, 1000))
save(doc, "paper_only.dxf")
expected["paper_only.dxf"] = {"error": "empty"}
save(new(), "empty.dxf")
expected["empty.dxf"] = {"error": "empty"}
save(mixed("R2010"), "binary.dxf", kind="bin")
expected["binary.dxf"] = {"error": "binary"}

doc = new()
shop(doc.modelspace())
doc.add_xref_def("C:\\plans\\walls.dwg", "WALLS")
doc.modelspace().add_blockref("WALLS", (0, 0))
doc.modelspace().add_point((1, 1))
doc.modelspace().add_ray((0, 0), (1, 0))
doc.modelspace().add_polymesh((3, 3))
save_doc = folder / "xref.dxf"
doc.saveas(save_doc)
for entity in [e for e in doc.modelspace() if e.dxftype() in ("RAY", "POLYLINE", "INSERT")]:
    doc.modelspace().delete_entity(entity)
expected["xref.dxf"] = facts(doc, notes={"xref": ["C:\\plans\\walls.dwg"], "unsupported": ["POLYMESH", "RAY"]})

# Far away.

for name, scale, at in [("utm", 1, (512345.678, 5412345.678)), ("far", 1000, (5e9, -3e9))]:
    doc = new()
    part = doc.blocks.new("SHOP")
    shop(part, scale)
    doc.modelspace().add_blockref("SHOP", at)
    save(doc, f"{name}.dxf")
doc.modelspace().add_line((0, 0), (10, 0), dxfattribs={"layer": "STRAY"})
doc.saveas(folder / "stray.dxf")
expected["stray.dxf"] = {**expected["far.dxf"], "notes": {"stray": [None]}}

# Line ends, comments and marks.

original = (folder / "mixed_R2010.dxf").read_bytes().replace(b"\r\n", b"\n")
for name, content in [
    ("lf", original),
    ("crlf", original.replace(b"\n", b"\r\n")),
    ("cr", original.replace(b"\n", b"\r")),
    ("bom", b"\xef\xbb\xbf" + original),
    ("comment", b"999\nby hand\n" + original),
    ("no_last_end", original.rstrip(b"\n")),
    ("after_end", original + b"\x1a\x00"),
]:
    write(f"ends_{name}.dxf", content, **expected["mixed_R2010.dxf"])

# Cut files.

for percent in (1, 5, 20, 50, 80, 95, 99):
    cut = original[: len(original) * percent // 100]
    write(f"cut_{percent}.dxf", cut, error="truncated")
    at_line = cut[: cut.rindex(b"\n") + 1]
    write(f"cut_line_{percent}.dxf", at_line, error="truncated")
write("cut_end.dxf", original[: original.rindex(b"EOF")], error="truncated")
write("cut_end_2.dxf", original[: original.rindex(b"EOF") + 2], error="truncated")

# Files that are none, or wrong.

write("none.dxf", b"", error="not_dxf")
write("text.dxf", "This is a letter.\nIt has lines.\n", error="not_dxf")
write("numbers.dxf", "1\n2\n3\n4\n", error="not_dxf")
write("picture.dxf", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", error="not_dxf")
write("drawing.dxf", b"AC1032\0\0\0\0\0" + bytes(200), error="dwg")
wrong = section("ENTITIES", line(0, 0, 1, 1), "{}", line(0, 0, 1, 1)) + END
for name, value, error in [
    ("nan", "nan", "bad_number"),
    ("infinity", "inf", "bad_number"),
    ("indefinite", "-1.#IND", "bad_number"),
    ("huge", "1e999", "bad_number"),
    ("comma", "1,5", "bad_number"),
    ("nothing", "", "bad_number"),
]:
    write(f"number_{name}.dxf", wrong.format(line(value, 0, 1, 1)), error=error)
for name, code in [("huge", "99999999999999999999"), ("high", "1072"), ("word", "ten"), ("blank", ""), ("real", "1.5")]:
    write(f"code_{name}.dxf", wrong.format(f"{code}\n5\n"), error="bad_code")

# Blocks that are not as they should be.

square = {"length": 4, "bounds": [0, 0, 1, 1], "texts": 0, "on": True}
sides = line(0, 0, 1, 0) + line(1, 0, 1, 1) + line(1, 1, 0, 1) + line(0, 1, 0, 0)
by_hand = {"version": "AC1009", "unit": None, "texts": [], "layers": {"0": square}}
write(
    "recursive.dxf",
    section("BLOCKS", block("SELF", sides, insert("self")), block("A", insert("B")), block("B", insert("A")))
    + section("ENTITIES", insert("SELF"), insert("A"))
    + END,
    **by_hand,
    notes={"recursive_block": ["A", "SELF"]},
)
hidden = tags(0, "LINE", 8, "0", 60, 1, 10, -5, 20, -5, 11, 9, 21, 9)
write("hidden.dxf", section("ENTITIES", sides, hidden, hidden) + END, **by_hand, notes={"invisible": None})
write("missing.dxf", section("ENTITIES", sides, insert("NONE")) + END, **by_hand, notes={"missing_block": ["NONE"]})
proxy = tags(0, "ACAD_PROXY_ENTITY", 8, "0", 90, 498, 91, 501, 92, 4, 310, "00FF00FF")
classes = [tags(0, "CLASS", 1, name, 3, "AecArch", 90, 0) for name in ("AEC_DOOR", "AEC_WALL")]
solid = tags(0, "3DSOLID", 8, "0", 1, "m", 1, "nan")
write(
    "proxies.dxf",
    section("CLASSES", *classes) + section("ENTITIES", sides, proxy, proxy, solid) + END,
    **by_hand,
    notes={"proxy": ["AEC_WALL"], "unsupported": ["3DSOLID"]},
)
ten = "".join(insert("B{}", 41, k + 1) for k in range(10))
bomb = [block("B0", *[line(k, 0, k, 1) for k in range(10)])]
bomb += [block(f"B{k + 1}", ten.format(*[k] * 10)) for k in range(10)]
write("bomb.dxf", section("BLOCKS", *bomb) + section("ENTITIES", insert("B10")) + END, error="too_many")
many = insert("B0", 70, 32767, 71, 32767)
write("bomb_array.dxf", section("BLOCKS", *bomb[:1]) + section("ENTITIES", many) + END, error="too_many")
hollow = [block("H0")] + [block(f"H{k + 1}", ten.replace("B", "H").format(*[k] * 10)) for k in range(20)]
write("hollow.dxf", section("BLOCKS", *hollow) + section("ENTITIES", sides, insert("H20", 70, 32767)) + END, **by_hand)
deep = [block("D0", sides)] + [block(f"D{k + 1}", insert(f"D{k}")) for k in range(16)]
write("deep.dxf", section("BLOCKS", *deep) + section("ENTITIES", insert("D16")) + END, **by_hand)
deep += [block(f"D{k + 1}", insert(f"D{k}")) for k in range(16, 20000)]
write("too_deep.dxf", section("BLOCKS", *deep) + section("ENTITIES", insert("D20000")) + END, error="too_deep")
rounds = "".join(tags(0, "CIRCLE", 8, "0", 10, 3 * (k % 200), 20, 3 * (k // 200), 40, 1) for k in range(30000))
facts_of_rounds = {"length": 30000 * 100 * math.sin(math.pi / 50), "bounds": [-1, -1, 598, 448], "texts": 0, "on": True}
write(
    "circles.dxf",
    section("ENTITIES", rounds) + END,
    **{**by_hand, "layers": {"0": facts_of_rounds}},
    notes={"coarse": None, "outlines_left_out": None},
)

# As large as it may be, and larger: a lattice.


def lattice(count):
    return "".join(
        f"0\nLINE\n8\n0\n10\n{k % 1000}.25\n20\n{k // 1000}.125\n11\n{k % 1000 + 1}.25\n21\n{k // 1000}.125\n"
        for k in range(count)
    )


most = 2_000_000
large = {"length": most, "bounds": [0.25, 0.125, 1000.25, 1999.125], "texts": 0, "on": True}
write("large.dxf", section("ENTITIES", lattice(most)) + END, **{**by_hand, "layers": {"0": large}})
write("too_large.dxf", section("ENTITIES", lattice(most), line(0, 0, 1, 1)) + END, error="too_many")
zigzag = "".join(f"10\n{k % 1000}.123456789\n20\n{k // 1000}.987654321\n" for k in range(most))
closed = tags(0, "LWPOLYLINE", 8, "0", 90, most, 70, 1) + zigzag
write(
    "large_polyline.dxf",
    section("ENTITIES", closed) + END,
    **{
        **by_hand,
        "layers": {
            "0": {
                "length": None,
                "bounds": [0.123456789, 0.987654321, 999.123456789, 1999.987654321],
                "texts": 0,
                "on": True,
            }
        },
    },
    notes={"outlines_left_out": None},
)

(folder / "expected.json").write_text(json.dumps(expected))
print(len(expected), "files by ezdxf", ezdxf.__version__)
