"""What the tests of the Python package share."""

import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import shelfbeam as sb

PROGRAM = os.environ["SHELFBEAM"]
THESIS = Path(__file__).parents[3] / "examples" / "thesis" / "store.json"
ROOM = {
    "room": {"size": [5, 4, 3], "floor": "grey", "ceiling": "white", "walls": "white"},
    "materials": {"white": sb.material(0.8), "grey": sb.material(0.3)},
    "label_types": {"pd": {"threshold": 0.01}},
    "transceiver_types": {"led": {"emission": {"type": "lambertian", "flux": 1}}},
    "measuring_planes": [
        {"id": "P", "type": "pd", "origin": [0, 0, 1], "axes": [[1, 0, 0], [0, 1, 0]], "size": [5, 4], "spacing": 1}
    ],
    "transceivers": {"grids": [{"type": "led", "min": [1, 1], "max": [4, 3], "spacing": 1, "z": 2.9}]},
}
FEW = {"samples": 256}


def command(*words, codes=(0,)):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)
    if done.returncode not in codes:
        raise AssertionError(f"{words}: exit code {done.returncode}\n{done.stderr}")
    return done


def untimed(text):
    return re.sub(r"[0-9.]+ s, solver", "solver", text)


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
