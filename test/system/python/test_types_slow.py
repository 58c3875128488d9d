"""The types of the Python package, checked by mypy: of its sources, and of the compiled part against its stub."""

import os
import shutil
import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).parents[3]
PACKAGE = ROOT / "src" / "python"
MYPY = shutil.which("mypy", path="/usr/bin")


@unittest.skipUnless(MYPY or os.environ.get("CI"), "mypy is missing")
class Types(unittest.TestCase):
    def test_sources(self):
        cache = Path(os.environ["SHELFBEAM_BUILD"]) / "python" / "mypy"
        words = [
            MYPY,
            "--strict",
            "--config-file",
            str(ROOT / "pyproject.toml"),
            "--cache-dir",
            str(cache),
            "shelfbeam",
        ]
        done = subprocess.run(words, cwd=PACKAGE, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_the_stub_has_the_names_of_the_module(self):
        import shelfbeam._core as core  # noqa: PLC0415

        stub = (PACKAGE / "shelfbeam" / "_core.pyi").read_text(encoding="utf-8")
        names = {}
        for line in stub.splitlines():
            words = line.replace("(", " ").replace(":", " ").split()
            if line.startswith("class "):
                members = names.setdefault(words[1], set())
            elif line.startswith("    def "):
                members.add(words[1])
            elif line.startswith("def "):
                names[words[1]] = None
        public = {name for name in dir(core) if not name.startswith("__")}
        self.assertEqual(public, set(names))
        for name, members in names.items():
            if members is not None:
                own = {one for one in vars(getattr(core, name)) if not one.startswith("_")}
                self.assertEqual(own, members, name)


if __name__ == "__main__":
    unittest.main()
