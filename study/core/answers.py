"""Answers of `shelfbeam place` (docs/formats/placement.md)."""

import json
from dataclasses import dataclass

MODELS = ("cooperative", "non-cooperative")


@dataclass(frozen=True)
class Answer:
    selected: tuple  # ids
    count: int
    count_lower_bound: int
    status: str
    redundant_share: float
    seconds: float
    solver: str

    @property
    def is_count_proven(self):
        return self.status != "feasible" and self.count == self.count_lower_bound

    @property
    def units(self):
        """The number of transceivers; [at least, found] without proof, with ~ where a second objective is open.

        An answer of the greedy algorithm claims nothing, so its number stands alone.
        """
        if self.status != "feasible" and self.count != self.count_lower_bound:
            return f"[{self.count_lower_bound:g}, {self.count}]"
        return f"{self.count}" + ("~" if self.status == "stopped" else "")

    @property
    def with_share(self):
        return f"{self.units} {100 * self.redundant_share:.0f}%"


def read_answer(path):
    with open(path, encoding="utf-8") as file:
        read = json.load(file)
    if read.get("format") != 1:
        raise ValueError(f"{path}: not an answer of format 1")
    return Answer(
        tuple(read["selected"]),
        read["count"],
        read["count_lower_bound"],
        read["status"],
        read["redundant_share"],
        read["seconds"],
        read["solver"],
    )


def table_answer(folder, samples, model, objective, solver):
    """An answer that scripts/thesis-tables left in its folder."""
    return read_answer(f"{folder}/{samples}-{model}-{objective}-{solver}.json")
