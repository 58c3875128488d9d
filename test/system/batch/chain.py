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


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(item) for key, item in value.items() if key not in ("seconds", "effort")}
    return [without_times(item) for item in value] if isinstance(value, list) else value


def tables(folder):
    """The tables of results.sqlite, except the one with times."""
    with sqlite3.connect(folder / "results.sqlite") as database:
        return {name: database.execute(f"SELECT * FROM {name}").fetchall() for name in ("stores", "warnings")}


def rows(folder):
    """The rows of results.csv without times."""
    with open(folder / "results.csv", newline="", encoding="utf-8") as file:
        return [{key: value for key, value in row.items() if key not in EFFORT_COLUMNS} for row in csv.DictReader(file)]


def contents(folder):
    """All results, without times. The record in placement.json has the hash of the report without its times."""
    found = {"database": tables(folder), "table": rows(folder)}
    for part in ("plans", "records"):
        for path in sorted((folder / part).rglob("*")):
            name = str(path.relative_to(folder))
            if path.suffix == ".json" and path.name != "store.json" and path.is_file():
                found[name] = without_times(json.loads(path.read_text(encoding="utf-8")))
            elif path.is_file() and path.name != "report.html":
                found[name] = path.read_bytes()
            else:
                found[name] = None
    return found


def differences(folder, other):
    """The names of results in which two folders differ."""
    ours, theirs = contents(folder), contents(other)
    return sorted(name for name in ours.keys() | theirs.keys() if ours.get(name, "?") != theirs.get(name, "?"))
