"""What ezdxf says about a drawing: lengths and bounds of the lines of each layer, and the texts."""

import math
import re

from ezdxf import path as paths
from ezdxf.math import OCS, Matrix44, Vec3

SHOWN_TEXTS = ("TEXT", "ATTRIB", "MTEXT")


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
