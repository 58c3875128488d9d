"""Runs the program on a store and reads its files."""

import json
import re
import struct
from dataclasses import dataclass

import h5py
import numpy as np
from harness import ROOT, output

SHOP = ROOT / "test/data/l_shaped_shop.json"


def read_shop():
    return json.loads(re.sub(r"//.*", "", SHOP.read_text(encoding="utf-8")))


def model_surfaces(path):
    """(node, material, triangles) of all surfaces of a GLB file, with z up."""
    content = path.read_bytes()
    size = struct.unpack_from("<I", content, 12)[0]
    model, binary = json.loads(content[20 : 20 + size]), content[28 + size :]

    def values(accessor, kind):
        accessor = model["accessors"][accessor]
        start = model["bufferViews"][accessor["bufferView"]]["byteOffset"] + accessor["byteOffset"]
        count = accessor["count"] * (3 if accessor["type"] == "VEC3" else 1)
        return np.frombuffer(binary, kind, count, start).reshape(-1, 3)

    for node in model["nodes"]:
        for surface in model["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []:
            corners = values(surface["attributes"]["POSITION"], "<f4").astype(float)
            triangles = corners[values(surface["indices"], "<u4")]
            yield node["name"], model["materials"][surface["material"]]["name"], triangles


@dataclass
class Signals:
    """A signal file, its rows and columns ordered by id."""

    labels: dict  # id -> (position, normal, type)
    units: dict  # id -> (position, axis)
    mean: np.ndarray
    error: np.ndarray


def simulate(store, file, *options):
    output("simulate", store, "-o", file, "--quiet", *options)
    with h5py.File(file) as content:
        rows, columns = (np.array(content[f"{kind}/id"].asstr()[:]) for kind in ("labels", "transceivers"))
        order = np.ix_(np.argsort(rows), np.argsort(columns))
        values = [content["labels"][key][:] for key in ("position", "normal")] + [content["labels/type"].asstr()[:]]
        units = zip(content["transceivers/position"][:], content["transceivers/axis"][:])
        return Signals(
            dict(zip(rows, zip(*values))),
            dict(zip(columns, units)),
            content["mean"][:][order].astype(float),
            content["standard_error"][:][order].astype(float),
        )
