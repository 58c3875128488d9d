"""Runs the built program. All Python suites below test/system use this module; ctest puts it on their PYTHONPATH."""

import csv
import json
import os
import pathlib
import resource
import shlex
import signal
import subprocess
import tempfile
import time
import unittest
from dataclasses import dataclass, field

ROOT = pathlib.Path(__file__).parents[2]
PROGRAM = os.environ.get("SHELFBEAM", str(ROOT / "build/release/shelfbeam"))
BUILD = pathlib.Path(os.environ.get("SHELFBEAM_BUILD", ROOT / "build/release"))


@dataclass(frozen=True)
class Run:
    """The end of a run of the program."""

    status: int  # the exit code, or -n after signal n
    out: str
    err: str

    def __str__(self):
        first = (self.err or self.out).strip().splitlines() or [""]
        return f"exit {self.status}: {first[0]}"


def words_of(arguments):
    """The words of a command; a single text is split as by a shell."""
    if len(arguments) == 1 and isinstance(arguments[0], str):
        return shlex.split(arguments[0])
    return [str(word) for word in arguments]


def run(*arguments, limits=(), **options):
    """Runs the program with words, or with one text of several words, to its end.

    `limits` are pairs such as (resource.RLIMIT_AS, bytes); `options` are those of subprocess.run.
    """

    def limit():
        for kind, most in limits:
            resource.setrlimit(kind, (most, most))

    done = subprocess.run(
        [PROGRAM, *words_of(arguments)],
        capture_output=True,
        check=False,
        preexec_fn=limit if limits else None,
        **options,
    )
    return Run(done.returncode, *(text.decode("utf-8", "backslashreplace") for text in (done.stdout, done.stderr)))


class Process:
    """A run beside the test. Its output goes to files, so that it never waits for a reader."""

    def __init__(self, *arguments, folder, **options):
        self.files = [tempfile.TemporaryFile() for _ in range(2)]
        self.process = subprocess.Popen(
            [PROGRAM, *words_of(arguments)], cwd=folder, stdout=self.files[0], stderr=self.files[1], **options
        )

    def wait_until(self, condition):
        """Waits until the condition holds or the program has ended; returns whether it still runs."""
        while self.process.poll() is None and not condition():
            time.sleep(0.002)
        return self.process.poll() is None

    def wait_for_changes(self, path, times=1):
        """Waits until a file or folder has visibly changed `times` times, or the program has ended."""
        known = [None]

        def has_changed():
            try:
                changed = path.stat().st_mtime_ns
            except FileNotFoundError:
                return False
            if changed != known[-1]:
                known.append(changed)
            return len(known) > times

        return self.wait_until(has_changed)

    def end(self, number=signal.SIGINT):
        """Its end after a signal."""
        self.process.send_signal(number)
        return self.wait()

    def wait(self):
        status = self.process.wait()
        texts = []
        for file in self.files:
            file.seek(0)
            texts.append(file.read().decode("utf-8", "backslashreplace"))
            file.close()
        return Run(status, *texts)

    def kill(self):
        self.process.kill()
        self.process.wait()


@dataclass(frozen=True)
class Case:
    """A command in the folder of a test, and its end.

    An exit code other than 0, 1 and 3 means a refusal: one line of error that contains `parts`, and nothing changes.
    """

    line: str  # without the program
    status: int = 0
    parts: tuple = ()  # of its output, or of its error if it is refused
    files: dict = field(default_factory=dict)  # written before: name -> text, or object for JSON


def contents(folder, *ignored):
    """Name -> bytes of the files below a folder (None for a folder), hidden ones included."""
    paths = {str(path.relative_to(folder)): path for path in sorted(folder.rglob("*"))}
    return {name: path.read_bytes() if path.is_file() else None for name, path in paths.items() if name not in ignored}


def small_store(**changes):
    """A room of 8 x 6 x 3 m with a gondola, 17 labels and 12 candidates, none of which reaches all labels alone."""
    return {
        "name": "Kiosk",
        "room": {"size": [8, 6, 3], "floor": "m", "ceiling": "m", "walls": "m"},
        "materials": {"m": {"type": "lambertian", "reflectance": 0.3}},
        "label_types": {"standard": {"threshold": 0.03}},
        "transceiver_types": {"ceiling": {"emission": {"type": "sin2theta", "peak": 1}}},
        "fixtures": [
            {
                **{"type": "gondola", "id": "A", "at": [2, 2.5], "length": 4, "depth": 0.9, "height": 1.8},
                **{"material": "m", "shelves": [0.5, 1.2], "labels": {"type": "standard", "spacing": 1}},
            }
        ],
        "labels": [{"id": "door", "position": [0.1, 3, 1.5], "normal": [1, 0, 0], "type": "standard"}],
        "transceivers": {"grids": [{"type": "ceiling", "min": [1, 1], "max": [7, 5], "spacing": 2, "z": 2.9}]},
        **changes,
    }


class ProgramTest(unittest.TestCase):
    """A test with an empty folder, in which the program runs."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def write(self, name, content):
        """Writes a file: text, bytes, or an object as JSON."""
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if not isinstance(content, str | bytes):
            content = json.dumps(content, ensure_ascii=False)
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    def text(self, name):
        return (self.folder / name).read_text(encoding="utf-8")

    def bytes(self, name):
        return (self.folder / name).read_bytes()

    def json(self, name):
        return json.loads(self.text(name))

    def rows(self, name):
        """The rows of a CSV file."""
        return list(csv.DictReader(self.text(name).splitlines()))

    def run_here(self, *arguments, **options):
        return run(*arguments, cwd=self.folder, **options)

    def start(self, *arguments, **options):
        process = Process(*arguments, folder=self.folder, **options)
        self.addCleanup(process.kill)
        return process

    def told(self, *arguments, status=0):
        """Standard output of a run that ends with this exit code and prints no message."""
        end = self.run_here(*arguments)
        self.assertEqual((end.status, end.err), (status, ""), arguments)
        return end.out

    def answer(self, line, status=0):
        """The object that the program prints with --json."""
        return json.loads(self.told(f"{line} --json", status=status))

    def refused(self, line, *parts, status=2):
        """Expects one line of error that contains the parts, no other output, and unchanged files."""
        before = contents(self.folder)
        end = self.run_here(line)
        self.assertEqual((end.status, end.out), (status, ""), f"{line}: {end.err}")
        self.assertRegex(end.err, r"\Aerror: [^\n]*\n\Z", line)
        for part in parts:
            self.assertIn(part, end.err, line)
        self.assertEqual(contents(self.folder), before, f"{line}: files changed, appeared or vanished")

    def check(self, *cases):
        for case in cases:
            with self.subTest(line=case.line):
                for name, content in case.files.items():
                    self.write(name, content)
                if case.status in (0, 1, 3):
                    out = self.told(case.line, status=case.status)
                    for part in case.parts:
                        self.assertIn(part, out, case.line)
                else:
                    self.refused(case.line, *case.parts, status=case.status)


class ShopTest(ProgramTest):
    """A test in whose folder store.json is the small store."""

    def setUp(self):
        super().setUp()
        self.write("store.json", small_store())
