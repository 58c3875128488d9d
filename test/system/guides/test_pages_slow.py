"""Runs all commands of the guides with the program in $SHELFBEAM. A page counts as skipped if other programs that it
uses (Octave, solvers) are not installed; continuous integration has none of them."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import h5py

import guide


class Pages(unittest.TestCase):
    def run_page(self, name, least):
        with tempfile.TemporaryDirectory() as folder:
            ran, missing = guide.run_page(guide.DOCS / name, folder, guide.environment(os.environ["SHELFBEAM"]))
        self.assertGreaterEqual(ran, least)
        if missing:
            self.skipTest(f"{ran} blocks ran; those that need {', '.join(sorted(missing))} did not: not installed")

    def test_tutorial(self):
        self.run_page("tutorial.md", 12)

    def test_research(self):
        self.run_page("research.md", 8)

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
