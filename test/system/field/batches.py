"""Batches: one bad name, link or list stops no other store, and an interrupt is not a result."""

import csv
import os
import shutil
import time
from collections import Counter

from harness import Process
from rows import INPUTS, Row, equals, refuses, run

DATA = INPUTS / "batch"
PLAN = "-- --samples 64 --estimator uniform --no-certificate"


def shop(scratch, *names):
    for name in names:
        path = scratch / name / "store.json"
        path.parent.mkdir(parents=True)
        shutil.copy(DATA / "tiny.json", path)


def statuses(scratch):
    """Status -> number of stores."""
    with open(scratch / "r/results.csv", newline="", encoding="utf-8") as file:
        return Counter(row["status"] for row in csv.DictReader(file))


def batch(scratch, source, options=""):
    return run(f"batch {source} -o r {options} {PLAN}", folder=scratch)


def plan_list(scratch, name, *names):
    shop(scratch, *(f"s/{name}" for name in names))
    shutil.copy(DATA / name, scratch)
    return batch(scratch, name)


def from_list(name, *names):
    def measure(scratch):
        plan_list(scratch, name, *names)
        return statuses(scratch)

    return measure


def list_mark(scratch):
    shutil.copy(INPUTS / "plain_store.json", scratch)
    (scratch / "list_mark.txt").write_bytes(b"\xef\xbb\xbfplain_store.json\n")
    batch(scratch, "list_mark.txt")
    return statuses(scratch)


def file_and_folder(scratch):
    shop(scratch, "t/x", "t/x.json/y", "t/z")
    batch(scratch, "t")
    return statuses(scratch)


def link_to_itself(scratch):
    shop(scratch, "t/a")
    (scratch / "t/b").mkdir()
    (scratch / "t/b/store.json").symlink_to("store.json")
    batch(scratch, "t")
    return statuses(scratch)


def record_of_another_store(scratch):
    shop(scratch, "t/a", "t/b")
    batch(scratch, "t")
    shutil.copy(scratch / "r/records/a.json", scratch / "r/records/b.json")
    end = batch(scratch, "t", "--collect")
    if end.status != 2 or "r/records/b.json" not in end.err:
        return end
    batch(scratch, "t", "--resume")
    return statuses(scratch)


def interrupt_at_start(scratch):
    """The number of batches that --resume does not complete, of six that are interrupted while a plan starts."""
    shop(scratch, "t/a", "t/b", "t/c")
    lost = 0
    for trial in range(6):
        shutil.rmtree(scratch / "r", ignore_errors=True)
        # With the default estimator, a plan takes long enough to be interrupted.
        plan = PLAN.replace("--estimator uniform", "")
        process = Process(f"batch t -o r --jobs 1 --threads 1 {plan}", folder=scratch)
        process.wait_until(lambda: list(scratch.glob("r/records/*.json")))
        time.sleep(0.015 * trial)
        process.end()
        process.close()
        lost += run(f"batch t -o r --resume {plan}", folder=scratch).status != 0
    return lost


def percent_in_path(scratch):
    """The path of the logs that a job array asks for."""
    shop(scratch, "t/a")
    (scratch / "bin").mkdir()
    (scratch / "bin/sbatch").write_text('#!/bin/sh\nprintf "%s\\n" "$@" >>sbatch.log\necho 7\n')
    (scratch / "bin/sbatch").chmod(0o755)
    path = f"{scratch}/bin:{os.environ['PATH']}"
    run(f"batch t -o 'sale 50%off' --slurm {PLAN}", folder=scratch, env={**os.environ, "PATH": path})
    words = (scratch / "sbatch.log").read_text().splitlines()
    return [word.removeprefix(f"--output={scratch}/") for word in words if word.startswith("--output=")]


def row(name, expected, measure, **statuses):
    return Row(name, expected, measure, equals(statuses))


LONG, MARK = "list_long_name.txt", "list_bom.txt"
ROWS = [
    row(LONG, "the long name failed, the other planned", from_list(LONG, "a"), failed=1, planned=1),
    Row(
        "list_utf16.txt",
        "is UTF-16; save it as UTF-8",
        lambda scratch: plan_list(scratch, "list_utf16.txt", "a"),
        refuses("UTF-16", "UTF-8"),
    ),
    row(MARK, "both planned", from_list(MARK, "a", "b"), planned=2),
    row("list_mark.txt", "planned", list_mark, planned=1),
    row("tree_record_file_and_folder.sh", "three planned", file_and_folder, planned=3),
    row("tree_link_to_itself.sh", "b failed, a planned", link_to_itself, failed=1, planned=1),
    row(
        "record_of_another_store.sh",
        "--collect names the record, --resume plans b again",
        record_of_another_store,
        planned=2,
    ),
    Row("interrupt_at_start.py", "0 of 6 batches are lost", interrupt_at_start, equals(0), is_slow=True),
    Row(
        "% in the path of a Slurm batch",
        "%% in the paths of logs",
        percent_in_path,
        equals(["sale 50%%off/slurm/%a.log", "sale 50%%off/slurm/collect.log"]),
    ),
]
