"""What `cmake --install` leaves is complete: a project of somebody else finds, links and runs it."""

import os
import pathlib
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
        # Nothing may know where it was installed.
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
        build = self.top / "consumer"
        run("cmake", "-S", HERE / "consumer", "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DCMAKE_BUILD_TYPE=Release")
        run("cmake", "--build", build)
        run(self.prefix / "bin/shelfbeam", "new", "thesis", self.top / "shop")
        self.assertRegex(
            run(build / "consumer", self.top / "shop/store.json"),
            r"^390 labels, 320 candidates: \d+ transceivers, at least \d+\n$",
        )

    def test_another_minor_version_is_refused(self):
        (self.top / "future").mkdir()
        (self.top / "future/CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(future LANGUAGES CXX)\nfind_package(shelfbeam 0.99 REQUIRED)\n"
        )
        with self.assertRaisesRegex(AssertionError, "version"):
            run("cmake", "-S", self.top / "future", "-B", self.top / "future/build", f"-DCMAKE_PREFIX_PATH={self.prefix}")


if __name__ == "__main__":
    unittest.main()
