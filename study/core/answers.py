"""Placements of `shelfbeam place` (docs/formats/placement.md)."""

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
    seconds: float | None  # only in printed answers
    solver: str

    @property
    def is_count_proven(self):
        return self.status != "feasible" and self.count == self.count_lower_bound

    @property
    def units(self):
        """The count; [lower bound, count found] without proof; with ~ if the second objective is not proven.

        The greedy algorithm claims no optimality, so its count is given alone.
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
    if read.get("format") != 2:
        raise ValueError(f"{path}: not a placement of format 2")
    return Answer(
        tuple(read["selected"]),
        read["count"],
        read["count_lower_bound"],
        read["status"],
        read["redundant_share"],
        read.get("seconds"),
        read["solver"],
    )


def table_answer(folder, samples, model, objective, solver):
    """A placement in the folder of scripts/thesis-tables."""
    return read_answer(f"{folder}/{samples}-{model}-{objective}-{solver}.json")
