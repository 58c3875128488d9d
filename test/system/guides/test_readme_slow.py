"""Runs the commands of README.md and of the page on the command line, and compares the pictures of the documentation
with new ones."""

import importlib.machinery
import importlib.util
import os
import pathlib
import re
import shutil
import tempfile
import unittest

import guide
import numpy
from harness import PROGRAM, ProgramTest

if "CI" not in os.environ and importlib.util.find_spec("PIL") is None:
    raise unittest.SkipTest("the package python3-pil is missing")

TOP = guide.DOCS.parent
loader = importlib.machinery.SourceFileLoader("make_pictures", str(TOP / "scripts/make-pictures"))
make_pictures = importlib.util.module_from_spec(importlib.util.spec_from_loader("make_pictures", loader))
loader.exec_module(make_pictures)


def run_page(path, folder):
    """Runs all commands of a page but the scripts, which other tests run."""
    page = re.sub(r"^scripts/.*\n", "", path.read_text(encoding="utf-8"), flags=re.MULTILINE)
    copy = pathlib.Path(folder) / path.name
    copy.write_text(page.replace("build/release/shelfbeam", "shelfbeam"), encoding="utf-8")
    return guide.run_page(copy, folder, guide.environment(PROGRAM))


def cells(picture, rows=40, columns=48):
    """The mean colours of the cells of a grid."""
    y, x = (numpy.linspace(0, size, count + 1).astype(int) for size, count in zip(picture.shape, (rows, columns)))
    sums = numpy.pad(picture.astype(float).cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0), (0, 0)))[y][:, x]
    sums = numpy.diff(numpy.diff(sums, axis=0), axis=1)
    return sums / numpy.outer(numpy.diff(y), numpy.diff(x))[..., None]


def is_like(one, other):
    """Whether two pictures have the same size, and few cells of different colours: other fonts or anti-aliasing change
    few cells by more than 8 of 255."""
    if one.shape != other.shape:
        return False
    return (numpy.abs(cells(one) - cells(other)).max(axis=2) > 8).mean() <= 0.03


class Readme(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        work = tempfile.TemporaryDirectory()
        cls.addClassCleanup(work.cleanup)
        run_page(TOP / "README.md", work.name)
        cls.plan = pathlib.Path(work.name) / "my-store/plan"

    def kept(self, name):
        png = (TOP / "docs/pictures" / name).read_bytes()
        self.assertLess(len(png), 150_000, name)
        return make_pictures.pixels(png)

    def setUp(self):
        if "CI" not in os.environ and not all(map(shutil.which, ("chromium", "node", "pdftoppm"))):
            self.skipTest("chromium, node or pdftoppm is missing")

    def test_pictures_are_those_of_the_program(self):
        for name, picture in make_pictures.PICTURES.items():
            kept, made = self.kept(name), make_pictures.pixels(picture(self.plan))
            self.assertTrue(is_like(kept, made), name)
            self.assertFalse(is_like(kept, made[:, ::-1]), name)
            self.assertFalse(is_like(kept, made[1:]), name)

    def test_another_level_is_noticed(self):
        level = make_pictures.LEVEL.replace("(2)", "(3)")
        self.assertNotEqual(level, make_pictures.LEVEL)
        made = make_pictures.screenshot(self.plan, level, *make_pictures.LEVEL_SIZE)
        self.assertFalse(is_like(self.kept("floor-plan.png"), make_pictures.pixels(made)))

    def test_missing_paths_are_noticed(self):
        address = f"#view=1&camera={make_pictures.CAMERA}"
        made = make_pictures.screenshot(self.plan, make_pictures.VIEW, *make_pictures.VIEW_SIZE, address)
        self.assertFalse(is_like(self.kept("view.png"), make_pictures.pixels(made)))


class CommandLine(ProgramTest):
    def test_commands_run(self):
        self.assertEqual(run_page(guide.DOCS / "command_line.md", self.folder)[0], 1)
        self.assertTrue((self.folder / "model.mps").exists())
