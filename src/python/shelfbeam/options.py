"""Keywords of the functions, as a job for the compiled part, and progress."""

from __future__ import annotations

import contextlib
import csv
import json
import os
import re
import sys
import tempfile
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from .errors import KEYWORDS, expect, make

ProgressOption = bool | Callable[["Progress"], None] | None
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
KEYWORDS.update({key: keyword for keyword, key in _KEYS.items()})
KEYWORDS.update({"plan.problem.model": "model", "plan.goal.value": "availability, all_at_once or mean_missed"})
_LISTS = {"costs", "forbid", "pin", "exclude", "without", "sampled"}


def options(store: str = "store", folder: Path = ".", **keywords: Any) -> str:
    """The job of keywords; None and False mean the default."""
    job: dict[str, Any] = {"store": store, "folder": os.fspath(folder)}
    for keyword, value in keywords.items():
        if value is None or value is False and keyword != "certificate":
            continue
        if keyword in _LISTS:
            value = as_list(value)
            expect(
                all(isinstance(one, (str, os.PathLike)) for one in value), "is not a list of texts or files", keyword
            )
            value = [os.fspath(one) for one in value]
        elif keyword == "memory":
            value = size_in_bytes(value)
        elif isinstance(value, os.PathLike):
            value = os.fspath(value)
        *sections, key = _KEYS.get(keyword, keyword).split(".")
        part = job
        for section in sections:
            part = part.setdefault(section, {})
        part[key] = value
    return to_json(job)


def to_json(document: Any, indent: int | None = None) -> str:
    """JSON of a document that may contain NumPy values."""

    def plain(value: Any) -> Any:
        if hasattr(value, "tolist"):
            return value.tolist()
        raise TypeError(f"{value!r} is not a value of JSON")

    try:
        return json.dumps(document, ensure_ascii=False, indent=indent, default=plain, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise make("input", str(error), 2, "", "") from None


def size_in_bytes(size: float | str) -> int:
    """A number, or a text such as "4G" or "500M"."""
    found = re.fullmatch(r"\s*(\d+(?:\.\d+)?)\s*([KMGT]?)(i?)B?\s*", str(size), re.IGNORECASE)
    expect(found is not None, f"{size!r} is not a size such as 4G or 500M", "memory")
    assert found is not None
    base = 1024 if found[3] else 1000
    return int(float(found[1]) * base ** (" KMGT".index(found[2].upper()) if found[2] else 0))


def problem(model: str | None, weighted: bool, lexicographic: bool, **keywords: Any) -> dict[str, Any]:
    """The keywords of a placement problem."""
    expect(not (weighted and lexicographic), "excludes lexicographic: use one of them", "weighted")
    combination = "weighted" if weighted else "lexicographic" if lexicographic else None
    return {"plan_model": model, "combination": combination, **keywords}


def goal(availability: float | None, all_at_once: float | None, mean_missed: float | None) -> Any:
    """The goal for a shop that changes."""
    rules = {"labels": availability, "shop": all_at_once, "misses": mean_missed}
    given = [{"rule": rule, "value": value} for rule, value in rules.items() if value is not None]
    expect(len(given) < 2, "excludes all_at_once and mean_missed: use one of them", "availability")
    return given[0] if given else None


def as_list(value: Path | Iterable[Any]) -> list[Any]:
    """A single text or path as a list of one."""
    return [value] if isinstance(value, (str, os.PathLike)) else list(value)


@dataclass(frozen=True)
class Progress:
    """The state of a long call. A value that is not known is None."""

    task: str
    detail: str
    fraction: float | None  #: of the task that is done
    seconds_left: float | None
    incumbent: float | None  #: value of the best placement so far
    lower_bound: float | None  #: proven on the value

    @classmethod
    def of(cls, line: str) -> Progress:
        """A line of events (docs/formats/job.md)."""
        event = json.loads(line)
        names = {"task": "task", "detail": "detail", "share": "fraction", "seconds_left": "seconds_left",
                 "incumbent": "incumbent", "lower_bound": "lower_bound"}  # fmt: skip
        return cls(**{name: event[key] for key, name in names.items()})


@contextlib.contextmanager
def pair_files(forbid: Any) -> Iterator[list[Path] | None]:
    """Pairs of units as a CSV file; files stay as they are."""
    if forbid is None or isinstance(forbid, (str, os.PathLike)):
        yield None if forbid is None else [forbid]
        return
    members = list(forbid)
    pairs = [one for one in members if not isinstance(one, (str, os.PathLike))]
    if not pairs:
        yield members
        return
    expect(len(pairs) == len(members) and all(len(pair) == 2 for pair in pairs), "mixes files and pairs", "forbid")  # noqa: PLR2004
    with tempfile.TemporaryDirectory(prefix="shelfbeam-") as folder:
        file = os.path.join(folder, "forbid.csv")
        with open(file, "w", newline="", encoding="utf-8") as out:
            csv.writer(out).writerows([("a", "b"), *pairs])
        yield [file]


@contextlib.contextmanager
def lines_of(progress: ProgressOption) -> Iterator[Callable[[str], None] | None]:
    """The callable that gets lines of events: for True, it shows a bar of tqdm, or a line per task without tqdm."""
    expect(progress is None or isinstance(progress, bool) or callable(progress), "is not callable", "progress")
    if progress is None or progress is False:
        yield None
    elif callable(progress):
        show = progress
        yield lambda line: show(Progress.of(line))
    else:
        try:
            from tqdm.auto import tqdm  # noqa: PLC0415: optional
        except ImportError:
            tasks = _Tasks()
            yield lambda line: tasks.show(Progress.of(line))
            return
        with tqdm(total=100, bar_format="{desc}: {percentage:3.0f}% |{bar}| {elapsed}<{remaining}") as bar:
            yield lambda line: _show(bar, Progress.of(line))


def _show(bar: Any, state: Progress) -> None:
    bar.set_description_str(f"{state.task} {state.detail}".strip(), refresh=False)
    bar.n = round(100 * (state.fraction or 0))
    bar.refresh()


class _Tasks:
    """Progress as one line per task."""

    def __init__(self) -> None:
        self._task = ""

    def show(self, state: Progress) -> None:
        if state.task != self._task:
            self._task = state.task
            print(f"{state.task} ...", file=sys.stderr)
