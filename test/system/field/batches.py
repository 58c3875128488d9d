"""Batches: one bad name, link or list stops no other store, and an interrupt is not a result."""

import csv
import os
import shutil
import signal
import subprocess
import time

from rows import INPUTS, PROGRAM, Row, refuses, run

DATA = INPUTS / "batch"
PLAN = ("--", "--samples", "64", "--budget", "1", "--no-certificate")


def shop(scratch, *names):
    for name in names:
        path = scratch / name / "store.json"
        path.parent.mkdir(parents=True)
        shutil.copy(DATA / "tiny.json", path)


def statuses(scratch):
    """Status -> number of stores."""
    with open(scratch / "r/results.csv", newline="", encoding="utf-8") as file:
        found = [row["status"] for row in csv.DictReader(file)]
    return {status: found.count(status) for status in sorted(set(found))}


def batch(scratch, source, *options):
    return run("batch", source, "-o", "r", *options, *PLAN, folder=scratch)


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
        process = subprocess.Popen(
            [PROGRAM, "batch", "t", "-o", "r", "--jobs", "1", "--threads", "1", *PLAN],
            cwd=scratch,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        while process.poll() is None and not list(scratch.glob("r/records/*.json")):
            time.sleep(0.001)
        time.sleep(0.015 * trial)
        process.send_signal(signal.SIGINT)
        process.wait()
        lost += batch(scratch, "t", "--resume").status != 0
    return lost


def percent_in_path(scratch):
    """The path of the logs that a job array asks for."""
    shop(scratch, "t/a")
    (scratch / "bin").mkdir()
    (scratch / "bin/sbatch").write_text('#!/bin/sh\nprintf "%s\\n" "$@" >>sbatch.log\necho 7\n')
    (scratch / "bin/sbatch").chmod(0o755)
    path = f"{scratch}/bin:{os.environ['PATH']}"
    run("batch", "t", "-o", "sale 50%off", "--slurm", *PLAN, folder=scratch, env={**os.environ, "PATH": path})
    words = (scratch / "sbatch.log").read_text().splitlines()
    return [word.removeprefix(f"--output={scratch}/") for word in words if word.startswith("--output=")]


def equals(value):
    return lambda result: result == value


ROWS = [
    Row(
        "list_long_name.txt",
        "the long name failed, the other planned",
        from_list("list_long_name.txt", "a"),
        equals({"failed": 1, "planned": 1}),
    ),
    Row(
        "list_utf16.txt",
        "is UTF-16; save it as UTF-8",
        lambda scratch: plan_list(scratch, "list_utf16.txt", "a"),
        refuses("UTF-16", "UTF-8"),
    ),
    Row("list_bom.txt", "both planned", from_list("list_bom.txt", "a", "b"), equals({"planned": 2})),
    Row("list_mark.txt", "planned", list_mark, equals({"planned": 1})),
    Row("tree_record_file_and_folder.sh", "three planned", file_and_folder, equals({"planned": 3})),
    Row("tree_link_to_itself.sh", "b failed, a planned", link_to_itself, equals({"failed": 1, "planned": 1})),
    Row(
        "record_of_another_store.sh",
        "--collect names the record, --resume plans b again",
        record_of_another_store,
        equals({"planned": 2}),
    ),
    Row("interrupt_at_start.py", "0 of 6 batches are lost", interrupt_at_start, equals(0), is_slow=True),
    Row(
        "% in the path of a Slurm batch",
        "%% in the paths of logs",
        percent_in_path,
        equals(["sale 50%%off/slurm/%a.log", "sale 50%%off/slurm/collect.log"]),
    ),
]
