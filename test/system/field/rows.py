"""Inputs from other programs and people, each with the result that the program must report.

Every module of this folder that defines ROWS is a kind of input. `scripts/check/field` prints the rows as a table;
test_field.py and test_field_slow.py check them.
"""

import csv
import importlib
import json
import pathlib
from collections.abc import Callable
from dataclasses import dataclass

import harness

INPUTS = harness.ROOT / "test/data/field"
NOT_KINDS = ("rows", "test_field", "test_field_slow")


@dataclass(frozen=True)
class Row:
    """One input. `measure` runs the program in an empty folder and returns its result."""

    name: str
    expected: str  # as people read it
    measure: Callable[[pathlib.Path], object]
    is_right: Callable[[object], bool]
    is_slow: bool = False


def run(*arguments, folder=INPUTS, **options):
    """Runs the program in the folder of the inputs, or in another."""
    return harness.run(*arguments, cwd=folder, **options)


def output(*arguments, folder=INPUTS):
    return harness.output(*arguments, cwd=folder)


def ends(*arguments):
    """Measures the end of a run on an input."""
    return lambda _: run(*arguments)


def input_store(name, **changes):
    return json.loads((INPUTS / name).read_text(encoding="utf-8")) | changes


def write_store(scratch, store):
    (scratch / "store.json").write_text(json.dumps(store), encoding="utf-8")
    return "store.json"


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.reader(file))


def signals(store, scratch, *options, samples=20000):
    """(label, unit) -> mean signal, W/m^2."""
    output("simulate", store, "-o", scratch / "o.h5", "--samples", samples, "--quiet", *options)
    output("export", scratch / "o.h5", "--what", "mean", "-o", scratch / "o.csv")
    units, *lines = table(scratch / "o.csv")
    return {(line[0], unit): float(value) for line in lines for unit, value in zip(units[1:], line[1:])}


def refuses(*words):
    """Accepts a run that ends with exit code 2 and a message that contains the words."""
    return lambda end: end.status == 2 and all(word in end.err for word in words)


def says(*words):
    """Accepts a run that succeeds and prints the words."""
    return lambda end: end.status == 0 and all(word in end.out for word in words)


def between(low, high):
    return lambda value: low <= value <= high


def equals(value):
    return lambda result: result == value


def kinds():
    """Name of a kind -> its rows."""
    names = sorted(path.stem for path in pathlib.Path(__file__).parent.glob("*.py") if path.stem not in NOT_KINDS)
    modules = {name: importlib.import_module(name) for name in names}
    return {name: module.ROWS for name, module in modules.items() if hasattr(module, "ROWS")}
