"""Glass in contact with other surfaces: the signal of L1, W/m^2."""

from rows import Row, between, ends, input_store, output, signals, table, write_store


def signal(store):
    return lambda scratch: signals(store, scratch, samples=10000)["L1", "U1"]


def changed_signal(name, scratch, change, *options):
    store = scratch / write_store(scratch, input_store(name, **change))
    return signals(store, scratch, *options, samples=10000)["L1", "U1"]


def state_ratio(scratch):
    """The ratio of the signals in a state of the shop in which units are mounted inexactly."""
    change = {"variation": {"mounting": {"position": 0.05, "tilt_deg": 2}, "unit_power_db": 0.5}}
    on, above = (changed_signal(f"jar_{place}_table.json", scratch, change, "--state", 3) for place in ("on", "above"))
    return on / above


def verified_signal(scratch):
    """The signal in the second simulation, which verifies the plan."""
    output(f"plan jar_on_table.json -o {scratch}/plan")
    names, line = table(scratch / "plan/verification.csv")
    return float(line[names.index("signal")])


def label_ratio(scratch):
    """The ratio of the signals of a label that looks through a block of glass, on it and 1 mm in front of it."""

    def at(z):
        label = {"id": "L1", "position": [3, 2, z], "normal": [0, 0, -1], "type": "shelf label"}
        return changed_signal("glass_on_pane.json", scratch, {"labels": [label]})

    return at(1.2) / at(1.201)


def is_separation_noted(end):
    return end.status == 0 and "separate" in end.out


def signal_row(store, expected, low, high):
    return Row(store, expected, signal(store), between(low, high))


def separation_row(store):
    """The program reports that the label and the unit are separated."""
    return Row(f"{store}, inspect", "a warning of separation", ends("inspect", store), is_separation_noted)


ROWS = [
    signal_row("poster_on_door.json", "0 +- 0.001, no light passes", -0.002, 0.002),
    separation_row("poster_on_door.json"),
    separation_row("poster_before_door.json"),
    signal_row("jar_on_table.json", "0.124 +- 0.005", 0.119, 0.129),
    signal_row("jar_above_table.json", "0.124 +- 0.005", 0.119, 0.129),
    Row("jar_on_table.json, state 3", "as jar_above_table.json, 1 +- 0.05", state_ratio, between(0.95, 1.05)),
    Row("jar_on_table.json, verification", "0.124 +- 0.012", verified_signal, between(0.112, 0.136)),
    Row("glass_on_pane.json, label on the block", "as 1 mm above it, 1 +- 0.05", label_ratio, between(0.95, 1.05)),
    signal_row("glass_touching.json", "0.112 to 0.116", 0.110, 0.118),
    signal_row("glass_on_pane.json", "0.113 +- 0.003", 0.110, 0.116),
    signal_row("glass_above_pane.json", "0.113 +- 0.003", 0.110, 0.116),
]
