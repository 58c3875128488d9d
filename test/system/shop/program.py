"""Runs the program on a store and reads its files."""

import json
import os
import pathlib
import re
import struct
import subprocess
from dataclasses import dataclass

import h5py
import numpy as np

PROGRAM = os.environ["SHELFBEAM"]
SHOP = pathlib.Path(__file__).parents[2] / "data/l_shaped_shop.json"


def run(*arguments):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(done.stderr)
    return done.stdout


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


def simulate(store, output, *options):
    run("simulate", store, "-o", output, "--quiet", *options)
    with h5py.File(output) as file:
        rows, columns = (np.array(file[f"{kind}/id"].asstr()[:]) for kind in ("labels", "transceivers"))
        order = np.ix_(np.argsort(rows), np.argsort(columns))
        values = [file["labels"][key][:] for key in ("position", "normal")] + [file["labels/type"].asstr()[:]]
        units = zip(file["transceivers/position"][:], file["transceivers/axis"][:])
        return Signals(
            dict(zip(rows, zip(*values))),
            dict(zip(columns, units)),
            file["mean"][:][order].astype(float),
            file["standard_error"][:][order].astype(float),
        )
