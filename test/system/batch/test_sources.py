"""Lists and folders of stores with odd names, links and files: each store has its own result."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import chain

TINY = chain.ROOT / "test/data/field/batch/tiny.json"
QUICK = ["--", "--samples", "64", "--budget", "1", "--no-certificate"]
NOBODY = 65534


class Sources(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def shop(self, name):
        path = os.path.join(os.fsencode(self.folder / "t"), os.fsencode(name))
        os.makedirs(path)
        shutil.copy(TINY, os.path.join(path, b"store.json"))

    def batch(self, source, *arguments, **options):
        ended = chain.shelfbeam(
            "batch", source, "-o", "r", *arguments, cwd=self.folder, errors="backslashreplace", **options
        )
        self.assertIn(ended.returncode, (0, 1), ended.stderr)
        return ended

    def statuses(self):
        return {row["name"]: row["status"] for row in chain.rows(self.folder / "r")}

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
            self.shop(name)
        self.batch("t", *QUICK)
        self.assertEqual(self.statuses(), dict.fromkeys(names.values(), "planned"))
        pages = [self.folder / "r" / row["report"] for row in chain.rows(self.folder / "r")]
        self.assertEqual(len(set(pages)), len(names))
        for page in pages:
            self.assertTrue(page.exists(), page)
        before = chain.contents(self.folder / "r")
        self.batch("t", "--resume", *QUICK)  # finds all records
        self.assertEqual(chain.contents(self.folder / "r"), before)

    def test_links_and_other_files(self):
        self.shop("a")
        (self.folder / "outside/shop").mkdir(parents=True)
        shutil.copy(TINY, self.folder / "outside/shop/store.json")
        tree = self.folder / "t"
        (tree / "to-shop").symlink_to("../outside/shop")
        (tree / "to-shops").symlink_to("../outside")
        (tree / "up").symlink_to("..")
        for name, target in (("same", "../a/store.json"), ("dangling", "nowhere"), ("loop", "store.json")):
            (tree / name).mkdir()
            (tree / name / "store.json").symlink_to(target)
        (tree / "pipe").mkdir()
        os.mkfifo(tree / "pipe/store.json")
        self.batch("t", *QUICK)
        expected = {
            "a": "planned",
            "same": "planned",
            "to-shop": "planned",
            "dangling": "failed",
            "loop": "failed",
            "pipe": "failed",
        }
        self.assertEqual(self.statuses(), expected)
        # Results of another batch are not stores, even of plans that were interrupted.
        os.rename(self.folder / "r", tree / "earlier")
        (tree / "earlier/plans/a/placement.json").unlink()
        self.batch("t", *QUICK)
        self.assertEqual(self.statuses(), expected)

    @unittest.skipUnless(os.geteuid() == 0, "only root can run the program as another user")
    def test_folders_that_cannot_be_read(self):
        for name in ("a", "closed/in", "listed/in"):
            self.shop(name)
        self.folder.chmod(0o777)
        (self.folder / "t/closed").chmod(0o311)
        (self.folder / "t/listed").chmod(0o644)
        ended = self.batch("t", *QUICK, user=NOBODY, group=NOBODY)
        self.assertEqual(self.statuses(), {"a": "planned", "closed": "failed", "listed/in": "failed"})
        self.assertIn("t/listed/in/store.json: cannot be read (Permission denied)", ended.stderr)

    def test_lists(self):
        for name in ("a", "b c", "-d"):
            self.shop(name)
        tree = self.folder / "t"
        (tree / "list.txt").write_bytes(
            b'\r\n# shops\r\na/store.json\r\n"b c/store.json"\r\n  -d/store.json  \r\n\n\n'
            b"./a/store.json\na\n..\nno\0thing.json\nb c/../nowhere.json\n../t/a/store.json"
        )
        ended = self.batch("t/list.txt", *QUICK)
        self.assertEqual(
            self.statuses(),
            {
                "a": "planned",
                "b c": "planned",
                "-d": "planned",
                "a~2": "failed",
                "line 10": "failed",
                "no\\x00thing": "failed",
                "nowhere": "failed",
            },
        )
        self.assertEqual(ended.stderr.count("lists the store"), 2)
        # Backslashes, as Windows writes them, unless they are part of a name.
        self.shop("north/12")
        self.shop("east\\3")
        (tree / "list.txt").write_bytes(b'north\\12\\store.json\r\n".\\b c\\store.json"\r\neast\\3/store.json\r\n')
        self.batch("t/list.txt", "--overwrite", *QUICK)
        self.assertEqual(self.statuses(), {"north/12": "planned", "b c": "planned", "east\\3": "planned"})
        # A store of an own list, whose path begins like an option.
        (self.folder / "list.txt").write_text("-e.json\n", encoding="utf-8")
        shutil.copy(TINY, self.folder / "-e.json")
        self.assertEqual(self.batch("list.txt", "--overwrite", *QUICK).returncode, 0)

    def test_broken_stores_are_reported_before_the_first_plan(self):
        self.shop("a")
        shop = json.loads(TINY.read_text(encoding="utf-8"))
        shop["fixtures"][0] = {
            "type": "mesh",
            "id": "m",
            "file": "missing.obj",
            "at": [1, 1, 0],
            "materials": {"*": "w"},
        }
        for name, text in (("text", "{"), ("mesh", json.dumps(shop)), ("utf16", "{}".encode("utf-16"))):
            (self.folder / "t" / name).mkdir()
            (self.folder / "t" / name / "store.json").write_bytes(text if isinstance(text, bytes) else text.encode())
        process = subprocess.Popen(
            [chain.PROGRAM, "batch", "t", "-o", "r", *QUICK],
            cwd=self.folder,
            text=True,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
        )
        reported = [process.stderr.readline() for _ in range(3)]
        self.assertFalse((self.folder / "r/plans/a/placement.json").exists())
        process.communicate()
        self.assertEqual([line.split("'")[1] for line in reported], ["mesh", "text", "utf16"])
        self.assertIn("missing.obj", reported[0])
        self.assertEqual(self.statuses(), {"a": "planned", "mesh": "failed", "text": "failed", "utf16": "failed"})
        self.assertNotIn("warning", self.batch("t", "--resume", "--quiet", *QUICK).stderr)
        # A corrected store is planned, although none of its files is part of its input.
        (self.folder / "t/mesh/missing.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n", encoding="utf-8")
        self.batch("t", "--resume", *QUICK)
        self.assertNotEqual(self.statuses()["mesh"], "failed")


if __name__ == "__main__":
    unittest.main()
