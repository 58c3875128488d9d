"""Runs the scripts of docs/python, with few samples, and the code of docs/python.md and of its notebook."""

import contextlib
import io
import json
import os
import re
import runpy
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

os.environ.setdefault("MPLBACKEND", "Agg")

import shelfbeam as sb

ROOT = Path(__file__).parents[3]
GALLERY = sorted((ROOT / "docs" / "python").glob("*.py"))


LIMITS = {"samples": 256, "states": 4, "time_limit": 1, "budget": 2}
# The keywords that each function gets with at most these values.
FUNCTIONS = {
    "simulate": ["samples", "states"],
    "impulse_response": ["samples"],
    "place": ["time_limit"],
    "verify": ["budget", "states"],
    "plan": ["budget", "time_limit"],
}


def quickly(function, limited):
    def call(*positional, **keywords):
        for name in limited:
            if name != "states" and "relative_error" not in keywords or name in keywords:
                keywords[name] = min(keywords.get(name, LIMITS[name]), LIMITS[name])
        if "samples" in limited and not {"relative_error", "states"} & set(keywords):
            keywords.setdefault("estimator", "uniform")  # has no radiance cache, which takes seconds
        if function.__name__ == "plan":
            keywords["certificate"] = False
        return function(*positional, **keywords)

    return call


@contextlib.contextmanager
def few_samples():
    with contextlib.ExitStack() as patches:
        for name, limited in FUNCTIONS.items():
            patches.enter_context(mock.patch.object(sb, name, quickly(getattr(sb, name), limited)))
        yield


class Gallery(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_there_are_six_scripts_that_the_page_shows(self):
        self.assertEqual(len(GALLERY), 6)
        page = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
        for script in GALLERY:
            self.assertIn(f"docs/python/{script.name}", page)
            self.assertIn(f"pictures/python/{script.stem}.png", page)

    def test_scripts_write_their_pictures(self):
        for script in GALLERY:
            with self.subTest(script.name), few_samples(), contextlib.redirect_stdout(io.StringIO()) as printed:
                picture = self.folder / f"{script.stem}.png"
                words = [str(script), str(picture), *(["256", "512"] if script.stem == "table_3_1" else [])]
                with mock.patch.object(sys, "argv", words):
                    runpy.run_path(str(script), run_name="__main__")
                self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")
                self.assertTrue(printed.getvalue())

    def run_blocks(self, blocks):
        here = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, here)
        (self.folder / "examples").symlink_to(ROOT / "examples")
        names = {}
        with few_samples(), contextlib.redirect_stdout(io.StringIO()):
            for block in blocks:
                exec(compile(block, "block", "exec"), names)

    def test_the_page_runs(self):
        page = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
        blocks = re.findall(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
        self.assertGreater(len(blocks), 4)
        self.run_blocks(blocks)

    def test_the_notebook_runs(self):
        notebook = json.loads((ROOT / "docs" / "python" / "first_plan.ipynb").read_text(encoding="utf-8"))
        cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
        self.assertGreater(len(cells), 4)
        self.run_blocks(cells)


if __name__ == "__main__":
    unittest.main()
