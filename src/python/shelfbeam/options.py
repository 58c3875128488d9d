"""Keywords of the functions, as a job for the compiled part, and progress."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Iterable
from typing import Any

from ._core import Progress
from .errors import InputError

ProgressOption = bool | Callable[[Progress], None] | None
Path = str | os.PathLike[str]

# The key in a job (docs/formats/job.md) of each keyword.
_KEYS = {
    "seed": "plan.seed",
    "estimator": "plan.simulation.estimator",
    "direct": "plan.simulation.direct",
    "samples": "plan.simulation.samples",
    "relative_error": "plan.simulation.relative_error",
    "above": "plan.simulation.above",
    "max_samples": "plan.simulation.max_samples",
    "time": "plan.simulation.seconds",
    "strategy": "plan.simulation.strategy",
    "heuristic": "plan.simulation.heuristic",
    "max_bounces": "plan.simulation.max_bounces",
    "memory": "plan.simulation.memory",
    "plan_model": "plan.problem.model",
    "objective": "plan.problem.objective",
    "combination": "plan.problem.combination",
    "share": "plan.problem.share",
    "survive_failure": "plan.problem.survives_failure",
    "at_most": "plan.at_most",
    "reach": "plan.reach",
    "solver": "plan.place.solver",
    "backend": "plan.place.backend",
    "time_limit": "plan.place.time_limit",
    "costs": "plan.constraints.costs",
    "min_spacing": "plan.constraints.min_spacing",
    "forbid": "plan.constraints.forbidden",
    "certificate": "plan.certify",
    "confidence": "plan.confidence",
    "budget": "plan.budget",
    "curve": "plan.curve",
    "reflectance_error": "plan.reflectance_error",
    "states": "plan.states",
    "goal": "plan.goal",
    "pin": "pinned",
    "exclude": "excluded",
    "checkpoint_interval": "checkpoint_interval",
}
_LISTS = {"costs", "forbid", "pin", "exclude", "without", "sampled"}


def options(store: str = "store", folder: Path = ".", **keywords: Any) -> str:
    """The job of keywords; those that are None or False have their defaults."""
    job: dict[str, Any] = {"store": store, "folder": os.fspath(folder)}
    for keyword, value in keywords.items():
        if value is None or value is False and keyword != "certificate":
            continue
        if keyword in _LISTS:
            value = [os.fspath(one) for one in as_list(value)]
        elif keyword == "memory":
            value = int(value)
        elif isinstance(value, os.PathLike):
            value = os.fspath(value)
        *sections, key = _KEYS.get(keyword, keyword).split(".")
        part = job
        for section in sections:
            part = part.setdefault(section, {})
        part[key] = value.item() if hasattr(value, "item") else value
    try:
        return json.dumps(job)
    except TypeError as error:
        raise InputError(f"a keyword has a value of an unknown type: {error}", 2) from None


def problem(model: str | None, weighted: bool, lexicographic: bool, **keywords: Any) -> dict[str, Any]:
    """The keywords of a placement problem."""
    if weighted and lexicographic:
        raise InputError("weighted excludes lexicographic: use one of them (weighted)", 2, "weighted", "weighted")
    combination = "weighted" if weighted else "lexicographic" if lexicographic else None
    return {"plan_model": model, "combination": combination, **keywords}


def goal(availability: float | None, all_at_once: float | None, mean_missed: float | None) -> Any:
    """The goal for a shop that changes."""
    rules = {"labels": availability, "shop": all_at_once, "misses": mean_missed}
    given = [{"rule": rule, "value": value} for rule, value in rules.items() if value is not None]
    if len(given) > 1:
        raise InputError("availability, all_at_once and mean_missed exclude one another: use one of them", 2)
    return given[0] if given else None


def as_list(value: Path | Iterable[Any]) -> list[Any]:
    """A single text or path as a list of one."""
    return [value] if isinstance(value, (str, os.PathLike)) else list(value)


def callback(progress: ProgressOption) -> Callable[[Progress], None] | None:
    """The callable that gets the progress: for True, a bar of tqdm if it is installed, or lines on standard error."""
    if progress is None or progress is False:
        return None
    if callable(progress):
        return progress
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _Lines()
    bar = tqdm(total=100, bar_format="{desc}: {percentage:3.0f}% |{bar}| {elapsed}<{remaining}")

    def show(state: Progress) -> None:
        bar.set_description_str(f"{state.task} {state.detail}".strip(), refresh=False)
        bar.n = round(100 * (state.fraction or 0))
        bar.refresh()

    return show


class _Lines:
    """Progress as one line per task."""

    def __init__(self) -> None:
        self._task = ""

    def __call__(self, state: Progress) -> None:
        if state.task != self._task:
            self._task = state.task
            print(f"{state.task} ...", file=sys.stderr)
