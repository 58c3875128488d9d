"""Tests that docs/dependencies.md names every package of the build."""

import json
import pathlib
import re
import unittest

TOP = pathlib.Path(__file__).parents[3]


def debian_packages():
    text = (TOP / "scripts/install-dependencies").read_text(encoding="utf-8")
    return {name for group in re.findall(r"packages\+?=\(([^)]*)\)", text) for name in group.split()}


def npm_packages():
    packages = [
        json.loads((TOP / folder / "package.json").read_text(encoding="utf-8"))
        for folder in ("src/page", "scripts/style")
    ]
    return {
        name for package in packages for key in ("dependencies", "devDependencies") for name in package.get(key, {})
    }


class Dependencies(unittest.TestCase):
    def test_are_all_named(self):
        page = (TOP / "docs/dependencies.md").read_text(encoding="utf-8")
        named = set(
            re.findall(r"[\w@/+.-]+", " ".join(line.split("|")[-2] for line in page.splitlines() if "|" in line))
        )
        self.assertGreater(len(debian_packages()), 15)
        self.assertIn("libhighs-dev", debian_packages())
        self.assertEqual((debian_packages() | npm_packages()) - named, set())


if __name__ == "__main__":
    unittest.main()
