"""Installs the Python package with pip in a fresh virtual environment, from the build, and uses it there."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).parents[3]


def run(*words, **environment):
    done = subprocess.run(
        [*map(str, words)], capture_output=True, text=True, check=False, env={**os.environ, **environment}
    )
    if done.returncode != 0:
        raise AssertionError(f"{words}: exit code {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


class Installation(unittest.TestCase):
    def test_pip_installs_the_package(self):
        with tempfile.TemporaryDirectory() as folder:
            home = Path(folder)
            run(sys.executable, "-m", "venv", "--system-site-packages", home / "env")
            python = home / "env" / "bin" / "python"
            # A copy, because setuptools writes beside setup.py.
            for name in ("setup.py", "pyproject.toml", "CMakeLists.txt"):
                (home / name).write_bytes((ROOT / name).read_bytes())
            (home / "docs").symlink_to(ROOT / "docs")
            (home / "src").mkdir()
            run("cp", "-r", ROOT / "src" / "python", home / "src")
            build = os.environ["SHELFBEAM_BUILD"]
            run(python, "-m", "pip", "install", "--no-build-isolation", "--no-index", home, SHELFBEAM_BUILD=build)
            script = "import shelfbeam; print(shelfbeam.__file__); print(shelfbeam.place([[2]], requirement=1).ids)"
            file, ids = run(python, "-c", script, PYTHONPATH="").splitlines()
            self.assertTrue(file.startswith(str(home)), file)
            self.assertEqual(ids, "['T1']")


if __name__ == "__main__":
    unittest.main()
