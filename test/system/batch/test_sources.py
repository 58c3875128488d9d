"""Lists and folders of stores with odd names, links and files: each store has its own result."""

import json
import os
import unittest

import chain
from chain import QUICK, TINY

NOBODY = 65534


class Sources(chain.BatchTest):
    def expect(self, statuses, source="t", options=QUICK, **process):
        """Plans the stores of a source, and compares the results; returns the end of the batch."""
        end = self.batch(options, int("failed" in statuses.values()), source, **process)
        self.assertEqual(self.statuses(), statuses)
        return end

    def test_odd_names(self):
        names = {
            b"-dash": "-dash",
            b"new\nline": "new\\nline",
            b"\xff": "\\xff",
            b"\\xff": "\\xff~2",
            b"A": "A",
            b"a": "a",
            "caf\u00e9".encode(): "caf\u00e9",
            "cafe\u0301".encode(): "cafe\u0301",
            b"n" * 255: "n" * 255,
            b"quo\"te's": "quo\"te's",
            b"up": "up",
            b"up/report.html": "up/report.html",
            b"r": "r",
            b"r.json/y": "r.json/y",
            b"r.json_/y": "r.json_/y",
            b"/".join([b"d" * 200] * 18): "/".join(["d" * 200] * 18),
        }
        for name in names:
            self.add_shop(os.fsdecode(name))
        self.expect(dict.fromkeys(names.values(), "planned"))
        pages = [self.results / row["report"] for row in chain.rows(self.results)]
        self.assertEqual(len(set(pages)), len(names))
        for page in pages:
            self.assertTrue(page.exists(), page)
        before = chain.contents(self.results)
        self.batch(f"--resume {QUICK}")  # finds all records
        self.assertEqual(chain.contents(self.results), before)

    def test_links_and_other_files(self):
        self.add_shop("a")
        self.add_shop(self.folder / "outside/shop")
        for name, target in (("to-shop", "../outside/shop"), ("to-shops", "../outside"), ("up", "..")):
            (self.shops / name).symlink_to(target)
        for name, target in (("same", "../a/store.json"), ("dangling", "nowhere"), ("loop", "store.json")):
            (self.shops / name).mkdir()
            (self.shops / name / "store.json").symlink_to(target)
        (self.shops / "pipe").mkdir()
        os.mkfifo(self.shops / "pipe/store.json")
        expected = {
            **dict.fromkeys(("a", "same", "to-shop"), "planned"),
            **dict.fromkeys(("dangling", "loop", "pipe"), "failed"),
        }
        self.expect(expected)
        # Results of another batch are not stores, even of plans that were interrupted.
        os.rename(self.results, self.shops / "earlier")
        (self.shops / "earlier/plans/a/placement.json").unlink()
        self.expect(expected)

    @unittest.skipUnless(os.geteuid() == 0, "only root can run the program as another user")
    def test_folders_that_cannot_be_read(self):
        for name in ("a", "closed/in", "listed/in"):
            self.add_shop(name)
        self.folder.chmod(0o777)
        (self.shops / "closed").chmod(0o311)
        (self.shops / "listed").chmod(0o644)
        statuses = {"a": "planned", "closed": "failed", "listed/in": "failed"}
        end = self.expect(statuses, user=NOBODY, group=NOBODY)
        self.assertIn("t/listed/in/store.json: cannot be read (Permission denied)", end.err)

    def test_lists(self):
        for name in ("a", "b c", "-d"):
            self.add_shop(name)
        self.write(
            "t/list.txt",
            b'\r\n# shops\r\na/store.json\r\n"b c/store.json"\r\n  -d/store.json  \r\n\n\n'
            b"./a/store.json\na\n..\nno\0thing.json\nb c/../nowhere.json\n../t/a/store.json",
        )
        end = self.expect(
            {
                **dict.fromkeys(("a", "b c", "-d"), "planned"),
                **dict.fromkeys(("a~2", "line 10", "no\\x00thing", "nowhere"), "failed"),
            },
            "t/list.txt",
        )
        self.assertEqual(end.err.count("lists the store"), 2)
        # Backslashes, as Windows writes them, unless they are part of a name.
        self.add_shop("north/12")
        self.add_shop("east\\3")
        self.write("t/list.txt", b'north\\12\\store.json\r\n".\\b c\\store.json"\r\neast\\3/store.json\r\n')
        overwrite = f"--overwrite {QUICK}"
        self.expect(dict.fromkeys(("north/12", "b c", "east\\3"), "planned"), "t/list.txt", overwrite)
        # A store of an own list, whose path begins like an option.
        self.write("list.txt", "-e.json\n")
        self.write("-e.json", TINY.read_bytes())
        self.batch(overwrite, source="list.txt")

    def test_broken_stores_are_reported_before_the_first_plan(self):
        self.add_shop("a")
        shop = json.loads(TINY.read_text(encoding="utf-8"))
        mesh = {"type": "mesh", "id": "m", "file": "missing.obj", "at": [1, 1, 0], "materials": {"*": "w"}}
        shop["fixtures"][0] = mesh
        for name, content in (("text", "{"), ("mesh", shop), ("utf16", "{}".encode("utf-16"))):
            self.add_shop(name, content)
        # The plan would take hours.
        process = self.start("batch t -o r -- --samples 1000000000")
        process.wait_until(lambda: process.printed(2).count("\n") >= 3)
        reported = process.end().err.splitlines()
        self.assertEqual([line.split("'")[1] for line in reported[:3]], ["mesh", "text", "utf16"])
        self.assertIn("missing.obj", reported[0])
        failed = dict.fromkeys(("mesh", "text", "utf16"), "failed")
        self.assertEqual(self.statuses(), {"a": "unfinished", **failed})
        end = self.expect({"a": "planned", **failed}, options=f"--resume --quiet {QUICK}")
        self.assertNotIn("warning", end.err)
        # A corrected store is planned, although none of its files is part of its input.
        self.write("t/mesh/missing.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n")
        self.batch(f"--resume {QUICK}", 1)
        self.assertNotEqual(self.statuses()["mesh"], "failed")
