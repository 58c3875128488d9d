"""Runs all commands of the guides with the program in $SHELFBEAM. A page counts as skipped if other programs that it
uses (Octave, solvers) are not installed; continuous integration has none of them. The pages of docs/howto continue the
tutorial, each in a copy of its folder."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import h5py

import guide


def run_page(page, folder):
    return guide.run_page(page, folder, guide.environment(os.environ["SHELFBEAM"]))


class Pages(unittest.TestCase):
    def test_tutorial_and_tasks(self):
        with tempfile.TemporaryDirectory() as folder:
            finished = pathlib.Path(folder) / "tutorial"
            finished.mkdir()
            ran, missing = run_page(guide.DOCS / "tutorial.md", finished)
            self.assertGreaterEqual(ran, 7)
            self.assertEqual(missing, set())
            tasks = sorted((guide.DOCS / "howto").glob("*.md"))
            self.assertGreaterEqual(len(tasks), 9)
            for page in tasks:
                with self.subTest(page=page.name):
                    ran, missing = run_page(page, shutil.copytree(finished, pathlib.Path(folder) / page.stem))
                    self.assertGreaterEqual(ran, 1)
                    self.assertEqual(missing, set())

    def test_planner(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(run_page(guide.DOCS / "planner.md", folder), (3, set()))

    def test_research(self):
        with tempfile.TemporaryDirectory() as folder:
            ran, missing = run_page(guide.DOCS / "research.md", folder)
        self.assertGreaterEqual(ran, 8)
        if missing:
            self.skipTest(f"{ran} blocks ran; not installed for the others: {', '.join(sorted(missing))}")

    def test_octave_can_read_texts(self):
        """Octave cannot read texts that are marked as UTF-8, so only texts that need it are marked."""
        text = (guide.DOCS.parent / "test/data/room_s1/store.json").read_text(encoding="utf-8")
        store = json.loads(text[text.index("{") :])  # without its comment
        store["labels"] = [{**store["labels"][0], "id": "Größe"}]
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "store.json").write_text(json.dumps(store), encoding="utf-8")
            command = [os.environ["SHELFBEAM"], "simulate", "store.json", "-o", "signal.h5", "--samples", "64"]
            subprocess.run([*command, "--quiet"], cwd=folder, check=True)
            with h5py.File(pathlib.Path(folder) / "signal.h5") as file:

                def encoding(name):
                    return h5py.check_string_dtype(file[name].dtype).encoding

                self.assertEqual(encoding("labels/id"), "utf-8")
                self.assertEqual(file["labels/id"].asstr()[0], "Größe")
                self.assertEqual(encoding("labels/type"), "ascii")
                self.assertEqual(encoding("transceivers/id"), "ascii")


if __name__ == "__main__":
    unittest.main()
