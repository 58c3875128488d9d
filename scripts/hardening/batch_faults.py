"""Disturbs batches, and checks that `--resume` ends with the results of an undisturbed one."""

import copy
import errno
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from trials import PROGRAM, ROOT, STORE, Outcome, start

os.environ.setdefault("SHELFBEAM", PROGRAM)
sys.path[:0] = [str(ROOT / "test/system/batch"), str(ROOT / "test/support")]

import chain  # noqa: E402


class Batch:
    """A batch of three shops, one of which no placement serves, and of a store that cannot be read."""

    name = "batch"

    def __init__(self, base):
        self.base, self.shops = base, base / "shops"
        shops = {name: copy.deepcopy(STORE) for name in ("near", "far/out", "dim")}
        shops["far/out"]["room"]["size"][0] = 9
        shops["dim"]["label_types"]["standard"]["threshold"] = 100
        for name, store in shops.items():
            self.put(name, json.dumps(store))
        self.put("broken", "{")
        self.whole = base / "whole"
        begun = time.monotonic()
        subprocess.run(
            self.command(self.whole), cwd=base, check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        self.seconds = time.monotonic() - begun
        found = {row["name"]: row["status"] for row in chain.rows(self.whole)}
        expected = {"near": "planned", "far/out": "planned", "dim": "infeasible", "broken": "failed"}
        if found != expected:
            raise RuntimeError(f"the undisturbed batch ends with {found}")

    def put(self, name, text):
        path = self.shops / name / "store.json"
        path.parent.mkdir(parents=True)
        path.write_text(text)

    def command(self, results, *more):
        return [
            PROGRAM,
            "batch",
            str(self.shops),
            "-o",
            str(results),
            "--threads",
            "2",
            *more,
            "--",
            "--samples",
            "1000",
            "--checkpoint-interval",
            "0",
            "--no-certificate",
        ]


def answers(results):
    """The results in final records."""
    found = {}
    for path in (results / "records").rglob("*.json"):
        record = json.loads(path.read_text())
        if record["final"]:
            found[record["name"]] = record["status"]
    return found


def look(batch, results, outcome):
    """The problems of a disturbed batch."""
    if outcome.code not in (0, 1, 2, 3, -signal.SIGKILL, -signal.SIGINT, -signal.SIGTERM):
        return [f"exit code {outcome.code}: {outcome.err}"]
    problems = []
    kept = answers(results)
    for name, status in kept.items():
        if status not in ("planned", "infeasible"):
            problems.append(f"the record of {name} is final: {status}")
    plans = {path: path.stat().st_mtime_ns for name in kept for path in (results / "plans" / name).glob("*.*")}
    ended = Outcome(start(batch.command(results, "--resume"), batch.base))
    if ended.code != 1:  # not all stores have a plan
        problems.append(f"--resume ends with {ended.code}: {ended.err}")
        return problems
    if other := chain.differences(results, batch.whole):
        problems.append(f"other results after --resume: {' '.join(other)}")
    if again := [str(path) for path, time_ns in plans.items() if path.stat().st_mtime_ns != time_ns]:
        problems.append(f"finished plans are made again: {' '.join(again)}")
    return problems


def signalled(batch, dice, number):
    """A signal at a random moment."""

    def inject(results):
        process = start(batch.command(results), batch.base)
        time.sleep(dice.uniform(0, batch.seconds))
        process.send_signal(number)
        return Outcome(process)

    return inject


def at_start(batch, dice, number):
    """A signal while a plan starts: soon after the first record of a plan appears."""

    def inject(results):
        process = start(batch.command(results, "--jobs", str(dice.randint(1, 2))), batch.base)
        while process.poll() is None and all("broken" in path.name for path in (results / "records").rglob("*.json")):
            time.sleep(0.001)
        time.sleep(dice.uniform(0, 0.05))
        process.send_signal(number)
        return Outcome(process)

    return inject


def to_plan(batch, dice, number):
    """A signal for a plan, not for its batch."""

    def inject(results):
        process = start(batch.command(results, "--jobs", "1"), batch.base)
        time.sleep(dice.uniform(0, batch.seconds))
        try:
            for plan in Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split():
                os.kill(int(plan), number)
        except OSError:  # one of them has ended
            pass
        return Outcome(process)

    return inject


def failing(batch, shim, dice, error, lasts):
    """File operations of the batch and of its plans fail, each from its own n-th on."""

    def inject(results):
        environment = {
            "LD_PRELOAD": shim,
            "FAULT_AT": str(dice.randint(1, 150)),
            "FAULT_ERRNO": str(error),
            "FAULT_LASTS": str(10**9 if lasts else 0),
        }
        return Outcome(start(batch.command(results), batch.base, environment))

    return inject


def run(trials, batch, kind, count, inject, plant=None):
    injected = lost = 0
    for _ in range(20 * count + 20):
        if injected == count:
            break
        with tempfile.TemporaryDirectory(dir=trials.base) as name:
            results = Path(name) / "results"
            outcome = inject(results)
            if plant:
                plant(results)
            elif outcome.code == 1 and not chain.differences(results, batch.whole):
                continue  # the fault had no effect
            injected += 1
            lost += trials.judge(kind, batch.name, look(batch, results, outcome), plant)
    trials.row(kind, batch.name, injected, lost)


def disturb_batches(trials, shim, count, dice, asked):
    """`count`: as for the other verbs; 200 are 60 kills and 30 interrupts."""
    kills, few = max(2, count * 3 // 10), max(2, count * 3 // 20)
    kinds = {
        "kill -9 at a random moment": (kills, lambda batch: signalled(batch, dice, signal.SIGKILL)),
        "SIGINT at the start of a plan": (few, lambda batch: at_start(batch, dice, signal.SIGINT)),
        "SIGTERM at the start of a plan": (few, lambda batch: at_start(batch, dice, signal.SIGTERM)),
        "SIGTERM for a plan at a random moment": (few, lambda batch: to_plan(batch, dice, signal.SIGTERM)),
        "n-th operation fails: input/output error": (few, lambda batch: failing(batch, shim, dice, errno.EIO, 0)),
        "all from the n-th on fail: disk full": (few, lambda batch: failing(batch, shim, dice, errno.ENOSPC, 1)),
    }
    wanted = {kind: row for kind, row in kinds.items() if asked(kind)}
    batch = Batch(trials.base) if wanted else None
    for kind, (times, inject) in wanted.items():
        run(trials, batch, kind, times, inject(batch))


def plant_losses(trials):
    """Losses that must be noticed. Returns their number."""
    batch = Batch(trials.base)

    def final_failure(results):  # as an interrupt at the start of a plan would leave it
        path = results / "records/near.json"
        path.write_text(json.dumps({**json.loads(path.read_text()), "status": "failed", "report": ""}))

    def changed_plan(results):
        with open(results / "plans/dim/labels.csv", "ab") as file:
            file.write(b"\n")

    def lost_plan(results):
        shutil.rmtree(results / "plans/far")

    def undisturbed(results):
        return Outcome(start(batch.command(results), batch.base))

    plants = (final_failure, changed_plan, lost_plan)
    for plant in plants:
        run(trials, batch, f"planted: {plant.__name__}", 1, undisturbed, plant)
    return len(plants)
