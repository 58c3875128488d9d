"""Runs the program with a fault, and checks the files and the message that it leaves."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
PROGRAM = os.environ.get("SHELFBEAM", str(ROOT / "build/release/shelfbeam"))
KEPT = re.compile(r"(?:is|are) kept in '([^']+)'")
TEMPORARY = re.compile(r"^\.(.+)\.shelfbeam-\w{6}$")
PATIENCE = 300  # seconds after which a program counts as hung

STORE = {
    "room": {"size": [8, 6, 3], "floor": "m", "ceiling": "m", "walls": "m"},
    "materials": {"m": {"type": "lambertian", "reflectance": 0.3}},
    "label_types": {"standard": {"threshold": 0.03}},
    "transceiver_types": {"ceiling": {"emission": {"type": "sin2theta", "peak": 1}}},
    "fixtures": [
        {
            "type": "gondola",
            "id": "A",
            "at": [2, 2.5],
            "length": 4,
            "depth": 0.9,
            "height": 1.8,
            "material": "m",
            "shelves": [0.5, 1.2],
            "labels": {"type": "standard", "spacing": 1},
        }
    ],
    "transceivers": {"grids": [{"type": "ceiling", "min": [1, 1], "max": [7, 5], "spacing": 2, "z": 2.9}]},
}


class Verb:
    """A command, its undisturbed output, and the older output of the same command with another seed."""

    def __init__(self, name, base, samples):
        self.name, self.base, self.samples = name, base, samples
        self.output = "plan" if name == "plan" else "signal.h5"
        self.more = ["--overwrite"] if name == "plan" else []
        self.signal = "plan/signal.h5" if name == "plan" else "signal.h5"
        self.whole, self.old = (self.undisturbed(seed) for seed in (1, 2))
        self.seconds = min(self.timed() for _ in range(3))

    def command(self, seed=1, *more):
        return [
            PROGRAM,
            self.name,
            "../store.json",
            "-o",
            self.output,
            "--samples",
            str(self.samples),
            "--checkpoint-interval",
            "0",
            "--seed",
            str(seed),
            *self.more,
            *more,
        ]

    def undisturbed(self, seed):
        folder = self.base / f"{self.name}-{seed}"
        folder.mkdir()
        subprocess.run(self.command(seed, "--quiet"), cwd=folder, check=True)
        return contents(folder)

    def timed(self):
        with tempfile.TemporaryDirectory(dir=self.base) as folder:
            start = time.monotonic()
            subprocess.run(self.command(), cwd=folder, check=True, stdout=subprocess.DEVNULL)
            return time.monotonic() - start


class Outcome:
    def __init__(self, process):
        _, self.err = process.communicate(timeout=PATIENCE)
        self.code = process.returncode


def contents(folder):
    """Names and bytes of all files below a folder, except run.json, which has the times of a run."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.name != "run.json"
    }


def put(folder, files):
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)


def start(command, folder, environment=None, before=None):
    return subprocess.Popen(
        command,
        cwd=folder,
        text=True,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        env={**os.environ, "TMPDIR": elsewhere(folder), **(environment or {})},
        preexec_fn=before,
    )


def elsewhere(folder):
    """Where the program keeps a result that it cannot write to its output."""
    path = Path(folder).parent / "elsewhere"
    path.mkdir(exist_ok=True)
    return str(path)


def look_at_files(verb, found, old, outcome, new=None):
    """The problems of the files that a fault has left."""
    new = new or verb.whole
    problems = []
    checkpoint = verb.signal + ".checkpoint"
    results = {name: content for name, content in found.items() if name in new or name in old}
    for name in found.keys() - results.keys() - {checkpoint}:
        owner = TEMPORARY.match(Path(name).name)
        if not owner:
            problems.append(f"{name} is left")
        elif outcome.code >= 0:
            problems.append(f"{name} is left by a program that was not killed")
    if outcome.code == 3 and results != new:  # complete files with fewer samples
        if verb.name == "plan" and old and results != old:
            problems.append("a finished plan is replaced by an unfinished one")
        if verb.signal in found and found[verb.signal] != old.get(verb.signal):
            problems += readable(verb, found)
        return problems
    for name, content in results.items():
        if content not in (old.get(name), new.get(name)):
            problems.append(f"{name} is neither the old file nor the new one")
    if results == new or results == old:
        return problems
    if verb.name == "simulate" or "plan/placement.json" in results:
        problems.append("a mixture of old and new files: " + " ".join(sorted(results)))
    if "plan/report.html" in old and "plan/report.html" not in results:
        problems.append("the report is lost")
    return problems


def readable(verb, found):
    with tempfile.TemporaryDirectory(dir=verb.base) as folder:
        put(Path(folder), found)
        command = ["report", "plan"] if verb.name == "plan" else ["place", "signal.h5", "-o", "placement.json"]
        outcome = Outcome(start([PROGRAM, *command], folder))
    return [] if outcome.code in (0, 1, 3) else [f"the output cannot be read: {outcome.err}"]


def look_at_message(verb, found, old, outcome):
    """The problems of the program's message."""
    if outcome.code < 0 or outcome.code == 0:
        return []
    lines = outcome.err.splitlines()
    if len(lines) != 1:
        return [f"{len(lines)} lines on standard error: {outcome.err}"]
    problems = []
    kept = verb.signal + ".checkpoint" in found
    if outcome.code == 3:
        if not lines[0].startswith(("stopped: ", "stopped early: ")):
            problems.append("does not report that it stopped")
    elif outcome.code == 2:
        if not lines[0].startswith("error: ") or "cannot be written (" not in lines[0]:
            problems.append("does not name the file that cannot be written")
        name = lines[0].removeprefix("error: ").split(": ")[0]
        if name in old and found.get(name) == old[name] and "is unchanged" not in lines[0]:
            problems.append("does not report that the old file stays")
    else:
        problems.append(f"exit code {outcome.code}")
    if kept and "--resume" not in lines[0]:
        problems.append("does not name the checkpoint from which --resume continues")
    if "repeat the command with '--resume'" in lines[0] and not kept and "uses the samples" not in lines[0]:
        problems.append("mentions a checkpoint that does not exist")
    return [f"{problem}: {lines[0]}" for problem in problems]


def look_elsewhere(verb, outcome):
    """The problems of a result that was kept elsewhere, which is then removed."""
    named = KEPT.search(outcome.err)
    if not named:
        return []
    path = Path(named[1])
    is_plan = path.is_dir()
    folder = path if is_plan else path.parent
    found = {("plan/" if is_plan else "") + name: content for name, content in contents(folder).items()}
    shutil.rmtree(folder)
    if is_plan:
        return [] if found == verb.whole else [f"another plan is kept: {' '.join(sorted(found))}"]
    with tempfile.TemporaryDirectory(dir=verb.base) as scratch:
        put(Path(scratch), found)
        outcome = Outcome(start([PROGRAM, "place", "signal.h5", "--threshold", "0.03"], scratch))
    return [] if outcome.code in (0, 1, 3) else [f"the kept signals cannot be read: {outcome.err}"]


def look_at_resumption(verb, folder, seed=1, whole=None):
    threads = str(1 + seed % 3)
    outcome = Outcome(start(verb.command(seed, "--resume", "--threads", threads, "--quiet"), folder))
    if outcome.code != 0:
        return [f"--resume ends with {outcome.code}: {outcome.err}"]
    found, whole = contents(folder), whole or verb.whole
    if found == whole:
        return []
    return [
        "files differ after --resume: "
        + " ".join(sorted(name for name in found.keys() | whole.keys() if found.get(name) != whole.get(name)))
    ]


class Trials:
    """Injects faults and counts losses. `inject` maps a folder to an Outcome, or to None if the fault had no effect."""

    def __init__(self, base, dice):
        self.base, self.dice = base, dice
        self.rows, self.lost = [], 0

    def run(self, kind, verb, count, inject, plant=None, unlimited=False):
        injected = lost = tries = 0
        while injected < count and tries < 20 * count + 20:
            tries += 1
            with tempfile.TemporaryDirectory(dir=self.base) as name:
                folder = Path(name)
                old = verb.old if self.dice.random() < 0.5 else {}
                put(folder, old)
                outcome = inject(folder)
                if outcome is None:
                    if unlimited:
                        break
                    continue
                injected += 1
                if plant:
                    plant(folder)
                found = contents(folder)
                problems = look_at_files(verb, found, old, outcome) + look_at_message(verb, found, old, outcome)
                problems += look_elsewhere(verb, outcome)
                problems += look_at_resumption(verb, folder)
            lost += self.judge(kind, verb.name, problems, plant)
        self.row(kind, verb.name, injected, lost)

    def judge(self, kind, verb, problems, quiet=False):
        for problem in problems if not quiet else []:
            print(f"{kind}, {verb}: {problem}", file=sys.stderr)
        return 1 if problems else 0

    def row(self, kind, verb, injected, lost):
        self.lost += lost
        self.rows.append((kind, verb, injected, injected - lost, lost))
        print(f"| {kind} | {verb} | {injected} | {injected - lost} | {lost} |", flush=True)
