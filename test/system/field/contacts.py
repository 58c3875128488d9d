"""Glass in contact with other surfaces: the signal of L1, W/m^2."""

import csv
import json

from rows import INPUTS, Row, between, expect_success, run, signals


def signal(store):
    return lambda scratch: signals(store, scratch)["L1", "U1"]


def warnings(store):
    """Whether the program reports that the label and the unit are separated."""
    return lambda scratch: "separate" in run("inspect", store).out


def changed_signal(name, scratch, change, *options):
    store = json.loads((INPUTS / name).read_text(encoding="utf-8"))
    store.update(change)
    (scratch / name).write_text(json.dumps(store), encoding="utf-8")
    return signals(scratch / name, scratch, *options)["L1", "U1"]


def state_ratio(scratch):
    """The ratio of the signals in a state of the shop in which units are mounted inexactly."""
    change = {"variation": {"mounting": {"position": 0.05, "tilt_deg": 2}, "unit_power_db": 0.5}}
    on, above = (changed_signal(f"jar_{place}_table.json", scratch, change, "--state", 3) for place in ("on", "above"))
    return on / above


def verified_signal(scratch):
    """The signal in the second simulation, which verifies the plan."""
    expect_success(run("plan", "jar_on_table.json", "-o", scratch / "plan"))
    with open(scratch / "plan/verification.csv", encoding="utf-8") as file:
        return float(next(csv.DictReader(file))["signal"])


def label_ratio(scratch):
    """The ratio of the signals of a label that looks through a block of glass, on it and 1 mm in front of it."""

    def at(z):
        label = {"id": "L1", "position": [3, 2, z], "normal": [0, 0, -1], "type": "shelf label"}
        return changed_signal("glass_on_pane.json", scratch, {"labels": [label]})

    return at(1.2) / at(1.201)


ROWS = [
    Row("poster_on_door.json", "0 +- 0.001, no light passes", signal("poster_on_door.json"), between(-0.002, 0.002)),
    Row("poster_on_door.json, inspect", "a warning of separation", warnings("poster_on_door.json"), bool),
    Row("poster_before_door.json, inspect", "a warning of separation", warnings("poster_before_door.json"), bool),
    Row("jar_on_table.json", "0.124 +- 0.005", signal("jar_on_table.json"), between(0.119, 0.129)),
    Row("jar_above_table.json", "0.124 +- 0.005", signal("jar_above_table.json"), between(0.119, 0.129)),
    Row("jar_on_table.json, state 3", "as jar_above_table.json, 1 +- 0.05", state_ratio, between(0.95, 1.05)),
    Row("jar_on_table.json, verification", "0.124 +- 0.012", verified_signal, between(0.112, 0.136)),
    Row("glass_on_pane.json, label on the block", "as 1 mm above it, 1 +- 0.05", label_ratio, between(0.95, 1.05)),
    Row("glass_touching.json", "0.112 to 0.116", signal("glass_touching.json"), between(0.110, 0.118)),
    Row("glass_on_pane.json", "0.113 +- 0.003", signal("glass_on_pane.json"), between(0.110, 0.116)),
    Row("glass_above_pane.json", "0.113 +- 0.003", signal("glass_above_pane.json"), between(0.110, 0.116)),
]
