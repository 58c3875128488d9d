"""Tests that docs/dependencies.md names every package of the build."""

import json
import re
import unittest

from harness import ROOT


def debian_packages():
    text = (ROOT / "scripts/install-dependencies").read_text(encoding="utf-8")
    return {name for group in re.findall(r"packages\+?=\(([^)]*)\)", text) for name in group.split()}


def npm_packages():
    files = [ROOT / folder / "package.json" for folder in ("src/page", "scripts/style")]
    packages = [json.loads(file.read_text(encoding="utf-8")) for file in files]
    return {name for one in packages for key in ("dependencies", "devDependencies") for name in one.get(key, {})}


class Dependencies(unittest.TestCase):
    def test_are_all_named(self):
        page = (ROOT / "docs/dependencies.md").read_text(encoding="utf-8")
        cells = [line.split("|")[-2] for line in page.splitlines() if "|" in line]
        named = set(re.findall(r"[\w@/+.-]+", " ".join(cells)))
        self.assertGreater(len(debian_packages()), 15)
        self.assertIn("libhighs-dev", debian_packages())
        self.assertEqual((debian_packages() | npm_packages()) - named, set())
