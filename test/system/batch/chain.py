"""A chain of shops, its plans, and the results without times."""

import csv
import json
import os
import pathlib
import sqlite3
import subprocess
import sys

ROOT = pathlib.Path(__file__).parents[3]
PROGRAM = os.environ["SHELFBEAM"]
EFFORT_COLUMNS = ["runs", "cpu_s", "wall_s", "peak_memory"]


def make_chain(folder, *arguments):
    subprocess.run([sys.executable, ROOT / "scripts/make-chain", folder, *map(str, arguments)], check=True)


def shelfbeam(*arguments, **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False, **options)


def tables(folder):
    """The tables of results.sqlite, except the one with times."""
    with sqlite3.connect(folder / "results.sqlite") as database:
        return {name: database.execute(f"SELECT * FROM {name}").fetchall() for name in ("stores", "warnings")}


def rows(folder):
    """The rows of results.csv without times."""
    with open(folder / "results.csv", newline="", encoding="utf-8") as file:
        return [{key: value for key, value in row.items() if key not in EFFORT_COLUMNS} for row in csv.DictReader(file)]


def contents(folder):
    """All results, without times."""
    found = {"database": tables(folder), "table": rows(folder)}
    for part in ("plans", "records"):
        for path in sorted((folder / part).rglob("*")):
            name = str(path.relative_to(folder))
            if part == "records" and path.suffix == ".json":
                found[name] = {**json.loads(path.read_text(encoding="utf-8")), "effort": None}
            elif path.name != "run.json":
                found[name] = path.read_bytes() if path.is_file() else None
    return found


def differences(folder, other):
    """The names of results in which two folders differ."""
    ours, theirs = contents(folder), contents(other)
    return sorted(name for name in ours.keys() | theirs.keys() if ours.get(name, "?") != theirs.get(name, "?"))
