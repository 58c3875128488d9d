"""README.md, CONTRIBUTING.md and the glossary name paths and identifiers that exist."""

import re
import unittest

from harness import ROOT

LIBRARY = ROOT / "src/shelfbeam"


def unknown_identifiers(page):
    """Those in the last cells of a table that no source of the library has outside comments."""
    words = set()
    for path in LIBRARY.rglob("*"):
        if path.is_file():
            words.update(re.findall(r"[A-Za-z_]\w*", re.sub("//.*", "", path.read_text(encoding="utf-8")), re.ASCII))
    cells = re.findall(r"`([A-Za-z_:]+)` \|\n", page)
    return [name for cell in cells for name in re.findall("[A-Za-z_]+", cell) if name not in words]


class Documents(unittest.TestCase):
    def test_paths_exist(self):
        """Quoted or linked paths are relative to the top or to the library."""
        for page in ("README.md", "CONTRIBUTING.md"):
            paths = re.findall(r"[`(]([a-z][a-z_/]+/[a-z_-]+\.[a-z]+)[`)]", (ROOT / page).read_text(encoding="utf-8"))
            self.assertTrue(paths, page)
            for path in paths:
                self.assertTrue((ROOT / path).exists() or (LIBRARY / path).exists(), f"{page}: {path}")

    def test_the_readme_is_short(self):
        self.assertLessEqual((ROOT / "README.md").read_text(encoding="utf-8").count("\n"), 90)

    def test_identifiers_of_the_glossary_exist(self):
        glossary = (ROOT / "docs/glossary.md").read_text(encoding="utf-8")
        self.assertEqual(unknown_identifiers(f"{glossary}| a | `Scene::no_such_member` |\n"), ["no_such_member"])
