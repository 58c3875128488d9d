"""The types of the Python package, checked by mypy: of its sources, and of the compiled part against its stub."""

import unittest

from harness import BUILD, ROOT, has, output

PACKAGE = ROOT / "src/python"
MYPY = "/usr/bin/mypy"


@unittest.skipUnless(has(MYPY), "mypy is missing")
class Types(unittest.TestCase):
    def test_sources(self):
        options = ["--config-file", ROOT / "pyproject.toml", "--cache-dir", BUILD / "python/mypy"]
        output("--strict", *options, "shelfbeam", program=MYPY, cwd=PACKAGE)

    def test_the_stub_has_the_names_of_the_module(self):
        import shelfbeam._core as core  # noqa: PLC0415

        stub = (PACKAGE / "shelfbeam" / "_core.pyi").read_text(encoding="utf-8")
        names = {}
        for line in stub.splitlines():
            words = line.replace("(", " ").replace(":", " ").split()
            if line.startswith("class "):
                members = names.setdefault(words[1], set())
            elif line.startswith("    def "):
                members.add(words[1])
            elif line.startswith("def "):
                names[words[1]] = None
        public = {name for name in dir(core) if not name.startswith("__")}
        self.assertEqual(public, set(names))
        for name, members in names.items():
            if members is not None:
                own = {one for one in vars(getattr(core, name)) if not one.startswith("_")}
                self.assertEqual(own, members, name)
