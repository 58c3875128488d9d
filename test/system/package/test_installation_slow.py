"""Tests that an installation is complete: an external project finds, links and runs the library."""

import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

BUILD = pathlib.Path(os.environ["SHELFBEAM_BUILD"])
HERE = pathlib.Path(__file__).parent


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{command}: exit code {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


class Installation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        top = pathlib.Path(cls.folder.name)
        run("cmake", "--install", BUILD, "--prefix", top / "first")
        # The installation must be relocatable.
        cls.prefix = (top / "first").rename(top / "moved")
        cls.top = top

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_program_runs(self):
        program = self.prefix / "bin/shelfbeam"
        self.assertRegex(run(program, "--version"), r"^\d+\.\d+\.\d+\n$")
        run(program, "new", "thesis", self.top / "store")
        self.assertIn("320", run(program, "inspect", self.top / "store/store.json"))

    def test_another_project_links_the_library(self):
        """Builds the project of docs/api.md."""
        page = (HERE.parents[2] / "docs/api.md").read_text(encoding="utf-8")
        lists, program = (re.search(rf"```{kind}\n(.*?)```", page, re.DOTALL)[1] for kind in ("cmake", "cpp"))
        project, build = self.top / "project", self.top / "build"
        project.mkdir()
        (project / "main.cpp").write_text(program, encoding="utf-8")
        (project / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(my_program LANGUAGES CXX)\n"
            "add_executable(my_program main.cpp)\n" + lists
        )
        run("cmake", "-S", project, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DCMAKE_BUILD_TYPE=Release")
        run("cmake", "--build", build)
        shop = self.top / "shop"
        run(self.prefix / "bin/shelfbeam", "new", "thesis", shop)
        self.assertRegex(
            run(build / "my_program", shop / "store.json", shop), r"^390 labels, 320 candidates: \d+ transceivers\n$"
        )
        self.assertIn("</html>", (shop / "report.html").read_text(encoding="utf-8"))
        tiny = json.loads((HERE.parents[2] / "test/data/field/batch/tiny.json").read_text(encoding="utf-8"))
        changing = self.top / "changing.json"
        changing.write_text(json.dumps({**tiny, "variation": {"unit_power_db": 0.2}}), encoding="utf-8")
        self.assertRegex(run(build / "my_program", changing, shop), r"transceivers\ncertified in random states: yes\n$")

    def test_headers_include_only_installed_headers(self):
        include = self.prefix / "include"
        headers = sorted(include.rglob("*.hpp"))
        self.assertIn(include / "shelfbeam/shelfbeam.hpp", headers)
        self.assertTrue(25 <= len(headers) <= 60, len(headers))
        # In both orders, most headers that lack an include of their own fail, too.
        for order in (headers, headers[::-1]):
            source = self.top / "headers.cpp"
            source.write_text("".join(f'#include "{header}"\n' for header in order))
            run("c++", "-std=c++20", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-I", include, source)

    def test_another_minor_version_is_refused(self):
        (self.top / "future").mkdir()
        (self.top / "future/CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(new LANGUAGES CXX)\nfind_package(shelfbeam 0.99 REQUIRED)\n"
        )
        with self.assertRaisesRegex(AssertionError, "version"):
            run(
                "cmake",
                "-S",
                self.top / "future",
                "-B",
                self.top / "future/build",
                f"-DCMAKE_PREFIX_PATH={self.prefix}",
            )


if __name__ == "__main__":
    unittest.main()
