"""A chain of shops, its plans, and the results without times."""

import csv
import json
import sqlite3
import sys

from harness import ROOT, ProgramTest, output

EFFORT_COLUMNS = ["runs", "cpu_s", "wall_s", "peak_memory"]
TINY = ROOT / "test/data/field/batch/tiny.json"
QUICK = "-- --samples 64 --estimator uniform --no-certificate"  # no decision depends on time


def make_chain(folder, *arguments):
    output(ROOT / "scripts/make-chain", folder, *arguments, program=sys.executable)


class BatchTest(ProgramTest):
    """Plans the shops of the folder t to the folder r."""

    def setUp(self):
        super().setUp()
        self.shops, self.results = self.folder / "t", self.folder / "r"

    def add_shop(self, name, store=None):
        """Adds a shop, by default a tiny one, and returns its file."""
        return self.write(self.shops / name / "store.json", TINY.read_bytes() if store is None else store)

    def batch(self, options="", status=0, source="t", **process):
        end = self.run_here(f"batch {source} -o r {options}", **process)
        self.assertEqual(end.status, status, end.err)
        return end

    def statuses(self):
        return {row["name"]: row["status"] for row in rows(self.results)}


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
