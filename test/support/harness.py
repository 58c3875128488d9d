"""Runs the built program. All Python suites below test/system use this module; ctest puts it on their PYTHONPATH."""

import contextlib
import csv
import itertools
import json
import os
import pathlib
import re
import resource
import shlex
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from dataclasses import dataclass

ROOT = pathlib.Path(__file__).parents[2]
PROGRAM = os.environ.get("SHELFBEAM", str(ROOT / "build/release/shelfbeam"))
BUILD = pathlib.Path(os.environ.get("SHELFBEAM_BUILD", ROOT / "build/release"))
FEW = "--samples 64 --estimator uniform"
PLAN_FILES = set(
    "bill.csv labels.csv mounting.csv mounting.dxf placement.csv placement.json report.html run.json signal.h5 "
    "store.json verification.csv".split()
)


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


def run(*arguments, limits=(), program=PROGRAM, **options):
    """Runs the program, or another, with words, or with one text of several words, to its end.

    `limits` are pairs such as (resource.RLIMIT_AS, bytes); `options` are those of subprocess.run.
    """

    def limit():
        for kind, most in limits:
            resource.setrlimit(kind, (most, most))

    done = subprocess.run(
        [program, *words_of(arguments)],
        capture_output=True,
        check=False,
        preexec_fn=limit if limits else None,
        **options,
    )
    return Run(done.returncode, *map(as_text, (done.stdout, done.stderr)))


def as_text(content):
    return content.decode("utf-8", "backslashreplace")


def output(*arguments, **options):
    """Standard output of a run that succeeds."""
    end = run(*arguments, **options)
    if end.status:
        raise RuntimeError(f"{' '.join(words_of(arguments))}: exit {end.status}\n{end.out}{end.err}")
    return end.out


def sanitizers():
    """The sanitizers of the build, such as "address,undefined"."""
    cache = BUILD / "CMakeCache.txt"
    found = cache.exists() and re.search(r"^SHELFBEAM_SANITIZE:\w+=(.*)", cache.read_text(encoding="utf-8"), re.M)
    return found[1] if found else ""


def has(program):
    """Whether a program is there. Always in continuous integration: a test that lacks it must fail there."""
    return "CI" in os.environ or shutil.which(program)


class Process:
    """A run beside the test. Its output goes to files, so that it never waits for a reader."""

    def __init__(self, *arguments, folder=None, program=PROGRAM, **options):
        self.files = [tempfile.TemporaryFile() for _ in range(2)]
        self.process = subprocess.Popen(
            [program, *words_of(arguments)], cwd=folder, stdout=self.files[0], stderr=self.files[1], **options
        )

    def printed(self, number=1):
        """The output so far: 1 is standard output, 2 is standard error."""
        file = self.files[number - 1].fileno()
        return as_text(os.pread(file, os.fstat(file).st_size, 0))

    def wait_until(self, condition, seconds=600):
        """Waits until the condition holds or the program has ended; returns whether it still runs."""
        late = time.monotonic() + seconds
        while self.process.poll() is None and not condition():
            if time.monotonic() > late:
                raise TimeoutError(f"after {seconds} s, the event has not come: {self.printed(1)}{self.printed(2)}")
            time.sleep(0.002)
        return self.process.poll() is None

    def wait_for_changes(self, path, times=1):
        """Waits until a file or folder has visibly changed `times` times, or the program has ended."""
        known = set()

        def has_changed():
            with contextlib.suppress(FileNotFoundError):
                status = path.stat()
                known.add((status.st_mtime_ns, status.st_ino))
            return len(known) >= times

        return self.wait_until(has_changed)

    def wait_for_work(self, seconds):
        """Waits until it handles SIGINT and has used so much processor time, or has ended."""
        folder = pathlib.Path(f"/proc/{self.process.pid}")

        def has_worked():
            caught = int(re.search(r"^SigCgt:\s*(\w+)$", (folder / "status").read_text(encoding="utf-8"), re.M)[1], 16)
            fields = (folder / "stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()
            used = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
            return (caught >> (signal.SIGINT - 1)) & 1 and used >= seconds

        return self.wait_until(has_worked)

    def end(self, number=signal.SIGINT):
        """Sends a signal, and returns the end of the run."""
        if number != signal.SIGKILL and "thread" in sanitizers():
            # It delays signals until a system call, of which loops of arithmetic make none.
            raise unittest.SkipTest("the thread sanitizer delays signals for hours")
        self.process.send_signal(number)
        return self.wait()

    def wait(self):
        status = self.process.wait()
        return Run(status, self.printed(1), self.printed(2))

    def kill(self):
        self.process.kill()
        self.process.wait()

    def close(self):
        """Ends it, and forgets its output."""
        self.kill()
        for file in self.files:
            file.close()


def contents(folder, *ignored):
    """Name -> bytes of the files below a folder (None for a folder), hidden ones included."""
    paths = {str(path.relative_to(folder)): path for path in sorted(folder.rglob("*"))}
    return {name: path.read_bytes() if path.is_file() else None for name, path in paths.items() if name not in ignored}


def small_store(**changes):
    """A room of 8 x 6 x 3 m with a gondola, 17 labels and 12 candidates, none of which reaches all labels alone."""
    gondola = {"type": "gondola", "id": "A", "at": [2, 2.5], "length": 4, "depth": 0.9, "height": 1.8, "material": "m"}
    return {
        "name": "Kiosk",
        "room": {"size": [8, 6, 3], "floor": "m", "ceiling": "m", "walls": "m"},
        "materials": {"m": {"type": "lambertian", "reflectance": 0.3}},
        "label_types": {"standard": {"threshold": 0.03}},
        "transceiver_types": {"ceiling": {"emission": {"type": "sin2theta", "peak": 1}}},
        "fixtures": [{**gondola, "shelves": [0.5, 1.2], "labels": {"type": "standard", "spacing": 1}}],
        "labels": [{"id": "door", "position": [0.1, 3, 1.5], "normal": [1, 0, 0], "type": "standard"}],
        "transceivers": {"grids": [{"type": "ceiling", "min": [1, 1], "max": [7, 5], "spacing": 2, "z": 2.9}]},
        **changes,
    }


def store_with(values):
    """The small store with other values at places such as "labels/0/position"; the index after the last appends."""
    store = small_store()
    for place, value in values.items():
        *keys, last = place.split("/")
        part = store
        for key in keys:
            part = part[int(key) if isinstance(part, list) else key]
        if isinstance(part, list):
            part[int(last) : int(last) + 1] = [value]
        else:
            part[last] = value
    return store


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
        self.addCleanup(process.close)
        return process

    def interrupt(self, process):
        """The end of a process that is interrupted: it ends soon, with exit code 3."""
        sent = time.monotonic()
        end = process.end(signal.SIGINT)
        self.assertEqual(end.status, 3, end)
        self.assertLess(time.monotonic() - sent, 30)
        return end

    def interrupted(self, line, part):
        """Interrupts runs, each a little later, until this part is in the output; returns the end of that run."""
        for number in itertools.count():
            process = self.start(line)
            process.wait_for_work(number / 20)
            end = self.interrupt(process)
            if part in end.out:
                return end

    def told(self, *arguments, status=0):
        """Standard output of a run that ends with this exit code and prints no message."""
        end = self.run_here(*arguments)
        self.assertEqual((end.status, end.err), (status, ""), arguments)
        return end.out

    def answer(self, line, status=0):
        """The object that the program prints with --json."""
        return json.loads(self.told(f"{line} --json", status=status))

    def says(self, line, *parts, status=0):
        """Standard output as of `told`, which contains the parts."""
        out = self.told(line, status=status)
        for part in parts:
            self.assertIn(part, out, line)
        return out

    def holds(self, name, *parts):
        """Expects parts in a file."""
        text = self.text(name)
        for part in parts:
            self.assertIn(part, text, name)

    def check_values(self, found, **expected):
        """Expects these values, among others, of an object or of a file that holds it."""
        found = self.json(found) if isinstance(found, str) else found
        self.assertEqual({key: found.get(key) for key in expected}, expected)

    def check_report(self, plan="plan"):
        """`report` makes the same page from the other files. Returns it."""
        page = self.text(f"{plan}/report.html")
        self.told(f"report {plan}")
        self.assertEqual(self.text(f"{plan}/report.html"), page)
        return page

    def signals(self, name, *datasets):
        """Values in the signal file of this name, or of a plan, as lists: its means, or datasets and attributes."""
        import h5py  # which few suites need

        path = self.folder / name
        with h5py.File(path / "signal.h5" if path.is_dir() else path) as file:
            found = [
                (file.attrs[dataset] if dataset in file.attrs else file[dataset][()]).tolist()
                for dataset in datasets or ["mean"]
            ]
        return found if datasets else found[0]

    def refused(self, line, *parts, status=2):
        """Expects one line of error that contains the parts, no other output, and unchanged files."""
        before = contents(self.folder)
        end = self.run_here(line)
        self.assertEqual((end.status, end.out), (status, ""), f"{line}: {end.err}")
        self.assertRegex(end.err, r"\Aerror: [^\n]*\n\Z", line)
        for part in parts:
            self.assertIn(part, end.err, line)
        self.assertEqual(contents(self.folder), before, f"{line}: files changed, appeared or vanished")

    def refused_each(self, *rows, command="", status=2):
        """Expects refusals. A row is the line, or the rest of the command, and parts of the error.

        If a row is only a text, the error must contain its first word.
        """
        for row in rows:
            line, *parts = (row, row.split()[0]) if isinstance(row, str) else row
            line = f"{command} {line}".lstrip()
            with self.subTest(line=line):
                self.refused(line, *parts, status=status)


class ShopTest(ProgramTest):
    """A test in whose folder store.json is the small store."""

    def setUp(self):
        super().setUp()
        self.write("store.json", small_store())


class PreparedTest(ShopTest):
    """A test whose folder begins with the files that `prepare` makes, once for all tests of the class."""

    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.prepared = pathlib.Path(scratch.name) / "prepared"

    def setUp(self):
        super().setUp()
        if self.prepared.exists():
            shutil.copytree(self.prepared, self.folder, dirs_exist_ok=True)
        else:
            self.prepare()
            shutil.copytree(self.folder, self.prepared)
