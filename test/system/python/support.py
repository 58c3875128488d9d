"""The room and the helpers of the tests of the Python package."""

import re

import shelfbeam as sb
from harness import ROOT, ProgramTest

THESIS = ROOT / "examples/thesis/store.json"
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
QUICK = {"samples": 256, "estimator": "uniform"}  # without radiance caches, which take longer than so few samples


def untimed(text):
    return re.sub(r"[0-9.]+ s, solver", "solver", text)


class RoomTest(ProgramTest):
    """A test whose folder has the room as store.json."""

    def setUp(self):
        super().setUp()
        self.file = self.write("store.json", ROOM)
        self.store = sb.Store(ROOM)
