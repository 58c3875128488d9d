"""Drawings that ezdxf makes."""

import ezdxf
from ezdxf.math import OCS, Vec3


def new(version="R2010"):
    doc = ezdxf.new(version)
    if version != "R12":
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
