"""A copy of the checkout and of its build, in which a test may change files and build.

The commands see the copy in the place of the checkout, so that the paths of the build are right and only changed files
are compiled.
"""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[3]
BUILD = TOP / "build" / "release"
PAGE = TOP / "CONTRIBUTING.md"


def cannot_run(build):
    """The reason why the copy cannot be built, or None."""
    if build != BUILD:
        return f"needs the build in {BUILD}"
    if subprocess.run([*mounted(TOP), "true"], check=False, capture_output=True).returncode != 0:
        return "needs the right to mount a folder for a process (unshare)"
    return None


def mounted(tree):
    """The begin of a command that runs with `tree` in the place of the checkout."""
    rights = [] if os.geteuid() == 0 else ["--user", "--map-root-user"]
    script = 'mount --bind "$0" "$1" && cd "$1" && shift && exec "$@"'
    return ["unshare", *rights, "--mount", "sh", "-c", script, str(tree), str(TOP)]


class Copy:
    """The copy, in a temporary folder."""

    def __init__(self, programs):
        self.folder = tempfile.TemporaryDirectory()
        self.tree = pathlib.Path(self.folder.name) / "tree"
        # All files keep their times.
        shutil.copytree(TOP, self.tree, symlinks=True, ignore=self.left_out)
        others = [path for path in BUILD.iterdir() if re.match("(test|bench)_", path.name)]
        left_out = {path.name for path in others if path.name not in programs and path.is_file()} | {"Testing"}
        shutil.copytree(
            BUILD, self.tree / "build/release", symlinks=True, ignore=lambda _, names: left_out & set(names)
        )
        if (TOP / "build/style").exists():
            shutil.copytree(TOP / "build/style", self.tree / "build/style")

    @staticmethod
    def left_out(folder, names):
        top = pathlib.Path(folder) == TOP
        return [name for name in names if name == "__pycache__" or (top and re.match(r"build|\.git$|\.cache$", name))]

    def close(self):
        self.folder.cleanup()

    def run(self, command):
        """The exit code of a shell command in the copy, and what it prints."""
        done = subprocess.run(
            [*mounted(self.tree), "bash", "-euc", command],
            check=False,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        return done.returncode, done.stdout

    def apply(self, diff, *options):
        subprocess.run(["git", "apply", *options], input=diff, text=True, cwd=self.tree, check=True)


def blocks(page, heading):
    """(kind, text) of the fenced blocks below a heading."""
    section = re.search(rf"^## {re.escape(heading)}\n(.*?)(?=^## |\Z)", page, re.MULTILINE | re.DOTALL)[1]
    return re.findall(r"^```(\w+)\n(.*?)^```$", section, re.MULTILINE | re.DOTALL)
