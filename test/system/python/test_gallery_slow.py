"""Runs the scripts of docs/python, with few samples, and the code of docs/python.md and of its notebook."""

import contextlib
import io
import os
import re
import runpy
import sys
from unittest import mock

os.environ.setdefault("MPLBACKEND", "Agg")

import shelfbeam as sb
from harness import ROOT, ProgramTest

GALLERY = sorted((ROOT / "docs/python").glob("*.py"))

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


class Gallery(ProgramTest):
    def test_there_are_six_scripts_that_the_page_shows(self):
        self.assertEqual(len(GALLERY), 6)
        page = self.text(ROOT / "docs/python.md")
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
        blocks = re.findall(r"^```python\n(.*?)^```", self.text(ROOT / "docs/python.md"), re.MULTILINE | re.DOTALL)
        self.assertGreater(len(blocks), 4)
        self.run_blocks(blocks)

    def test_the_notebook_runs(self):
        notebook = self.json(ROOT / "docs/python/first_plan.ipynb")
        cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
        self.assertGreater(len(cells), 4)
        self.run_blocks(cells)
