"""Inputs from other programs and people, each with the result that the program must report.

Every module of this folder that defines ROWS is a kind of input. `scripts/check/field` prints the rows as a table;
test_field.py and test_field_slow.py check them.
"""

import csv
import importlib
import os
import pathlib
import subprocess
from dataclasses import dataclass
from collections.abc import Callable

ROOT = pathlib.Path(__file__).parents[3]
PROGRAM = os.environ.get("SHELFBEAM", str(ROOT / "build/release/shelfbeam"))
INPUTS = ROOT / "test/data/field"
NOT_KINDS = ("rows", "test_field", "test_field_slow")


@dataclass(frozen=True)
class Row:
    """One input. `measure` runs the program in an empty folder and returns its result."""

    name: str
    expected: str  # as people read it
    measure: Callable[[pathlib.Path], object]
    is_right: Callable[[object], bool]
    is_slow: bool = False


@dataclass(frozen=True)
class Run:
    """The end of a run of the program."""

    status: int
    out: str
    err: str

    def __str__(self):
        first = (self.err or self.out).strip().splitlines() or [""]
        return f"exit {self.status}: {first[0]}"


def run(*arguments, folder=INPUTS, **options):
    """Runs the program in the folder of the inputs, or in another."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=folder, capture_output=True, check=False, **options)
    return Run(done.returncode, *(text.decode("utf-8", "backslashreplace") for text in (done.stdout, done.stderr)))


def expect_success(end):
    if end.status:
        raise RuntimeError(str(end))
    return end


def signals(store, scratch, *options, samples=20000):
    """(label, unit) -> mean signal, W/m^2."""
    expect_success(run("simulate", store, "-o", scratch / "o.h5", "--samples", samples, "--quiet", *options))
    expect_success(run("export", scratch / "o.h5", "--what", "mean", "-o", scratch / "o.csv"))
    with open(scratch / "o.csv", newline="", encoding="utf-8") as file:
        units, *lines = csv.reader(file)
    return {(line[0], unit): float(value) for line in lines for unit, value in zip(units[1:], line[1:])}


def refuses(*words):
    """Accepts a run that ends with exit code 2 and a message that contains the words."""
    return lambda end: end.status == 2 and all(word in end.err for word in words)


def between(low, high):
    return lambda value: low <= value <= high


def kinds():
    """Name of a kind -> its rows."""
    names = sorted(path.stem for path in pathlib.Path(__file__).parent.glob("*.py") if path.stem not in NOT_KINDS)
    modules = {name: importlib.import_module(name) for name in names}
    return {name: module.ROWS for name, module in modules.items() if hasattr(module, "ROWS")}
