"""Runs the program and keeps its files, from which a second run continues."""

import json
import re
import subprocess
import sys
import time
from pathlib import Path


class Failure(Exception):
    """An error that the user can correct."""


def say(text):
    print(f"reproduce: {text}", file=sys.stderr, flush=True)


class Program:
    """The shelfbeam binary with a folder for its output files.

    A file is written again only if it is missing, older than its inputs, or was written with other arguments, which
    are kept beside it. The program is an input of all files but simulations, because solvers change.
    """

    def __init__(self, binary, folder):
        self.binary = str(binary)
        self.folder = Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.runs = 0

    def has_option(self, verb, option):
        shown = subprocess.run([self.binary, verb, "--help"], capture_output=True, text=True, check=True).stdout
        return re.search(rf"(^|[\s,]){re.escape(option)}\b", shown) is not None

    def version(self):
        return subprocess.run([self.binary, "--version"], capture_output=True, text=True, check=True).stdout.strip()

    def run(self, name, arguments, inputs=(), accepted=(0,)):
        """Writes the file `name` of the folder (with `-o`) and returns its path.

        With `--json` among the arguments, the printed output is kept in NAME.json. `accepted` are the exit codes that
        count as success: 1 is infeasible, 3 is a run that a time limit ended.
        """
        output = self.folder / name
        command = [self.binary, *map(str, arguments), "-o", str(output), "--quiet"]
        record = self.folder / f"{name}.run"
        if arguments[0] != "simulate":
            inputs = [*inputs, self.binary]
        if self._is_current(output, record, command, inputs):
            return output
        say(f"{arguments[0]} {name}")
        begun = time.monotonic()
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode not in accepted:
            raise Failure(f"{' '.join(command)}\nexited with {done.returncode}: {done.stderr.strip()}")
        self.runs += 1
        if "--json" in arguments:
            write_text(self.folder / f"{name}.json", done.stdout)
        write_text(
            record,
            json.dumps({"command": command[1:], "exit_code": done.returncode, "seconds": time.monotonic() - begun}),
        )
        return output

    def record(self, name):
        """Exit code and wall time (s) of the run that wrote a file."""
        with open(self.folder / f"{name}.run", encoding="utf-8") as file:
            return json.load(file)

    @staticmethod
    def _is_current(output, record, command, inputs):
        if not output.exists() or not record.exists():
            return False
        written = record.stat().st_mtime
        if any(Path(path).stat().st_mtime > written for path in inputs):
            return False
        return json.loads(record.read_text(encoding="utf-8"))["command"] == command[1:]


def write_text(path, text):
    """Writes a file atomically."""
    path = Path(path)
    new = path.with_name(path.name + ".new")
    new.write_text(text, encoding="utf-8")
    new.replace(path)
