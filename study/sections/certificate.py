"""The certified plan, which answers the paper's open question of convergence (if the program certifies plans)."""

import json

from study.core import page
from study.core.findings import Section
from study.core.study import STORE
from study.core.text import seconds

CONFIDENCE = "0.99"


def is_there(study):
    return study.program.has_option("plan", "--confidence")


def _facts(value, name=""):
    """Numbers and texts of a JSON object with their paths; long lists are reduced to their lengths."""
    if isinstance(value, dict):
        return [fact for key, one in value.items() for fact in _facts(one, f"{name}.{key}" if name else key)]
    if isinstance(value, list):
        return (
            [(name, f"{len(value)} entries")]
            if any(isinstance(one, (dict, list)) for one in value) or len(value) > 8
            else [(name, ", ".join(map(str, value)))]
        )
    return [(name, value)]


def section(study):
    result = Section(
        "The certified plan",
        "beyond 2.11.2 and 3.5.4",
        (
            "The paper leaves open when a simulation has converged. A certified plan continues until"
            " independent samples verify the placement and fewer transceivers are ruled out. Does it"
            " end here?"
        ),
    )
    rows = []
    for model in ("cooperative", "non-cooperative"):
        name = f"plan-{model}"
        options = ["--model", model, "--confidence", CONFIDENCE, "--budget", f"{study.effort.budget:g}"]
        folder = study.program.run(name, ["plan", STORE, *options], [STORE], accepted=(0, 1, 3))
        with open(folder / "placement.json", encoding="utf-8") as file:
            answer = json.load(file)
        record = study.program.record(name)
        rows.append(
            (
                model,
                answer["count"],
                answer["count_lower_bound"],
                answer["status"],
                record["exit_code"],
                seconds(record["seconds"]),
            )
        )
        facts = list(_facts(answer.get("certificate") or {}))
        result.tables[f"certificate_{model}"] = (("key", "value"), facts)
        if facts:
            result.add(page.details(f"The certificate, {model}", page.table(("key", "value"), facts, wide=(1,))))
        equal = answer["count"] is not None and answer["count"] == answer["count_lower_bound"]
        result.tell(
            (
                f"{model.capitalize()}: {answer['count']} transceivers, with a lower bound of"
                f" {answer['count_lower_bound']}, after {seconds(record['seconds'])} (exit code"
                f" {record['exit_code']})."
            ),
            ("Count and bound are equal" if equal else "Count and bound differ")
            + (
                ", and the run is certified."
                if record["exit_code"] == 0
                else ", and the run did not certify everything."
            ),
        )
    header = ("model", "transceivers", "lower bound", "status", "exit code", "time")
    result.tables["certified_plan"] = (header, rows)
    result.body.insert(0, page.table(header, rows, numeric=(1, 2, 4, 5)))
    return result
