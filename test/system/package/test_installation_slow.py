"""Tests that an installation is complete: an external project finds, links and runs the library."""

import pathlib
import re
import tempfile

from harness import BUILD, ROOT, ProgramTest, output


def cmake(*arguments):
    return output(*arguments, program="cmake")


class Installation(ProgramTest):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        top = pathlib.Path(scratch.name)
        cmake("--install", BUILD, "--prefix", top / "first")
        # The installation must be relocatable.
        cls.prefix = (top / "first").rename(top / "moved")
        cls.program = cls.prefix / "bin/shelfbeam"

    def test_program_runs(self):
        self.assertRegex(output("--version", program=self.program), r"^\d+\.\d+\.\d+\n$")
        output("new", "thesis", self.folder / "store", program=self.program)
        self.assertIn("320", output("inspect", self.folder / "store/store.json", program=self.program))

    def test_another_project_links_the_library(self):
        """Builds the project of docs/api.md."""
        page = self.text(ROOT / "docs/api.md")
        lists, source = (re.search(rf"```{kind}\n(.*?)```", page, re.DOTALL)[1] for kind in ("cmake", "cpp"))
        self.write("project/main.cpp", source)
        head = "cmake_minimum_required(VERSION 3.25)\nproject(my_program LANGUAGES CXX)\n"
        self.write("project/CMakeLists.txt", f"{head}add_executable(my_program main.cpp)\n{lists}")
        build, shop = self.folder / "build", self.folder / "shop"
        options = [f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DCMAKE_BUILD_TYPE=Release"]
        cmake("-S", self.folder / "project", "-B", build, *options)
        cmake("--build", build)
        output("new", "thesis", shop, program=self.program)
        program = build / "my_program"
        told = output(shop / "store.json", shop, program=program)
        self.assertRegex(told, r"^390 labels, 320 candidates: \d+ transceivers\n$")
        self.assertIn("</html>", self.text("shop/report.html"))
        tiny = self.json(ROOT / "test/data/field/batch/tiny.json")
        changing = self.write("changing.json", {**tiny, "variation": {"unit_power_db": 0.2}})
        self.assertRegex(output(changing, shop, program=program), r"transceivers\ncertified in random states: yes\n$")

    def test_headers_include_only_installed_headers(self):
        include = self.prefix / "include"
        headers = sorted(include.rglob("*.hpp"))
        self.assertIn(include / "shelfbeam/shelfbeam.hpp", headers)
        self.assertTrue(25 <= len(headers) <= 60, len(headers))
        # In both orders, most headers that lack an include of their own fail, too.
        for order in (headers, headers[::-1]):
            source = self.write("headers.cpp", "".join(f'#include "{header}"\n' for header in order))
            options = "-std=c++20 -Wall -Wextra -Werror -fsyntax-only -I".split()
            output(*options, include, source, program="c++")

    def test_another_minor_version_is_refused(self):
        head = "cmake_minimum_required(VERSION 3.25)\nproject(new LANGUAGES CXX)\n"
        self.write("future/CMakeLists.txt", f"{head}find_package(shelfbeam 0.99 REQUIRED)\n")
        with self.assertRaisesRegex(RuntimeError, "version"):
            cmake("-S", self.folder / "future", "-B", self.folder / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}")
