"""States of a shop that changes: exports and simulations."""

from harness import ProgramTest


def known_states(*pallets):
    """A shop whose availabilities are known.

    Between black walls are aisles with a label in the middle of each, a unit at each end, and a pallet that blocks the
    light of its unit while it stands there. One free unit reaches the label. `pallets`: for each aisle the shares of
    the time in which those on the left and on the right stand.
    """
    black = {"material": "black"}
    labels, units, objects = [], [], []
    for k, shares in enumerate(pallets):
        y = 4 * k + 2
        labels.append({"id": f"L{k}", "type": "l", "position": [6, y, 0.5], "normal": [0, 0, 1]})
        for side, share in enumerate(shares):
            units.append({"id": f"U{k}{side}", "type": "t", "position": [1 + 10 * side, y, 2.9], "axis": [0, 0, -1]})
            area = [[3 + 6 * side + a, y + b] for a, b in ((-0.02, -0.02), (0.02, -0.02), (0.02, 0.02), (-0.02, 0.02))]
            objects.append({"id": f"P{k}{side}", "present": share, "size": [1, 1, 2.4], "area": area, **black})
    wall, depth = {"thickness": 0.1, "height": "ceiling", **black}, 4 * len(pallets)
    walls = [{"id": f"W{y}", "from": [0, y], "to": [12, y], **wall} for y in range(4, depth, 4)]
    surfaces = {"floor": "black", "ceiling": "black", "walls": "black"}
    return {
        "room": {"size": [12, depth, 3], "inner_walls": walls, **surfaces},
        "materials": {"black": {"type": "lambertian", "reflectance": 0}},
        "label_types": {"l": {"threshold": 0.004, "availability": 0.95}},
        "transceiver_types": {"t": {"emission": {"type": "lambertian", "flux": 3}}},
        "labels": labels,
        "transceivers": {"list": units},
        "variation": {"objects": objects},
    }


class States(ProgramTest):
    def test_are_exported_and_simulated_with_the_same_bytes(self):
        self.write("store.json", known_states((0.01, 0.01), (0.1, 0.1), (0.01, 0.2)))
        self.told("inspect store.json --state 17 -o state17.json --quiet")

        def simulated(line):
            self.told(f"simulate {line} -o signal.h5 --samples 500 --quiet")
            return self.bytes("signal.h5")

        exported = simulated("state17.json")
        self.assertEqual(simulated("store.json --state 17"), exported)
        self.assertNotEqual(simulated("store.json"), exported, "the control")
        states = "store.json --states 3 --hard-labels 2 --threads"
        self.assertEqual(simulated(f"{states} 1"), simulated(f"{states} 2"))
        self.refused("plan state17.json -o plan --states 10", "state17.json", "variation")
