"""Shared by all sections: the store, the signal files, the placements, and the computing effort."""

import json
import os
import re
import subprocess
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from study.core import paper
from study.core.answers import read_answer, table_answer
from study.core.mirror import Mirror
from study.core.program import Failure, Program, say
from study.core.signals import read_signals
from study.draw.store_map import StoreMap

TOP = Path(__file__).resolve().parents[2]
STORE = TOP / "examples/thesis/store.json"


@dataclass(frozen=True)
class Effort:
    """The amount of computation."""

    samples: tuple  # of the uniform estimator
    reuse_samples: tuple  # of path reuse
    reference_samples: int  # of path reuse with another seed, for comparison
    time_limit: float  # s per solver run
    cut_offs: tuple  # shares of the requirement below which signals are set to 0
    solver_samples: tuple  # for which the solvers are timed
    backends: tuple
    seeds: int  # runs with the fewest samples
    budget: float  # s per certificate


FULL = Effort(
    paper.SAMPLES, (5000, 25000, 50000), 50000, 60, (0, 0.02, 0.05, 0.1, 0.2), paper.SAMPLES, ("highs", "cbc"), 10, 600
)
QUICK = Effort((5000, 25000), (2500,), 5000, 1, (0, 0.05), (5000,), ("highs",), 2, 3)


def read_store(path):
    """Reads one of our store files: JSON with comments on separate lines."""
    text = Path(path).read_text(encoding="utf-8")
    return json.loads(re.sub(r"^\s*//.*$", "", text, flags=re.MULTILINE))


class Study:
    def __init__(self, binary, folder, effort):
        self.effort = effort
        self.folder = Path(folder)
        self.program = Program(binary, self.folder / "work")
        self.tables_folder = self.program.folder / "tables"
        self.store = read_store(STORE)
        self.map = StoreMap(self.store)
        self.width = self.store["room"]["size"][0]

    @property
    def most_samples(self):
        return self.effort.samples[-1]

    def make_tables(self):
        """Runs scripts/thesis-tables for tables 3.1 to 3.3; the other sections use its signal files, too."""
        say("the paper's tables")
        environment = dict(
            os.environ,
            SHELFBEAM=self.program.binary,
            TIME_LIMIT=f"{self.effort.time_limit:g}",
            SAMPLES=" ".join(map(str, self.effort.samples)),
        )
        done = subprocess.run(
            [str(TOP / "scripts/thesis-tables"), str(self.tables_folder.resolve())],
            env=environment,
            stdout=subprocess.DEVNULL,
            check=False,
        )
        if done.returncode != 0:
            raise Failure(f"scripts/thesis-tables exited with {done.returncode}")

    def uniform_file(self, samples):
        return self.tables_folder / f"{samples}.h5"

    @cache
    def uniform(self, samples):
        return read_signals(self.uniform_file(samples))

    def reuse_file(self, samples, seed=1):
        return self.program.run(
            f"reuse-{samples}-{seed}.h5",
            ["simulate", STORE, "--estimator", "reuse", "--samples", samples, "--seed", seed, "--json"],
            [STORE],
        )

    @cache
    def reuse(self, samples, seed=1):
        return read_signals(self.reuse_file(samples, seed))

    @property
    def reference_file(self):
        return self.reuse_file(self.effort.reference_samples, 2)

    @property
    def reference(self):
        """The most precise matrix, independent of all others."""
        return self.reuse(self.effort.reference_samples, 2)

    @cache
    def mirror(self):
        return Mirror(self.reference, self.width)

    def simulation(self, signal_file):
        """The summary of a simulation."""
        with open(f"{signal_file}.json", encoding="utf-8") as file:
            return json.load(file)

    def table_answer(self, samples, model, objective, solver="auto"):
        return table_answer(self.tables_folder, samples, model, objective, solver)

    def place(self, name, signal_file, *arguments, limit=None):
        """A placement by `place`; exit codes 1 and 3 are accepted."""
        limit = limit or self.effort.time_limit
        path = self.program.run(
            f"{name}.json",
            ["place", signal_file, *arguments, "--time-limit", f"{limit:g}", "--json"],
            [signal_file],
            accepted=(0, 1, 3),
        )
        return read_answer(f"{path}.json")  # with the time

    def fewest_in_truth(self, model):
        """The placement with the fewest transceivers on the reference matrix."""
        return self.place(f"reference-{model}-count", self.reference_file, "--model", model)

    def levels(self, signals):
        """The rows of the paper's three levels: lowest shelf; middle shelf and freezer; top shelf."""
        height = signals.labels[:, 2].round(6)
        shelves = sorted({z for z, one in zip(height, signals.label_ids) if not one.startswith("F")})
        return [
            [
                i
                for i, z in enumerate(height)
                if (1 if signals.label_ids[i].startswith("F") else shelves.index(z)) == level
            ]
            for level in range(len(shelves))
        ]

    def sources(self, signals):
        """The four transceivers of Figs 2.9 to 2.12: (figure, words, column)."""
        x, y = self.store["room"]["size"][:2]
        return [
            ("Fig. 2.9", "bottom left", signals.unit_at(0, 0)),
            ("Fig. 2.10", "bottom right", signals.unit_at(x, 0)),
            ("Fig. 2.11", "centre", signals.unit_at(x / 2, y / 2)),
            ("Fig. 2.12", "top middle", signals.unit_at(x / 2, y)),
        ]
