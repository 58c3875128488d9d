"""Stores of 5 MB that are made to need much memory."""

import contextlib
import json

from planner import ServeTest, plain_store

LIMIT = 300_000_000  # bytes above before
SIZE = 4_900_000


def numbers():
    store = plain_store(fixtures=[])
    return json.dumps(store)[:-1] + ',"x":[' + "1," * ((SIZE - 1000) // 2) + "1]}"


def labels():
    one = {"id": "", "position": [1, 1, 1], "normal": [0, 0, 1], "type": "l"}
    row = json.dumps(one, separators=(",", ":"))
    count = min(100_000, SIZE // (len(row) + 6))
    rows = ",".join(row.replace('""', f'"{k:x}"', 1) for k in range(count))
    return json.dumps(plain_store())[:-1].replace('"labels": [', '"labels": [' + rows + ",", 1) + "}"


def csv_labels(folder):
    rows = "".join(f"{k},1,1,1,0,0,1,l\n" for k in range(100_000))
    (folder / "labels.csv").write_text("id,x,y,z,nx,ny,nz,type\n" + rows, encoding="utf-8")
    return json.dumps(plain_store(labels={"csv": "labels.csv"}))


def nesting():
    deep = "[" * 97 + "]" * 97
    return json.dumps(plain_store())[:-1] + ',"x":[' + ",".join([deep] * (SIZE // 195 - 10)) + "]}"


def long_names():
    name = "n" * (SIZE // 8)
    fixtures = [
        {"type": "box", "id": f"{k}{name}", "at": [1, k, 0], "size": [1, 0.5, 1], "material": name} for k in range(3)
    ]
    return json.dumps(plain_store(name=name, fixtures=fixtures))


def many_problems():
    # Each entry is a problem with a sentence of its own.
    return json.dumps(plain_store(fixtures=[{"type": "box", "q": k} for k in range(SIZE // 30)]))


def copies(count, labels):
    """Fixtures in 10,000 copies, all with labels."""
    of_fixture = [{"id": f"{k}", "position": [0, 0, 0.6], "normal": [0, -1, 0], "type": "l"} for k in range(labels)]
    fixture = {"type": "box", "at": [1, 1, 0], "size": [0.1, 0.1, 1], "material": "w", "labels": of_fixture}
    repeat = {"count": 10_000, "step": [0.0001, 0]}
    return json.dumps(plain_store(fixtures=[{**fixture, "id": f"{k}-{{n}}", "repeat": repeat} for k in range(count)]))


class Memory(ServeTest):
    def peak(self, content):
        """Bytes above before, while two pages are open."""
        self.write_store(plain_store())
        with contextlib.closing(self.serve()) as server:
            tabs = [self.open(server, timeout=100) for _ in range(2)]
            before = server.status("VmRSS")
            self.write_store(content)
            for tab in tabs:
                tab.next("changed")
            tabs.append(self.open(server, timeout=100))
            self.assertNotIn("error", tabs[0].set("/name", "Nave") if tabs[0].locked is None else {})
            self.assertEqual(tabs[-1].json["name"], tabs[-1].project["json"]["name"])
            return server.status("VmHWM") - before

    def test_stays_small(self):
        stores = {
            "numbers": numbers(),
            "labels": labels(),
            "labels in a file": csv_labels(self.folder),
            "nesting": nesting(),
            "long names": long_names(),
            "problems": many_problems(),
            "copies": copies(30, 0),
            "labels of copies": copies(1, 300),
            "few labels of copies": copies(1, 15),
        }
        for name, content in stores.items():
            with self.subTest(name):
                self.assertLessEqual(len(content), 5_000_000)
                self.assertLess(self.peak(content), LIMIT)
