"""How the server starts, listens and ends, and what it says if it cannot."""

import gzip
import json
import os
import pathlib
import re
import resource
import signal
import socket
import struct
import unittest
import urllib.parse

from harness import contents, output, run
from planner import STORE, NotStarted, ServeTest, command
from websocket import Closed, Refused

NOBODY = 65534


def own_addresses():
    """The IPv4 addresses for other computers, as the system lists them."""
    return {address for address in output("-I", program="hostname").split() if ":" not in address}


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Start(ServeTest):
    def test_a_new_folder_gets_a_shop(self):
        for folder in (self.folder, self.scratch / "new/shop"):
            server = self.serve(folder=folder)
            tab = self.open(server)
            self.assertEqual(tab.json["name"], "New shop")
            fixture = {"preset": "gondola 1.25 m, double, 1.6 m high", "id": "A1", "at": [8, 6]}
            self.assertIn(fixture["preset"], tab.project["shared"]["presets"])
            self.assertEqual(len(tab.problems), 1, "it has no labels")
            self.assertNotIn("error", tab.edit({"path": "/fixtures/0", "after": fixture}))
            self.assertEqual(tab.problems, [])
            self.assertEqual(tab.project["name"], "New shop")
            tab.set("/name", "Mine")
            self.assertIn('"name": "Mine"', self.text(folder / "store.json"))
            tab.set("/name", "")
            self.assertEqual(self.open(server).project["name"], folder.name)

    def test_a_store_file_stands_for_its_folder(self):
        self.write_store()
        tab = self.open(self.serve(folder=self.store))
        self.assertEqual(tab.json["name"], "Aisle")
        other = self.write("labels.csv", "id\n")
        self.assertIn("labels.csv: is not a folder; name a folder with a store.json", self.refusal(folder=other))
        for name in ("new.json", "new/store.json"):
            self.assertIn("does not exist", self.refusal(folder=self.scratch / name))
        self.assertEqual([path.name for path in self.scratch.iterdir()], ["shop"])

    def test_a_demo_leaves_nothing(self):
        server = self.start("serve --demo --no-browser", env=os.environ | {"TMPDIR": str(self.scratch)})
        server.wait_until(lambda: server.printed().count("\n") >= 2)
        told = server.printed().splitlines()
        self.assertIn(str(self.scratch), told[0])
        self.assertIn("this temporary copy is then removed", told[1])
        self.assertEqual(server.end(signal.SIGTERM).status, 0)
        self.assertEqual([path.name for path in self.scratch.iterdir()], ["shop"])

    def test_the_address_is_printed_quietly_too(self):
        server = self.start("serve . --no-browser --quiet")
        server.wait_until(lambda: "\n" in server.printed())
        self.assertRegex(server.printed(), r"^http://127\.0\.0\.1:\d+/[0-9a-f]{32}/\n")

    def test_a_port_in_use(self):
        self.write_store()
        with socket.create_server(("127.0.0.1", 0)) as other:
            port = other.getsockname()[1]
            line = self.refusal("--port", str(port))
            for folder in (self.scratch / "new/shop", self.folder):
                self.refusal("--port", str(port), folder=folder)
                self.refusal("--demo", "--port", str(port), folder=folder)
        self.assertIn(str(port), line)
        self.assertIn("in use", line)
        self.assertIn("choose another port", line)
        self.assertEqual([path.name for path in self.scratch.iterdir()], ["shop"])
        self.assertEqual(contents(self.folder), {"store.json": STORE.encode()})
        self.open(self.serve("--port", str(free_port())))

    def test_refused_options_leave_nothing(self):
        broken = self.write("broken.json", "{")
        for option, word in (
            (("--listen", "shop.example"), "shop.example"),
            (("--allow-host", "a b"), "a b"),
            (("--catalogue", "none.json"), "none.json"),
            (("--catalogue", str(broken)), "broken.json"),
        ):
            self.assertIn(word, self.refusal(*option, folder=self.scratch / "new"))
        self.assertEqual([path.name for path in self.scratch.iterdir()], ["shop"])
        self.serve(folder=self.scratch / "new")  # negative control: without them it makes the folder
        self.assertTrue((self.scratch / "new/store.json").exists())

    def test_an_address_in_brackets_is_allowed(self):
        def status(server, host):
            port = urllib.parse.urlsplit(server.address).port
            return self.reply(server.address, Host=host.format(port)).status

        allowing, plain = self.serve("--allow-host", "[::1]"), self.serve(folder=self.scratch / "other")
        self.assertEqual([status(one, "[::1]:{}") for one in (allowing, plain)], [200, 403])
        for host in ("attacker.example:{}", "::1", "::1:{}", "[::1]:1", "[::2]:{}", "[::1].attacker.example:{}"):
            self.assertEqual(status(allowing, host), 403, host)
        # The folder may follow the option.
        server = self.start("serve --no-browser --json --allow-host [::1] ../last")
        self.assertTrue(server.wait_until(lambda: server.printed().startswith("{\n")))
        self.assertTrue((self.scratch / "last/store.json").exists())

    def test_a_folder_in_use(self):
        self.write_store()
        server = self.serve()
        before = contents(self.folder)
        line = self.refusal()
        self.assertIn(f"{self.folder}: is in use by another run of shelfbeam (process {server.process.pid})", line)
        self.assertIn("use the page of the other, or end it", line)
        self.assertEqual(contents(self.folder), before)
        self.assertNotIn("error", self.open(server).set("/name", "Nave"))
        server.kill()
        self.open(self.serve())

    def test_folders_that_hold_no_project(self):
        self.write_store("{")
        self.assertIn("store.json: is not valid JSON", self.refusal())
        self.write_store("[]")
        self.assertIn("is not a JSON object", self.refusal())
        self.write_store(json.dumps({"format": 1000}))
        self.assertIn("format version 1000", self.refusal())
        self.assertEqual(list(contents(self.folder)), ["store.json"], "nothing was written")
        self.store.unlink()
        os.mkfifo(self.store)
        self.assertIn("is not a regular file", self.refusal())
        self.store.unlink()
        self.store.symlink_to("elsewhere")
        self.assertIn("is a symbolic link", self.refusal())
        self.write("elsewhere", STORE)
        self.assertIn("is a symbolic link", self.refusal())
        self.refusal(folder=self.folder / "elsewhere")
        self.store.unlink()
        self.write_store()
        self.write(".shelfbeam", "")
        self.assertIn("error: .shelfbeam: is not a folder", self.refusal())

    @unittest.skipUnless(os.geteuid() == 0, "only root can run the program as another user")
    def test_a_folder_of_somebody_else(self):
        self.write_store()
        self.scratch.chmod(0o755)
        self.folder.chmod(0o755)
        self.assertIn("Permission denied", self.refusal(user=NOBODY, group=NOBODY))
        self.assertEqual(list(contents(self.folder)), ["store.json"])
        self.assertIn("Permission denied", self.refusal(folder=self.scratch / "new", user=NOBODY, group=NOBODY))
        self.assertEqual([path.name for path in self.scratch.iterdir()], ["shop"])

    @unittest.skipUnless(os.geteuid() == 0, "only root can run the program as another user")
    def test_a_group_shares_a_folder(self):
        first, second, group, stranger = 2001, 2002, 3000, 3001

        def own_group(user, **more):
            return {"user": user, "group": user, "extra_groups": [group], **more}

        self.scratch.chmod(0o755)
        for mode, umask in ((0o2775, 0o022), (0o2770, 0o077), (0o775, 0o022), (0o2775, 0o002)):
            folder = self.scratch / f"{mode:o}-{umask:o}"
            folder.mkdir()
            os.chown(folder, first, group)
            folder.chmod(mode)
            store = self.write(folder / "store.json", STORE)
            os.chown(store, first, group)
            store.chmod(0o660)
            for k, user in enumerate((second, first, second)):
                server = self.serve(folder=folder, **own_group(user, umask=umask))
                tab = self.open(server)
                self.assertEqual(len(tab.history["steps"]), k, "the history goes on")
                self.assertNotIn("error", tab.set("/name", f"Shop {k}"))
                self.assertIn(f"Shop {k}", self.text(store))
                tab.close()  # a server that ends waits for its pages
                # A lock of a process that was killed is left behind.
                server.kill() if k == 0 else server.end(signal.SIGTERM)
                status = store.stat()
                self.assertEqual((status.st_gid, status.st_mode & 0o777), (group, 0o660))
            hidden = (folder / ".shelfbeam").stat()
            # Others may not read the store, and its texts are in the history.
            self.assertEqual((hidden.st_gid, hidden.st_mode & 0o7777), (group, 0o2770))
            with self.assertRaises(NotStarted):
                self.serve(folder=folder, user=stranger, group=stranger, extra_groups=[])

    @unittest.skipUnless(os.geteuid() == 0, "only root can run the program as another user")
    def test_a_hidden_folder_of_an_earlier_version(self):
        self.write_store()
        self.scratch.chmod(0o755)
        hidden = self.folder / ".shelfbeam"
        for path in (self.folder, self.store):
            os.chown(path, 2001, 3000)
        self.folder.chmod(0o2775)
        self.serve(user=2001, group=3000, extra_groups=[]).kill()
        self.assertEqual(hidden.stat().st_mode & 0o7777, 0o2775, "as its folder")
        hidden.chmod(0o2700)
        second = {"user": 2002, "group": 2002, "extra_groups": [3000]}
        self.assertRegex(self.refusal(**second), r"error: \.shelfbeam: cannot be written \(Permission denied\); let")
        self.serve(user=2001, group=3000, extra_groups=[]).kill()
        self.open(self.serve(**second))

    def test_a_full_disk_at_the_start(self):
        self.write_store()
        for size in (0, 10, 500):
            end = run(*command(self.folder), limits=[(resource.RLIMIT_FSIZE, size)], timeout=60)
            self.assertEqual((end.status, end.out), (2, ""))
            self.assertRegex(end.err, r"\Aerror: [^\n]*cannot be written[^\n]*\n\Z")
            self.assertEqual(self.text("store.json"), STORE)
            self.assertEqual([name for name in contents(self.folder) if ".shelfbeam-" in name], [])
        for path in (self.folder / ".shelfbeam").iterdir():
            self.assertEqual(path.stat().st_size, 0, path)
        self.open(self.serve()).set("/name", "Nave")

    def test_a_full_disk_during_edits(self):
        self.write_store()
        server = self.serve()
        tab = self.open(server)
        tab.set("/name", "Nave")
        before, revision = contents(self.folder), tab.revision
        for size in (0, 100, len(STORE) + 10):
            resource.prlimit(server.process.pid, resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))
            for answer in (tab.set("/name", "x" * 500), tab.set("/fixtures/0/id", "y"), tab.ask("undo")):
                self.assertIn("cannot be written", answer["error"]["message"], size)
            self.assertEqual((contents(self.folder), tab.revision), (before, revision))
        self.write_store(STORE.replace("Aisle", "Outside"))
        outside = contents(self.folder)
        self.assertIn("cannot be written", tab.set("/name", "Lost")["error"]["message"])
        self.assertEqual(contents(self.folder), outside)
        resource.prlimit(server.process.pid, resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
        tab.reach(revision + 1)
        self.assertEqual(tab.json["name"], "Outside")
        self.assertNotIn("error", tab.set("/name", "Apse"))
        self.assertEqual(self.document()["name"], "Apse")


class End(ServeTest):
    def test_a_signal_closes_pages(self):
        self.write_store()
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            server = self.serve()
            tabs = [self.open(server) for _ in range(3)]
            tabs[0].set("/name", number.name)
            server.process.send_signal(number)
            for tab in tabs:
                with self.assertRaises(Closed) as farewell:
                    while True:
                        tab.read()
                self.assertEqual(farewell.exception.code, 1001)
                tab.close()
            end = server.wait()
            self.assertEqual((end.status, end.err), (0, ""))
            self.assertEqual(self.document()["name"], number.name)


class Address(ServeTest):
    def test_all_files_of_the_page_are_there(self):
        self.write_store()
        server = self.serve()
        page = gzip.decompress(self.reply(server.address).read()).decode()
        files = re.findall(r'(?:href|src)="([^"]+)"', page)
        self.assertIn("icon.svg", files, "without an icon, browsers ask for /favicon.ico")
        for file in files:
            self.assertEqual(self.reply(server.address, file).status, 200, file)

    def test_only_floor_plans_and_tables_are_uploaded(self):
        server = self.serve()

        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + b"crc."

        header = struct.pack(">IIBBBBB", 3, 2, 8, 0, 0, 0, 0)
        picture = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IEND", b"")

        def put(name, body, **fields):
            return self.put(server, name, body, **fields).getresponse()

        before = contents(self.folder)
        for method in ("PUT", "POST", "DELETE", "PATCH", "OPTIONS"):
            self.assertEqual(self.reply(server.address, "mesh.glb", method).status, 405, method)
        self.assertEqual(self.reply(server.address, "files/plan.png", "PUT", **{"Content-Length": "9"}).status, 403)
        for status, name, body, fields in (
            (403, "plan.png", picture, {"Origin": "http://attacker.example"}),
            (422, "plan.png", b"\x89HDF\r\n\x1a\n" + b"0" * 100, {}),
            (422, "store.json", b"{}", {}),
            (422, ".shelfbeam", picture, {}),
            (422, "store.json", picture, {}),
            (422, "plan.png", picture[:-5], {}),
            (422, "plan.pdf", b"<script>alert(1)</script>", {}),
            (422, "plan.html", b"%PDF-1.7", {}),
            (422, "labels.csv", b"Br\xf6tchen,1", {}),
        ):
            answer = put(name, body, **fields)
            self.assertEqual(answer.status, status, name)
            self.assertTrue(answer.read(), name)
        for name in ("..%2Fplan.png", "../plan.png", "%2e%2e/plan.png"):
            self.assertIn(put(name, picture).status, (404, 405, 422), name)
        self.assertEqual(contents(self.folder), before)
        for name, body, told, kind in (
            ("plan.png", picture, {"file": "plan.png", "width": 3, "height": 2}, "image/png"),
            ("plan.pdf", b"%PDF-1.7", {"file": "plan.pdf"}, "application/pdf"),
            ("labels.csv", b"id,x\n1,2\n", {"file": "labels.csv"}, "text/csv"),
            ("labels.csv", b"id,x\n3,4\n", {"file": "labels-2.csv"}, "text/csv"),
        ):
            answer = put(name, body)
            self.assertEqual((answer.status, json.loads(answer.read())), (201, told))
            self.assertEqual(self.bytes(told["file"]), body)
            sent = self.reply(server.address, f"files/{told['file']}")
            self.assertEqual((sent.status, sent.read(), sent.headers["Content-Type"]), (200, body, kind))
        self.assertEqual(self.reply(server.address, "files/store.json").status, 404)

    def test_broken_files_of_devices_are_not_kept(self):
        server = self.serve()
        before = contents(self.folder)
        for name, body, words in (
            ("cut.ies", b"IESNA:LM-63-2002\nTILT=NONE\n1 2 3\n", "cut.ies: line 3: the file ends"),
            ("cut.ldt", b"only one line", "cut.ldt: "),
            ("cut.obj", b"v 1 2\nf 1 2 3\n", "a coordinate is missing"),
            ("cut.glb", b"glTF....", "cut.glb"),
            ("empty.stl", b"solid\nendsolid\n", "empty.stl"),
        ):
            answer = self.put(server, name, body).getresponse()
            self.assertEqual(answer.status, 422, name)
            self.assertIn(words, answer.read().decode())
            self.assertEqual(self.reply(server.address, f"files/{name}").status, 404, name)
        self.assertEqual(contents(self.folder), before)
        self.assertEqual(self.put(server, "m.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").getresponse().status, 201)

    def test_only_this_computer_by_default(self):
        server = self.serve()
        url = urllib.parse.urlsplit(server.address)
        self.assertEqual(url.hostname, "127.0.0.1")
        with self.assertRaises(ConnectionRefusedError):
            socket.create_connection(("127.0.0.2", url.port), 5)
        end = server.end()
        self.assertEqual((end.status, end.err), (0, ""))

    def test_another_address_is_said(self):
        for address, said in (("127.0.0.2", "127.0.0.2"), ("0.0.0.0", "127.0.0.1")):
            server = self.serve("--listen", address)
            url = urllib.parse.urlsplit(server.address)
            self.assertEqual(url.hostname, said)
            for one in server.addresses:
                self.open(server, address=one).close()
            other = server.address.replace(said, "127.0.0.2")
            self.assertEqual(self.reply(other).status, 200 if said == "127.0.0.2" else 403)
            if address == "0.0.0.0":
                self.assertEqual({urllib.parse.urlsplit(one).hostname for one in server.addresses[1:]}, own_addresses())
            end = server.end()
            self.assertEqual(end.status, 0)
            warning = "Other computers can reach this planner at 0.0.0.0;"
            self.assertEqual(warning in end.err, address == "0.0.0.0", end.err)

    def test_other_names(self):
        names = ("shop.example", "proxy.example:8443")
        server = self.serve(*(word for name in names for word in ("--allow-host", name)))
        url = urllib.parse.urlsplit(server.address)
        for host in (f"shop.example:{url.port}", "shop.example", "SHOP.example", "proxy.example:8443"):
            self.assertEqual(self.reply(server.address, Host=host).status, 200, host)
            self.open(server, Host=host, Origin=f"http://{host}")
        for host in (f"evil.example:{url.port}", "shop.example.evil", f"proxy.example:{url.port}", ""):
            self.assertEqual(self.reply(server.address, Host=host).status, 403, host)
            with self.assertRaises(Refused) as refusal:
                self.open(server, Host=host, Origin=f"http://{host}")
            self.assertEqual(refusal.exception.status, 403)

    def test_wrong_addresses(self):
        self.write_store()
        for option, value, words in (
            ("--listen", "256.1.1.1", "is neither IPv4 nor IPv6; e.g. 127.0.0.1"),
            ("--listen", "192.0.2.1", "choose an address of this computer"),
            ("--allow-host", "a b", "write it as the browser shows it, e.g. shop.example"),
            ("--port", "0", "is not a whole number from 1 to 65535"),
        ):
            self.assertIn(words, self.refusal(option, value))
            self.assertEqual(self.text("store.json"), STORE)


XDG_OPEN = """#!/bin/sh
for one in "$@"; do printf '%s\\n' "$one"; done > "$RECORD.new"
stat --format=%a "$1" >> "$RECORD.new"
cat "$1" >> "$RECORD.new"
mv "$RECORD.new" "$RECORD"
"""


class Browser(ServeTest):
    """A desktop with a program `xdg-open` that records what it is given."""

    def setUp(self):
        super().setUp()
        self.write_store()
        self.write(self.scratch / "bin/xdg-open", XDG_OPEN).chmod(0o755)
        self.record = self.scratch / "record"
        search = f"{self.scratch}/bin{os.pathsep}{os.environ['PATH']}"
        self.environment = dict(os.environ, PATH=search, RECORD=str(self.record), DISPLAY=":99")
        self.environment.pop("WAYLAND_DISPLAY", None)

    def recorded(self, server):
        """Waits for the program: its argument, the mode of the file, and its content."""
        server.wait_until(self.record.exists)
        argument, mode, content = self.text(self.record).split("\n", 2)
        return pathlib.Path(argument), mode, content

    def test_a_private_file_leads_the_browser_to_the_page(self):
        server = self.serve(browser=True, env=self.environment)
        page, mode, content = self.recorded(server)
        self.assertEqual(page, self.folder / ".shelfbeam/open.html")
        self.assertEqual(mode, "600", "other users must not read the token")
        self.assertIn(f"url={server.address}", content)
        token = urllib.parse.urlsplit(server.address).path.strip("/")
        self.assertGreater(len(token), 20)
        # All users can list the arguments of all programs.
        self.assertNotIn(token, str(page))
        arguments = pathlib.Path(f"/proc/{server.process.pid}/cmdline").read_bytes().decode()
        self.assertNotIn(token, arguments)

    def test_a_planted_file_or_link_does_not_get_the_address(self):
        mine = self.write(self.scratch / "mine", "mine")
        (self.folder / ".shelfbeam").mkdir()
        (self.folder / ".shelfbeam/open.html").symlink_to(mine)
        server = self.serve(browser=True, env=self.environment)
        page, mode, content = self.recorded(server)
        self.assertEqual((mode, page.is_symlink()), ("600", False))
        self.assertIn(server.address, content)
        self.assertEqual(self.text(mine), "mine")

    def test_no_browser_without_a_desktop_or_by_option(self):
        plain = {key: value for key, value in self.environment.items() if key != "DISPLAY"}
        for browser, environment in ((True, plain), (False, self.environment)):
            server = self.serve(browser=browser, env=environment)
            end = server.end()
            self.assertEqual((end.status, end.err), (0, ""))
            self.assertFalse((self.folder / ".shelfbeam/open.html").exists())
        self.assertFalse(self.record.exists())
