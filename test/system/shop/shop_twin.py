"""The surfaces, labels and candidates of test/data/l_shaped_shop.json, computed from the dimensions in
docs/formats/store. This module shares no code with the program.

Surfaces are lists of (material, triangles); triangles are arrays of n x 3 corners x 3 coordinates.
"""

import math
from dataclasses import dataclass

import numpy as np

OUTLINE = [(0, 0), (11, 0), (11, 5), (6, 6.5), (6, 10), (0, 10)]
ZONE = [(0, 6.8), (4, 7.4), (4, 10), (0, 10)]
HEIGHT = 3.1


@dataclass(frozen=True)
class Shop:
    """The values that the controls of the tests change."""

    zone_height: float = 2.5
    fascia: str = "brick"
    turn: float = 0  # degrees by which A3 and A4 are turned further


def polygon(points):
    """A convex polygon as a fan of triangles."""
    points = np.array(points, dtype=float)
    return np.array([[points[0], points[k], points[k + 1]] for k in range(1, len(points) - 1)])


def level(outline, z):
    return polygon([(x, y, z) for x, y in outline])


def upright(a, b, bottom, top):
    """A vertical rectangle over the line from a to b."""
    return polygon([(*a, bottom), (*b, bottom), (*b, top), (*a, top)])


def block(outline, bottom, top, pieces=None):
    """A block over an outline; `pieces` are the convex polygons of a concave one."""
    sides = [upright(a, b, bottom, top) for a, b in zip(outline, outline[1:] + outline[:1])]
    lids = [level(piece, z) for piece in pieces or [outline] for z in (bottom, top)]
    return np.concatenate(sides + lids)


def box(low, high):
    (x0, y0, z0), (x1, y1, z1) = low, high
    return block([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], z0, z1)


def placed(points, at, degrees):
    """Points turned about the vertical through the origin, which then moves to `at`."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.asarray(points, dtype=float) @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + [*at, 0]


def shell(shop):
    """Floor, walls and ceilings, with the walls below the zone ending at its lower ceiling."""
    front, rear = [(0, 0), (11, 0), (11, 5), (6, 6.5)], [(0, 0), (6, 6.5), (6, 10), (0, 10)]
    yield "tiles", level(front, 0)
    yield "tiles", level(rear, 0)
    yield "cream", level(ZONE, shop.zone_height)
    beside_zone = [(0, 0), (6, 6.5), (4, 7.4), (0, 6.8)], [(6, 6.5), (6, 10), (4, 10), (4, 7.4)]
    for piece in (front, *beside_zone):
        yield "white", level(piece, HEIGHT)
    for k, material in enumerate(("glass", "white", "wood", "white")):
        yield material, upright(OUTLINE[k], OUTLINE[k + 1], 0, HEIGHT)
    yield "white", upright((6, 10), (4, 10), 0, HEIGHT)
    yield "white", upright((4, 10), (0, 10), 0, shop.zone_height)
    yield "white", upright((0, 10), (0, 6.8), 0, shop.zone_height)
    yield "white", upright((0, 6.8), (0, 0), 0, HEIGHT)
    for a, b in zip(ZONE[:2], ZONE[1:3]):
        yield shop.fascia, upright(a, b, shop.zone_height, HEIGHT)


def inner_wall():
    """A wall of blocks beside, above and below its openings, cut off at the front wall and at the slanted wall."""
    start, end, half = np.array([7.2, -0.3]), np.array([7.8, 6.5]), 0.08
    along = (end - start) / np.linalg.norm(end - start)
    across = np.array([-along[1], along[0]])

    def cut(side, a, b):
        """The distance from the start at which a side of the wall meets the line through a and b."""
        a, b = np.array(a, dtype=float), np.array(b, dtype=float)
        normal = np.array([b[1] - a[1], a[0] - b[0]])
        return normal @ (a - start - side * across) / (normal @ along)

    sides = (-half, half)
    first = [cut(side, OUTLINE[0], OUTLINE[1]) for side in sides]
    last = [cut(side, OUTLINE[2], OUTLINE[3]) for side in sides]
    spans = [
        (first, (1.8, 1.8), [(0, HEIGHT)]),
        ((1.8, 1.8), (2.8, 2.8), [(2.1, HEIGHT)]),
        ((2.8, 2.8), (4.1, 4.1), [(0, HEIGHT)]),
        ((4.1, 4.1), (5.4, 5.4), [(0, 0.9), (2, HEIGHT)]),
        ((5.4, 5.4), last, [(0, HEIGHT)]),
    ]
    for begin, finish, heights in spans:
        corners = [(begin[0], sides[0]), (finish[0], sides[0]), (finish[1], sides[1]), (begin[1], sides[1])]
        outline = [tuple(start + distance * along + side * across) for distance, side in corners]
        for bottom, top in heights:
            yield "plaster", block(outline, bottom, top)


def row(length, depth, height, shelves, full):
    """A gondola before rotation. Its back half mirrors its front half."""
    panel = (depth - 0.04) / 2
    half = [("steel", box((0, 0.04, 0), (length, panel, 0.12)))]
    half += [("steel", box((0, 0, z - 0.02), (length, panel, z + 0.02))) for z in shelves]
    facing = length / round(length / 0.3)
    floors, ceilings = [0.12] + [z + 0.02 for z in shelves], [z - 0.02 for z in shelves] + [height]
    for floor, ceiling in zip(floors, ceilings):
        for k in range(round(length / 0.3) if full else 0):
            low = (k * facing + 0.005, 0.03, floor)
            half.append(("carton", box(low, (low[0] + facing - 0.01, panel - 0.01, floor + 0.9 * (ceiling - floor)))))
    yield "steel", box((0, panel, 0), (length, depth - panel, height))
    for material, triangles in half:
        yield material, triangles
        yield material, triangles * [1, -1, 1] + [0, depth, 0]


def modules(shop):
    """(id, place, size) of every gondola."""
    a = {"length": 1.2, "depth": 0.9, "height": 1.6, "shelves": [0.5, 1.05], "full": True}
    b = {"length": 1.2, "depth": 0.7, "height": 1.45, "shelves": [0.5, 1.05], "full": False}
    for k in range(4):
        begin = np.array([1, 1]) + (k // 2) * np.array([-0.6, 2.3])
        yield f"A{k + 1}", (begin + placed([1.2 * (k % 2), 0, 0], (0, 0), 17)[:2], 17 + shop.turn * (k // 2)), a
    yield "B1", ((3.9, 5.2), -31), b
    # B2 is turned by 180 degrees about its middle, so its first corner is at the far end and at the back of the row.
    yield "B2", (placed([2.4, 0.7, 0], (3.9, 5.2), -31)[:2], -31 + 180), b


def column():
    """A regular polygon of 32 sides with the area of the circle, its first corner in the direction of x."""
    radius = 0.25 * math.sqrt(2 * math.pi / (32 * math.sin(2 * math.pi / 32)))
    angles = [2 * math.pi * k / 32 for k in range(32)]
    return block([(5.2 + radius * math.cos(angle), 1.6 + radius * math.sin(angle)) for angle in angles], 0, HEIGHT)


def fixtures(shop=Shop()):
    for _, place, size in modules(shop):
        for material, triangles in row(**size):
            yield material, placed(triangles, *place)
    yield "wood", placed(box((0, 0, 0), (0.9, 0.6, 1.1)), (9, 1), 24)
    yield "brick", column()
    counter = [(1, 8), (1, 9.4), (1.6, 9.4), (1.6, 8.5), (3, 8.5), (3, 8)]
    pieces = [[(1, 8), (1.6, 8), (1.6, 9.4), (1, 9.4)], [(1.6, 8), (3, 8), (3, 8.5), (1.6, 8.5)]]
    yield "wood", block(counter, 0, 1, pieces)


def surfaces(shop=Shop()):
    yield from shell(shop)
    yield from inner_wall()
    yield from fixtures(shop)


def labels():
    """id -> (position, normal, type)"""
    found = {"east": ((10.98, 2.5, 1.5), (-1, 0, 0), "tag"), "bakery": ((2.6, 9.98, 1.4), (0, -1, 0), "tag")}
    for module, place, size in modules(Shop()):
        x, hook = (0.6, 0.01) if size["full"] else (0.4, 0.05)
        for face, y, outward in (("front", -hook, -1), ("back", size["depth"] + hook, 1)):
            for k, z in enumerate(size["shelves"]):
                normal = placed((0, outward, 0), (0, 0), place[1])
                found[f"{module}-{face}-{k + 1}-1"] = (placed((x, y, z), *place), normal, ("tag", "large")[k])
    return found


def candidates():
    """id -> position"""
    # The room is divided into 2 x 2 cells, of which the fourth has its middle beyond the slanted wall.
    found = {"A1-1-1": (2.75, 2.5, 3.05), "A1-2-1": (8.25, 2.5, 3.05), "A1-1-2": (2.75, 7.5, 2.45)}
    bend = math.hypot(4.7, 1.8)
    half = (bend + math.hypot(0.3, 3.6)) / 2
    found["R-1"], found["R-3"] = (0.8, 0.6, 2.8), (5.8, 6, 2.8)
    found["R-2"] = (0.8 + 4.7 * half / bend, 0.6 + 1.8 * half / bend, 2.8)
    return found


def store(of, shop=Shop()):
    """A store file without a room: all surfaces are one mesh. Materials and types are those of the store `of`."""
    parts = []
    for material, triangles in surfaces(shop):
        vertices = triangles.reshape(-1, 3).tolist()
        faces = [[k, k + 1, k + 2] for k in range(0, len(vertices), 3)]
        parts.append({"name": f"{len(parts)}", "material": material, "vertices": vertices, "faces": faces})
    return {
        **{key: of[key] for key in ("materials", "label_types", "transceiver_types")},
        "fixtures": [{"type": "mesh", "id": "shop", "at": [0, 0, 0], "parts": parts}],
        "labels": [
            {"id": name, "position": list(position), "normal": list(normal), "type": kind}
            for name, (position, normal, kind) in labels().items()
        ],
        "transceivers": {
            "list": [
                {"id": name, "position": list(position), "type": "unit"} for name, position in candidates().items()
            ]
        },
    }
