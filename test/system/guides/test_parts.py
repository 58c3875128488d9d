"""Tests the checks of guide.py."""

import json
import os
import re
import runpy
import unittest

import guide
from harness import ProgramTest, output


class RunPage(ProgramTest):
    def run_page(self, page):
        return guide.run_page(self.write("page.md", page), self.folder, dict(os.environ))

    def expect_wrong(self, page, *parts):
        with self.assertRaises(guide.Wrong) as caught:
            self.run_page(page)
        for part in parts:
            self.assertIn(part, str(caught.exception))

    def test_blocks_run_in_order_in_one_folder(self):
        page = (
            "# A\n```sh\necho 7 > file\n```\nText\n```python\nprint(open('file').read(), 'and more')\n```\n"
            "```text\n...\n7\nand...more\n```\n"
        )
        self.assertEqual(self.run_page(page), (2, set()))

    def test_a_wrong_command_is_noticed(self):
        self.expect_wrong("one\n\n```sh\nls nothing\necho fine\n```\n", "page.md:3", "ls nothing")
        self.expect_wrong("```sh\nfalse | cat\n```\n", "exit code 1")
        self.expect_wrong("```python\nraise ValueError('no')\n```\n", "ValueError")

    def test_a_wrong_exit_code_is_noticed(self):
        self.assertEqual(self.run_page("```sh\nexit 3 # exit code 3\n```\n"), (1, set()))
        self.expect_wrong("```sh\nexit 2 # exit code 3\n```\n", "exit code 2")
        self.expect_wrong("```sh\ntrue # exit code 3\n```\n", "exit code 0")

    def test_a_line_that_is_not_there_is_noticed(self):
        self.expect_wrong("```sh\necho 3 units\n```\n```text\n4 units\n```\n", "page.md:4", "'4 units'")
        self.expect_wrong("```sh\necho a; echo b\n```\n```text\nb\na\n```\n", "'a'")
        self.expect_wrong("```sh\necho a b\n```\n```text\na...c\n```\n", "'a...c'")
        self.expect_wrong("```sh\necho a and more\n```\n```text\na\n```\n", "'a'")

    def test_every_block_is_of_a_kind_that_is_run(self):
        self.expect_wrong("```bash\ntrue\n```\n", "'bash'")
        self.expect_wrong("```sh sudo\ntrue\n```\n", "'sh sudo'")

    SERVER = """```python
open("server.py", "w").write('''
from http.server import HTTPServer, SimpleHTTPRequestHandler
server = HTTPServer(("127.0.0.1", 0), SimpleHTTPRequestHandler)
print(f"http://127.0.0.1:{server.server_port}/", flush=True)
try:
    server.serve_forever()
except KeyboardInterrupt:
    print("ended")
''')
open("index.html", "w").write("<!doctype html>")
```
```sh serves
python3 server.py
```
```text
http://...
ended
```
"""

    def test_a_server_is_interrupted_once_its_page_has_arrived(self):
        self.assertEqual(self.run_page(self.SERVER), (2, set()))
        self.expect_wrong(self.SERVER.replace("<!doctype html>", "words"), "no page was served")
        self.expect_wrong(self.SERVER.replace("ended\n```", "more\n```"), "'more'")
        self.expect_wrong("```sh serves\necho nothing\n```\n", "no page was served")
        self.expect_wrong("```python serves\n1\n```\n", "'python serves'")

    def test_what_is_missing_is_told(self):
        page = "```sh needs=no-such-solver\nno-such-solver\n```\n```text\noptimal\n```\n"
        self.assertEqual(self.run_page(page), (0, {"no-such-solver"}))

    def test_named_options_exist(self):
        def helped(verb=""):
            return output(f"{verb} --help")

        verbs = re.findall(r"^  ([a-z]+) ", helped().split("Verbs:")[1], re.MULTILINE)
        known = set(re.findall(r"--[a-z-]+", "".join(map(helped, verbs))))
        names = ("../README.md", "command_line.md", "tutorial.md", "planner.md", "research.md", "cluster.md")
        guides = [guide.DOCS / name for name in names]
        for page in [*guides, *guide.DOCS.glob("howto/*.md"), *guide.DOCS.glob("formats/**/*.md")]:
            for option in guide.named_options(page.read_text(encoding="utf-8")):
                self.assertIn(option, known, page.name)
        page = "`--samples N` and `shelfbeam plan a --curve`, not `scripts/test --all`\n```sh\n`--x`\n```\n"
        self.assertEqual(list(guide.named_options(page)), ["--samples", "--curve"])

    def test_links_lead_somewhere(self):
        pages = [*guide.DOCS.parent.glob("*.md"), *guide.DOCS.rglob("*.md")]
        for page in pages:
            for target, anchor in guide.links(page):
                self.assertTrue(target.exists(), f"{page.name}: {target}")
                if anchor:
                    self.assertIn(anchor, guide.anchors(target.read_text(encoding="utf-8")), f"{page.name}: {target}")
        self.assertGreaterEqual(len(list(guide.links(guide.DOCS / "tutorial.md"))), 5)

    def test_sources_name_pages_and_sections_that_exist(self):
        named = set()
        for folder in ("src", "test", "bench", "study", "scripts"):
            for file in (guide.DOCS.parent / folder).rglob("*.[chpt]*"):
                if file.suffix in (".cpp", ".hpp", ".py", ".ts") and "node_modules" not in file.parts:
                    text = file.read_text(encoding="utf-8")
                    named.update(re.findall(r'(?<![/\w])(docs/[\w/]+\.md)(?:, "([^"]+)")?', text))
        self.assertGreaterEqual(len(named), 20)
        self.assertGreaterEqual(sum(bool(section) for _, section in named), 4)
        for page, section in named:
            text = (guide.DOCS.parent / page).read_text(encoding="utf-8")
            self.assertRegex(text, rf"(?m)^#+ {re.escape(section)}", f"{page}, {section}")

    def test_anchors_are_those_of_headings(self):
        page = "# A `key`: its use\n```sh\n# no heading\n```\n## [Link](a.md), a_b\n## Again\n### Again\n# Again\n"
        self.assertEqual(guide.anchors(page), ["a-key-its-use", "link-a_b", "again", "again-1", "again-2"])

    def test_every_page_can_be_found(self):
        """Links lead from README to every page, and from the index of the store file to its pages and back."""
        found, left = set(), [guide.DOCS.parent / "README.md"]
        while left:
            page = left.pop()
            if page not in found and page.suffix == ".md":
                found.add(page)
                left.extend(target for target, _ in guide.links(page))
        self.assertEqual(set(guide.DOCS.rglob("*.md")) - found, set())
        index = guide.DOCS / "formats/store.md"
        parts = set(guide.DOCS.glob("formats/store/*.md"))
        self.assertGreaterEqual(len(parts), 8)
        self.assertEqual(parts - {target for target, _ in guide.links(index)}, set())
        for page in parts:
            self.assertIn((index, ""), guide.links(page), page.name)


class Keys(unittest.TestCase):
    def test_of_the_planner_are_all_in_its_page(self):
        actions = guide.DOCS.parent / "src/page/planner/actions/command_list.ts"
        text = actions.read_text(encoding="utf-8")
        lists = re.findall(r"\bcommand\(\s*\S+,\s*[^,\[\]]+,\s*\[(.*?)\]", text)
        known = {key for keys in lists for key in re.findall(r'"([^"]+)"', keys)}
        units = (actions.parent.parent / "units/commands.ts").read_text(encoding="utf-8")
        marks = re.search(r"const keys: Record<Mark, string> = \{(.*?)\}", units).group(1)
        known |= set(re.findall(r'"([^"]+)"', marks))
        drawing = text.split("const drawKeys")[1].split("};")[0]
        known |= set(re.findall(r'"([^"]+)"', drawing.split("= {")[1]))
        self.assertGreaterEqual(len(known), 38)
        self.assertIn("[String(k + 1)]", text)
        self.assertIn("held + key", lists)
        self.assertIn('commands("move", "Shift+")', text)
        known |= {shift + arrow for arrow in "←→↑↓" for shift in ("", "Shift+")} | {"1", "9"}
        section = (guide.DOCS / "planner.md").read_text(encoding="utf-8").split("\n## Keys\n")[1].split("\n## ")[0]
        rows = re.findall(r"^\| (`.*?) \| (.*) \|$", section, re.MULTILINE)
        named = [key for row in rows for column in row for key in re.findall(r"`([^`]+)`", column)]
        self.assertEqual(set(named), known)


class Catalogue(unittest.TestCase):
    """The table of presets in the page of the planner."""

    @staticmethod
    def presets():
        text = (guide.DOCS.parent / "data/catalogue.json").read_text(encoding="utf-8")
        text = re.sub(r'("[^"]*")|//.*', lambda match: match[1] or "", text)
        given = json.loads(text)["presets"]

        def completed(name):
            keys = given[name]
            return {**completed(keys["preset"]), **keys} if "preset" in keys else keys

        return {name: completed(name) for name in given}

    def test_rows_are_those_of_the_file(self):
        page = (guide.DOCS / "planner.md").read_text(encoding="utf-8")
        section = page.split("\n## The catalogue of a new shop\n")[1].split("\n## ")[0]
        rows = re.findall(r"^\| `(.*?)` \| (\d+)" + r" \| (.*?)" * 3 + r" \| ", section, re.MULTILINE)
        left = self.presets()
        for kind, number, *sizes in rows:
            found = [left.pop(name) for name in list(left) if name.startswith(f"{kind} ")]
            self.assertEqual(len(found), int(number), kind)
            each = [keys.get("size") or [keys[key] for key in ("length", "depth", "height")] for keys in found]
            for size, values in zip(sizes, zip(*each)):
                ends = [f"{end:.2f}" for end in (min(values), max(values))]
                self.assertEqual(size.split(" to "), ends[: len(set(ends))], kind)
        self.assertEqual(left, {})


def floors(page):
    """The layers on each floor of the drawing in a page, top first."""
    rows = re.findall(r"│(.*)│", page)
    return [found for row in rows if (found := re.findall(r"[a-z]+", row))]


def upward(levels, needs):
    """The pairs of layers of which the first needs the second, which is not on a lower floor."""
    floor = {layer: number for number, layers in enumerate(levels) for layer in layers}
    pairs = {(room.split("/")[0], needed.split("/")[0]) for room, rooms in needs.items() for needed in rooms}
    return [pair for pair in sorted(pairs) if pair[0] != pair[1] and floor[pair[0]] >= floor[pair[1]]]


def missing_names(page, source):
    """The names in rows "| ... | `names` | `file` |" that do not occur in the file, and the number of rows."""
    rows = re.findall(r"\| (`[^|]*`) \| `([^`|]*)` \|$", page, re.MULTILINE)
    return len(rows), [
        f"{file}: {name}"
        for code, file in rows
        for name in re.findall(r"\w+", code)
        if not re.search(rf"\b{name}\b", (source / file).read_text(encoding="utf-8"))
    ]


class Architecture(unittest.TestCase):
    TOP = guide.DOCS.parent
    SOURCE = TOP / "src/shelfbeam"
    PAGE = (guide.DOCS / "architecture.md").read_text(encoding="utf-8")

    def test_layers_include_only_lower_floors(self):
        needs = runpy.run_path(str(self.TOP / "scripts/check/layers"))["NEEDS"]
        needs = {room: needed for room, needed in needs.items() if room not in ("version", "shelfbeam")}
        needs["base"] = []
        needs["jobs"] = ["report", "inspection"]
        needs["serve"] = ["jobs"]
        needs["app"] = ["serve"]
        levels = floors(self.PAGE)
        self.assertEqual(sorted(sum(levels, [])), sorted({room.split("/")[0] for room in needs}))
        self.assertEqual(upward(levels, needs), [])
        self.assertEqual(upward([["a", "b"], ["c"]], {"a": ["b"], "b": ["c"], "c": ["a"]}), [("a", "b"), ("c", "a")])

    def test_names_occur_in_their_files(self):
        section = self.PAGE.split("\n## One edit")[1].split("\n## ")[0]
        self.assertEqual(missing_names(section, self.TOP), (10, []))
        self.assertEqual(missing_names(self.PAGE.replace(section, ""), self.SOURCE), (12, []))
        for name, file in re.findall(r"`(\w+)` in `(src/[^`]+)`", self.PAGE):
            self.assertRegex((self.TOP / file).read_text(encoding="utf-8"), rf"\b{name}\b")
        row = "| 1 | a | `place`, `Placement::nothing` | `placement/place.cpp` |\n"
        self.assertEqual(missing_names(row, self.SOURCE), (1, ["placement/place.cpp: nothing"]))

    def test_names_occur_in_their_headers(self):
        rows = re.findall(r"^\| `([^`]+\.hpp)` \| (.*) \|$", self.PAGE, re.MULTILINE)
        self.assertEqual(len(rows), 6)
        for header, content in rows:
            text = (self.SOURCE / header).read_text(encoding="utf-8")
            for name in re.findall(r"`(\w+)`", content):
                self.assertRegex(text, rf"\b{name}\b", header)
            self.assertIn("`", content)

    def test_paths_and_layers_exist(self):
        paths = re.findall(r"`((?:\w+/)+[\w.-]*)`", self.PAGE)
        self.assertGreaterEqual(len(paths), 25)
        for path in paths:
            self.assertTrue((self.TOP / path).exists() or (self.SOURCE / path).exists(), path)
        described = re.findall(r"^- \*\*(.*?)\*\*", self.PAGE, re.MULTILINE)
        layers = set(sum(floors(self.PAGE), [])) - {"app", "jobs", "serve"}
        self.assertEqual(sorted(", ".join(described).split(", ")), sorted(layers))
