"""Injects faults: kills, failing file operations, full disks, read-only folders, two writers and a jumping clock."""

import json
import os
import resource
import shutil
import signal
import subprocess
import tempfile
import time
from pathlib import Path

from trials import PATIENCE, PROGRAM, Outcome, contents, look_at_files, look_at_resumption, put, start


def signalled(verb, dice, number):
    def inject(folder):
        process = start(verb.command(1, "--threads", str(dice.randint(1, 3))), folder)
        time.sleep(dice.uniform(0, 1.1 * verb.seconds))
        process.send_signal(number)
        outcome = Outcome(process)
        return None if outcome.code == 0 else outcome

    return inject


def at_operation(verb, shim, number, error, lasts):
    """Makes one file operation fail. The result is None if the run has fewer operations."""

    def inject(folder):
        count = folder.parent / "count"
        count.unlink(missing_ok=True)
        environment = {
            "LD_PRELOAD": shim,
            "FAULT_AT": str(number()),
            "FAULT_ERRNO": str(error),
            "FAULT_LASTS": str(10**9 if lasts else 0),
            "FAULT_COUNT": str(count),
        }
        outcome = Outcome(start(verb.command(), folder, environment))
        struck = outcome.code == -signal.SIGKILL or int(count.read_text()) >= int(environment["FAULT_AT"])
        return outcome if struck else None

    return inject


def operations_of(verb, shim):
    with tempfile.TemporaryDirectory(dir=verb.base) as folder:
        count = verb.base / "count"
        Outcome(start(verb.command(), folder, {"LD_PRELOAD": shim, "FAULT_COUNT": str(count)}))
        return int(count.read_text())


def each(last, count, dice):
    """The numbers 1 to last, or a random sample of `count` of them if there are more."""
    return iter(sorted(dice.sample(range(1, last + 1), min(count, last))))


def some_size(verb, dice):
    largest = max(map(len, verb.whole.values()))
    return int(largest ** dice.uniform(0.3, 1.02))


def beyond_file_size(verb, dice):
    def inject(folder):
        size = some_size(verb, dice)
        outcome = Outcome(
            start(verb.command(), folder, before=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)))
        )
        return None if outcome.code == 0 else outcome

    return inject


def mount(*arguments):
    subprocess.run(["mount", *arguments], check=True)


def on_full_disk(verb, dice):
    def inject(folder):
        content = contents(folder)
        # Pages for the old output and a few more, rarely enough for the new output.
        pages = sum(len(data) // 4096 + 1 for data in content.values())
        pages += dice.randint(1, 10 if verb.name == "simulate" else 170)
        mount("-t", "tmpfs", "-o", f"size={pages * 4}k", "tmpfs", folder)
        try:
            put(folder, content)
            command = verb.command()
            command[2] = str(verb.base / "store.json")
            outcome = Outcome(start(command, folder))
            after = {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}
        finally:
            subprocess.run(["umount", folder], check=True)
        shutil.rmtree(folder)
        folder.mkdir()
        put(folder, after)
        return None if outcome.code == 0 else outcome

    return inject


def read_only(verb, has_mounts):
    def inject(folder):
        if has_mounts:
            mount("--bind", folder, folder)
            mount("-o", "remount,ro,bind", folder)
        else:
            folder.chmod(0o555)
        try:
            outcome = Outcome(start(verb.command(), folder))
        finally:
            if has_mounts:
                subprocess.run(["umount", folder], check=True)
            else:
                folder.chmod(0o755)
        return None if outcome.code == 0 else outcome

    return inject


def two_writers(trials, verb, count, dice):
    """Two processes write to one output: with the same seed, with two seeds, and with one process killed."""
    kind, lost = "two processes, one output", 0
    for trial in range(count):
        seeds = (1, 1) if trial % 3 == 0 else (1, 2)
        with tempfile.TemporaryDirectory(dir=trials.base) as name:
            folder = Path(name)
            both = [start(verb.command(seed), folder) for seed in seeds]
            if trial % 3 == 2:
                time.sleep(dice.uniform(0, 1.5 * verb.seconds))
                both[dice.randint(0, 1)].kill()
            ends = [Outcome(process) for process in both]
            problems = []
            for end, other in zip(ends, reversed(both)):
                is_refused = f"is in use by another run of shelfbeam (process {other.pid})" in end.err
                if end.code not in (0, -signal.SIGKILL) and not (end.code == 2 and is_refused):
                    problems.append(f"exit code {end.code}: {end.err}")
            if all(end.code == 2 for end in ends):
                problems.append("both are refused")
            found = contents(folder)
            worst = min(ends, key=lambda end: end.code)
            seed = 2 if 2 in seeds and found.get(verb.signal) == verb.old[verb.signal] else 1
            # Without a kill, the folder contains one complete result. A killed process may leave a checkpoint.
            new = verb.old if seed == 2 else verb.whole
            problems += look_at_files(verb, found, {}, worst, new)
            if worst.code == 0 and found != new:
                problems.append("not one complete result: " + " ".join(sorted(found)))
            resumed = look_at_resumption(verb, folder, seed, new)
            if worst.code != 0 and resumed and "another simulation" in resumed[0]:
                resumed = look_at_resumption(verb, folder, 3 - seed, verb.whole if seed == 2 else verb.old)
            problems += resumed
        lost += trials.judge(kind, verb.name, problems)
    trials.row(kind, verb.name, count, lost)


def jumping_clock(trials, verb, count, shim, dice, jumps=1, quiet=False):
    """The wall clock jumps at every reading: the output stays the same, and time limits hold."""
    kind, lost = "clock jumps", 0
    environment = {"LD_PRELOAD": shim, "CLOCK_JUMPS": str(jumps)}
    for _ in range(count):
        with tempfile.TemporaryDirectory(dir=trials.base) as name:
            folder = Path(name)
            outcome = Outcome(start(verb.command(1, "--threads", str(dice.randint(1, 3))), folder, environment))
            problems = [] if outcome.code == 0 else [f"exit code {outcome.code}: {outcome.err}"]
            if contents(folder) != verb.whole:
                problems.append("other bytes")
            if verb.name == "simulate":
                begun = time.monotonic()
                told = subprocess.run(
                    [PROGRAM, "simulate", "../store.json", "-o", "timed.h5", "--time", "0.3", "--json"],
                    cwd=folder,
                    env={**os.environ, **environment},
                    stdout=subprocess.PIPE,
                    timeout=PATIENCE,
                ).stdout
                passed = time.monotonic() - begun
                if not 0.2 < json.loads(told)["seconds"] <= passed:
                    problems.append(f"--time 0.3 took {json.loads(told)['seconds']} s, by our clock {passed:.2f} s")
        lost += trials.judge(kind, verb.name, problems, quiet)
    trials.row(kind, verb.name, count, lost)
