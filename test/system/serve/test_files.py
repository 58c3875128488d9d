"""Stores that name files outside the folder, and names that are markup."""

import gzip
import json
import os
import resource
import time

from harness import contents
from planner import ServeTest, plain_store

SECRET = "SECRET-4711"
LABELS = f"id,x,y,z,nx,ny,nz,type\n{SECRET},1,1,1,0,0,1,l\n"
CATALOGUE = json.dumps({"materials": {SECRET: {"type": "lambertian", "reflectance": 0.5}}})
# The readers quote what they do not understand.
NO_CSV = f"id,x,y,z,nx,ny,nz,type\na,{SECRET},1,1,0,0,1,l\n"
NO_UNITS = f"id,x,y,z,ax,ay,az,roll_deg,type\na,{SECRET},1,1,0,0,1,0,t\n"
NO_PLANOGRAM = f"article,fixture,face,level,x\na,{SECRET},front,1,1\n"
NO_MESH = f"v {SECRET} 0 0\n"
MESH = f"usemtl {SECRET}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def gltf(uri):
    return json.dumps(
        {
            "asset": {"version": "2.0"},
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "buffers": [{"byteLength": 36, "uri": uri}],
        }
    )


def mesh(name):
    return {"type": "mesh", "id": "m", "file": name, "at": [2, 2, 0], "materials": {"none": "w"}}


# What names a file of each kind.
KINDS = {
    "labels.csv": (LABELS, lambda name: {"labels": {"csv": name}}),
    "broken.csv": (NO_CSV, lambda name: {"labels": {"csv": name}}),
    "units.csv": (NO_UNITS, lambda name: {"transceivers": {"list": {"csv": name}}}),
    "planogram.csv": (NO_PLANOGRAM, lambda name: {"planogram": {"file": name, "type": "l"}}),
    "catalogue.json": (CATALOGUE, lambda name: {"catalogues": [name]}),
    "broken.json": (f'{{"{SECRET}": 1}}', lambda name: {"catalogues": [name]}),
    "mesh.obj": (MESH, lambda name: {"fixtures": [mesh(name)]}),
    "broken.obj": (NO_MESH, lambda name: {"fixtures": [mesh(name)]}),
    "profile.ies": (
        f"IESNA:LM-63-2002\n{SECRET}\nTILT=NONE\n{SECRET}\n",
        lambda name: {"transceiver_types": {"t": {"emission": {"type": "ies", "file": name, "flux": 3}}}},
    ),
}


class Files(ServeTest):
    def setUp(self):
        super().setUp()
        self.outside = self.scratch / "outside"
        for name, (content, _) in KINDS.items():
            self.write(self.outside / name, content)
        (self.folder / "up").symlink_to("..")
        (self.folder / "beside").symlink_to("../outside")
        for name in KINDS:
            (self.folder / f"link-{name}").symlink_to(self.outside / name)

    def names_of(self, name):
        """Names of a file outside, by "..", from the root, and by a link as its last and as its first part."""
        return (f"../outside/{name}", f"up/outside/{name}", str(self.outside / name), f"link-{name}", f"beside/{name}")

    def everything_about(self, server, tab):
        """All that the server tells: events, documents, and answers about each fixture and device."""
        told = [json.dumps(tab.events).encode(), *tab.frames]
        for path in ("/fixtures/0", "/transceiver_types/t"):
            told.append(json.dumps(tab.ask("details", path=path)).encode())
        for kind in ("label", "unit"):
            told.append(json.dumps(tab.ask("device", kind=kind, index=0)).encode())
        told.append(json.dumps(tab.ask("find", text="SECRET")["hits"]).encode())
        told.append(self.reply(server.address, "scene").read())
        return b"\n".join(told)

    def test_uploads_need_no_memory(self):
        self.write_store()
        server = self.serve()
        self.open(server)
        size, part = 40 << 20, b"id,x\n" * (4 << 20)  # half of the file
        before = server.status("VmHWM"), sorted(self.folder.iterdir())
        connections = [self.put(server, f"{k}.csv", part, size) for k in range(3)]
        connections[0].send(part[: size - len(part)])
        reply = connections[0].getresponse()
        self.assertEqual((reply.status, json.loads(reply.read())), (201, {"file": "0.csv"}))
        self.assertEqual((self.folder / "0.csv").stat().st_size, size)
        anonymous = server.status("RssAnon")
        self.assertLess(anonymous, before[0] + (10 << 20))
        for connection in connections[1:]:
            connection.close()
        self.assertEqual(sorted(self.folder.iterdir()), sorted([*before[1], self.folder / "0.csv"]))
        kept = {path.name for path in (self.folder / ".shelfbeam").iterdir()}
        self.assertFalse([name for name in kept if "shelfbeam-" in name and not name.endswith("locked")], kept)
        # The same content keeps its name, and another gets a number.
        for content, name in ((b"id\n", "1.csv"), (b"id\n", "1.csv"), (b"ib\n", "1-2.csv")):
            reply = self.put(server, "1.csv", content).getresponse()
            self.assertEqual(json.loads(reply.read())["file"], name)

    def test_uploads_have_one_limit(self):
        self.write_store()
        server = self.serve()
        self.open(server)
        limit = 200 << 20
        for size, words in ((limit + 1, "209,715,201 bytes; the maximum is 200 MiB"), (0, "is empty")):
            reply = self.put(server, "a.csv", size=size).getresponse()
            self.assertEqual(reply.status, 413)
            self.assertIn(words, reply.read().decode())
        first = self.put(server, "a.csv", b"id", limit)
        refused = self.put(server, "b.csv", size=3).getresponse()
        self.assertEqual(refused.status, 413)
        self.assertIn("200 MiB in total", refused.read().decode())
        first.close()

        def is_kept():
            return self.put(server, "b.csv", b"id\n").getresponse().status == 201

        self.assertTrue(server.wait_until(is_kept), "after the server has noticed")

    def test_an_upload_to_a_full_disk_leaves_nothing(self):
        self.write_store()
        server = self.serve()
        self.open(server)
        resource.prlimit(server.process.pid, resource.RLIMIT_FSIZE, (1 << 20, resource.RLIM_INFINITY))
        before = contents(self.folder)
        reply = self.put(server, "a.csv", b"x" * (2 << 20)).getresponse()
        self.assertEqual(reply.status, 422)
        self.assertIn("cannot be kept (File too large)", reply.read().decode())
        self.assertEqual(contents(self.folder), before)

    def name_files(self, tab, changes):
        """Edits the store so that it names them."""
        ops = [{"path": f"/{key}", "before": tab.json.get(key), "after": value} for key, value in changes.items()]
        for op in ops:
            if op["before"] is None:
                del op["before"]
        self.assertNotIn("error", tab.edit(*ops))

    def test_outside_are_not_read(self):
        self.write_store(plain_store())
        server = self.serve()
        tab = self.open(server)
        for kind, (_, changes) in KINDS.items():
            for name in self.names_of(kind):
                self.name_files(tab, changes(name))
                (problem,) = [one for one in tab.problems if name in one["sentence"]]
                self.assertRegex(problem["sentence"], "outside the folder|symbolic link", name)
                self.assertNotIn(SECRET.encode(), self.everything_about(server, tab), name)
                tab.ask("undo")

    def test_in_the_folder_are_read(self):
        # The test above would see the bytes of a file. A link is not followed in the folder either.
        for name, (content, _) in KINDS.items():
            self.write(name, content)
            (self.folder / f"inner-{name}").symlink_to(name)
        self.write_store(plain_store())
        server = self.serve()
        for kind, (_, changes) in KINDS.items():
            tab = self.open(server)
            self.name_files(tab, changes(f"inner-{kind}"))
            self.assertIn("symbolic link", json.dumps(tab.problems), kind)
            self.assertNotIn(SECRET.encode(), self.everything_about(server, tab), kind)
            self.name_files(tab, changes(kind))
            self.assertIn(SECRET.encode(), self.everything_about(server, tab), kind)
            tab.ask("go", position=0)

    def test_buffers_of_meshes(self):
        (self.outside / "buffer").write_bytes(bytes(36))
        (self.folder / "buffer").symlink_to("../outside/buffer")
        store = plain_store(fixtures=[{**mesh("m.gltf"), "materials": {"*": "w"}}])
        for uri in ("../outside/buffer", "%2e%2e/outside/buffer", "buffer", "beside/buffer", "up/outside/buffer"):
            self.write("m.gltf", gltf(uri))
            self.write_store(store)
            server = self.serve()
            (problem,) = self.open(server).problems
            self.assertRegex(problem["sentence"], "outside the folder|symbolic link", uri)
            server.kill()

    def test_a_changed_mesh_is_read_again(self):
        file = self.folder / "m.obj"
        old = time.time() - 60

        def write(width):
            new = self.write("new.obj", f"v 0 0 0\nv {width} 0 0\nv 0 1 0\nf 1 2 3\n")
            os.utime(new, (old, old))  # a file that has just changed is read each time
            new.rename(file)

        write(1)
        self.write_store(plain_store(fixtures=[{**mesh("m.obj"), "materials": {"*": "w"}}]))
        tab = self.open(self.serve())

        outlines = []
        for width in (None, 3, 4):
            if width:
                write(width)
            tab.set("/name", tab.json["name"] + "+")
            parts = tab.changes()[-1]["parts"]["set"]
            outlines.append(max((x for part in parts for x, _ in part["outline"]), default=None))
        self.assertEqual(outlines[0], None, "nothing has changed")
        self.assertEqual(outlines[2] - outlines[1], 1)

    def test_warnings_follow_no_links(self):
        # The child process reads the file that is in place when it starts.
        self.write("labels.csv", LABELS.replace("1,1,1", "1.5,1.2,0.5"))
        store = plain_store(labels={"csv": "labels.csv"})
        self.write_store(store)
        tab = self.open(self.serve())
        warned = tab.next("warnings")
        self.assertIn(SECRET, json.dumps(warned))
        (self.folder / "labels.csv").rename(self.folder / "kept.csv")
        tab.set("/name", "Nave")
        # Too late for the server, and in time for the child.
        (self.folder / "labels.csv").symlink_to("kept.csv")
        self.assertEqual(tab.next("warnings")["warnings"], [])


MARKUP = "<script>alert(1)</script><img src=x onerror=alert(1)>\"'&amp;"


class Markup(ServeTest):
    def test_in_every_name(self):
        self.folder = self.scratch / "<b onclick=alert(1)>\r\nX-Evil: 1\r\n\r\n<i>"
        self.folder.mkdir()
        self.store = self.folder / "store.json"
        quoted = MARKUP.replace('"', '""')
        self.write("labels.csv", f'id,x,y,z,nx,ny,nz,type\n"{quoted}",1,1,1,0,0,1,"l{quoted}"\n')
        white, label, unit = ("w" + MARKUP, "l" + MARKUP, "t" + MARKUP)
        store = {
            "name": MARKUP,
            "room": {"size": [9, 6, 3], "floor": white, "ceiling": white, "walls": white},
            "presets": {"p" + MARKUP: {"height": 1}},
            "materials": {white: {"type": "lambertian", "reflectance": 0.5}},
            "label_types": {label: {"threshold": 0.05}},
            "transceiver_types": {unit: {"emission": {"type": "lambertian", "flux": 3}}},
            "fixtures": [
                {"type": "box", "id": "f" + MARKUP, "at": [1, 1, 0], "size": [1, 1, 1], "material": white},
                {"type": "box", "id": "g" + MARKUP, "at": [1, 1, 0], "size": [1, 1, 1], "material": MARKUP},
                {"type": MARKUP, "id": "h" + MARKUP, MARKUP: MARKUP},
            ],
            "labels": {"csv": "labels.csv"},
            "transceivers": {"list": [{"id": "u" + MARKUP, "position": [4, 3, 2.9], "type": unit}]},
            MARKUP: MARKUP,
        }
        self.write_store(store)
        server = self.serve()
        tab = self.open(server)
        self.assertEqual(tab.json, store)
        self.assertEqual(tab.project["name"], MARKUP)
        self.assertEqual(tab.project["shared"]["materials"], [white])
        self.assertEqual(tab.ask("device", kind="label", index=0)["device"]["id"], MARKUP)
        self.assertEqual(tab.ask("device", kind="unit", index=0)["device"]["type"], unit)
        self.assertNotIn("error", tab.set("/name", "n" + MARKUP, MARKUP))
        self.assertEqual(tab.history["steps"][0]["label"], MARKUP)
        self.assertEqual(len(tab.ask("find", text="<SCRIPT>")["hits"]), 5)
        tab.ask("edit", label="Missing", ops=[{"path": "/" + MARKUP.replace("/", "~1") + "/x", "after": 1}])

        for name in ("", "none", "scene"):
            reply = self.reply(server.address, name)
            head, body = str(reply.getheaders()), reply.read()
            if reply.getheader("Content-Encoding") == "gzip":
                body = gzip.decompress(body)
            for part in ("alert", "Evil", "onclick"):
                self.assertNotIn(part, head, name)
                self.assertNotIn(part, tab.socket.head.decode(), name)
                if name != "scene":
                    self.assertNotIn(part.encode(), body, name)
            if name == "scene":
                self.assertEqual(reply.getheader("Content-Type"), "application/octet-stream")
                self.assertEqual(reply.getheader("X-Content-Type-Options"), "nosniff")
