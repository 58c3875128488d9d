"""Installs the Python package with pip in a fresh virtual environment, from the build, and uses it there."""

import os
import shutil
import sys

from harness import BUILD, ROOT, ProgramTest, output


class Installation(ProgramTest):
    def test_pip_installs_the_package(self):
        output("-m", "venv", "--system-site-packages", self.folder / "env", program=sys.executable)
        python = self.folder / "env/bin/python"
        # A copy, because setuptools writes beside setup.py.
        for name in ("setup.py", "pyproject.toml", "CMakeLists.txt"):
            shutil.copy(ROOT / name, self.folder)
        (self.folder / "docs").symlink_to(ROOT / "docs")
        shutil.copytree(ROOT / "src/python", self.folder / "src/python")
        options = ["--no-build-isolation", "--no-index"]
        environment = {**os.environ, "SHELFBEAM_BUILD": str(BUILD), "PYTHONPATH": ""}
        output("-m", "pip", "install", *options, self.folder, program=python, env=environment)
        script = "import shelfbeam; print(shelfbeam.__file__); print(shelfbeam.place([[2]], requirement=1).ids)"
        file, ids = output("-c", script, program=python, env=environment).splitlines()
        self.assertTrue(file.startswith(str(self.folder)), file)
        self.assertEqual(ids, "['T1']")
