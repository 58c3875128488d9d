"""Meshes as other programs write them: orientation of glass, glTF that moves vertices, dialects of OBJ, STL and PLY."""

import json

from rows import Row, between, ends, output, refuses, signals


def area(store):
    return lambda _: json.loads(output("inspect", store, "--json"))["materials"]["body"]["area_m2"]


def area_row(store, value):
    return Row(store, f"{value} m2 of 'body'", area(store), between(value - 0.005, value + 0.005))


def refused_row(store, *words):
    return Row(store, "refused: " + ", ".join(words), ends("inspect", store), refuses(*words))


ROWS = [
    Row(
        "mirrored_gltf.json",
        "0.120 +- 0.005, as not_mirrored_gltf.json",
        lambda scratch: signals("mirrored_gltf.json", scratch)["L1", "U1"],
        between(0.115, 0.125),
        is_slow=True,
    ),
    area_row("skin_gltf.json", 0.24),
    area_row("morph_gltf.json", 1.92),
    area_row("instances_gltf.json", 2.88),
    area_row("hidden_node_gltf.json", 0.96),
    refused_row("open_facet_stl.json", "line "),
    refused_row("two_corners_stl.json", "line "),
    area_row("byte_order_mark_obj.json", 1),
    area_row("mark_ply.json", 0.96),
    refused_row("null_in_name_obj.json", "wh\\x00ite", "add an entry"),
    area_row("line_comments_obj.json", 0.96),
    area_row("old_line_ends_obj.json", 0.96),
    area_row("bytes_behind_stl.json", 0.96),
    area_row("count_zero_stl.json", 0.96),
    area_row("far_coordinates_obj.json", 0.96),
]
