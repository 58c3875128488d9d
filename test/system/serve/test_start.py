"""How the server starts, listens and ends, and what it says if it cannot."""

import gzip
import http.client
import json
import os
import pathlib
import re
import resource
import signal
import socket
import struct
import subprocess
import time
import unittest
import urllib.parse

from planner import STORE, NotStarted, ServeTest, command
from websocket import Closed, Refused

NOBODY = 65534


def own_addresses():
    """Those of IPv4 for other computers, as the system lists them."""
    listed = subprocess.run(["hostname", "-I"], stdout=subprocess.PIPE, text=True, check=True).stdout
    return {address for address in listed.split() if ":" not in address}


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Start(ServeTest):
    def content(self):
        """All files of the folder."""
        return {
            str(path.relative_to(self.folder)): path.read_bytes() for path in self.folder.rglob("*") if path.is_file()
        }

    def refused(self, *options, folder=None, **process):
        """The only line that a server prints which does not start."""
        with self.assertRaises(NotStarted) as failure:
            self.start(*options, folder=folder, **process)
        self.assertEqual((failure.exception.code, failure.exception.out), (2, ""), failure.exception.err)
        (line,) = failure.exception.err.splitlines()
        self.assertTrue(line.startswith("error: "), line)
        return line

    def test_a_new_folder_gets_a_shop(self):
        for folder in (self.folder, self.scratch / "new/shop"):
            server = self.start(folder=folder)
            tab = self.open(server)
            self.assertEqual(tab.json["name"], "New shop")
            fixture = {"preset": "gondola 1.25 m, double, 1.6 m high", "id": "A1", "at": [8, 6]}
            self.assertIn(fixture["preset"], tab.project["shared"]["presets"])
            self.assertEqual(len(tab.problems), 1, "it has no labels")
            self.assertNotIn("error", tab.edit({"path": "/fixtures/0", "after": fixture}))
            self.assertEqual(tab.problems, [])
            self.assertEqual(tab.project["name"], "New shop")
            tab.set("/name", "Mine")
            self.assertIn('"name": "Mine"', (folder / "store.json").read_text(encoding="utf-8"))
            tab.set("/name", "")
            self.assertEqual(self.open(server).project["name"], folder.name)

    def test_a_store_file_stands_for_its_folder(self):
        self.write()
        tab = self.open(self.start(folder=self.store))
        self.assertEqual(tab.json["name"], "Aisle")
        other = self.folder / "labels.csv"
        other.write_text("id\n", encoding="utf-8")
        self.assertIn("labels.csv: is not a folder; name a folder with a store.json", self.refused(folder=other))
        for name in ("new.json", "new/store.json"):
            self.assertIn("does not exist", self.refused(folder=self.scratch / name))
        self.assertEqual([path.name for path in self.scratch.iterdir()], ["shop"])

    def test_a_demo_leaves_nothing(self):
        environment = os.environ | {"TMPDIR": str(self.scratch)}
        process = self.run_plainly("--demo", env=environment)
        self.assertIn(str(self.scratch), process.stdout.readline())
        self.assertIn("this temporary copy is then removed", process.stdout.readline())
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(30), 0)
        self.assertEqual([path.name for path in self.scratch.iterdir()], ["shop"])

    def run_plainly(self, *options, **process):
        """A server that prints for people."""
        return self.run_with([command("")[0], "serve", *options, "--no-browser"], **process)

    def run_with(self, arguments, **process):
        process = subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True, **process)
        self.addCleanup(process.wait)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.kill)
        return process

    def test_the_address_is_printed_quietly_too(self):
        line = self.run_plainly(self.folder, "--quiet").stdout.readline()
        self.assertRegex(line, r"^http://127\.0\.0\.1:\d+/[0-9a-f]{32}/$")

    def test_a_port_in_use(self):
        self.write()
        with socket.create_server(("127.0.0.1", 0)) as other:
            port = other.getsockname()[1]
            line = self.refused("--port", str(port))
            for folder in (self.scratch / "new/shop", self.folder):
                self.refused("--port", str(port), folder=folder)
                self.refused("--demo", "--port", str(port), folder=folder)
        self.assertIn(str(port), line)
        self.assertIn("in use", line)
        self.assertEqual([path.name for path in self.scratch.iterdir()], ["shop"])
        self.assertEqual({name: text.decode() for name, text in self.content().items()}, {"store.json": STORE})
        self.open(self.start("--port", str(free_port())))

    def test_refused_options_leave_nothing(self):
        broken = self.folder / "broken.json"
        broken.write_text("{", encoding="utf-8")
        for option, word in (
            (("--listen", "shop.example"), "shop.example"),
            (("--allow-host", "a b"), "a b"),
            (("--catalogue", "none.json"), "none.json"),
            (("--catalogue", str(broken)), "broken.json"),
        ):
            self.assertIn(word, self.refused(*option, folder=self.scratch / "new"))
        self.assertEqual([path.name for path in self.scratch.iterdir()], ["shop"])
        self.start(folder=self.scratch / "new")  # negative control: without them it makes the folder
        self.assertTrue((self.scratch / "new/store.json").exists())

    def test_an_address_in_brackets_is_allowed(self):
        def status(server, host):
            url = urllib.parse.urlsplit(server.address)
            connection = http.client.HTTPConnection(url.hostname, url.port, timeout=20)
            connection.request("GET", url.path, headers={"Host": host.format(url.port)})
            reply = connection.getresponse()
            connection.close()
            return reply.status

        allowing, plain = self.start("--allow-host", "[::1]"), self.start(folder=self.scratch / "other")
        self.assertEqual([status(one, "[::1]:{}") for one in (allowing, plain)], [200, 403])
        for host in ("attacker.example:{}", "::1", "::1:{}", "[::1]:1", "[::2]:{}", "[::1].attacker.example:{}"):
            self.assertEqual(status(allowing, host), 403, host)
        # The folder may follow the option.
        arguments = [command("")[0], "serve", "--no-browser", "--json", "--allow-host", "[::1]", self.scratch / "last"]
        self.assertEqual(self.run_with(arguments).stdout.readline(), "{\n")
        self.assertTrue((self.scratch / "last/store.json").exists())

    def test_a_folder_in_use(self):
        self.write()
        server = self.start()
        before = self.content()
        line = self.refused()
        self.assertIn(f"{self.folder}: is in use by another run of shelfbeam (process {server.process.pid})", line)
        self.assertEqual(self.content(), before)
        self.assertNotIn("error", self.open(server).set("/name", "Nave"))
        server.kill()
        self.open(self.start())

    def test_folders_that_hold_no_project(self):
        self.write("{")
        self.assertIn("store.json: is not valid JSON", self.refused())
        self.write("[]")
        self.assertIn("is not a JSON object", self.refused())
        self.write(json.dumps({"format": 1000}))
        self.assertIn("format version 1000", self.refused())
        self.assertEqual(list(self.content()), ["store.json"], "nothing was written")
        self.store.unlink()
        os.mkfifo(self.store)
        self.assertIn("is not a regular file", self.refused())
        self.store.unlink()
        self.store.symlink_to("elsewhere")
        self.assertIn("is a symbolic link", self.refused())
        (self.folder / "elsewhere").write_text(STORE, encoding="utf-8")
        self.assertIn("is a symbolic link", self.refused())
        self.refused(folder=self.folder / "elsewhere")
        self.store.unlink()
        self.write()
        (self.folder / ".shelfbeam").write_text("")
        self.assertIn("error: .shelfbeam: is not a folder", self.refused())

    @unittest.skipUnless(os.geteuid() == 0, "only root can run the program as another user")
    def test_a_folder_of_somebody_else(self):
        self.write()
        self.scratch.chmod(0o755)
        self.folder.chmod(0o755)
        self.assertIn("Permission denied", self.refused(user=NOBODY, group=NOBODY))
        self.assertEqual(list(self.content()), ["store.json"])
        self.assertIn("Permission denied", self.refused(folder=self.scratch / "new", user=NOBODY, group=NOBODY))
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
            store = folder / "store.json"
            store.write_text(STORE, encoding="utf-8")
            os.chown(store, first, group)
            store.chmod(0o660)
            for k, user in enumerate((second, first, second)):
                server = self.start(folder=folder, **own_group(user, umask=umask))
                tab = self.open(server)
                self.assertEqual(len(tab.history["steps"]), k, "the history goes on")
                self.assertNotIn("error", tab.set("/name", f"Shop {k}"))
                self.assertIn(f"Shop {k}", store.read_text(encoding="utf-8"))
                # A lock of a process that was killed is left behind.
                server.kill() if k == 0 else server.end(signal.SIGTERM)
                status = store.stat()
                self.assertEqual((status.st_gid, status.st_mode & 0o777), (group, 0o660))
            hidden = (folder / ".shelfbeam").stat()
            # Others may not read the store, and its texts are in the history.
            self.assertEqual((hidden.st_gid, hidden.st_mode & 0o7777), (group, 0o2770))
            with self.assertRaises(NotStarted):
                self.start(folder=folder, user=stranger, group=stranger, extra_groups=[])

    @unittest.skipUnless(os.geteuid() == 0, "only root can run the program as another user")
    def test_a_hidden_folder_of_an_earlier_version(self):
        self.write()
        self.scratch.chmod(0o755)
        hidden = self.folder / ".shelfbeam"
        for path in (self.folder, self.store):
            os.chown(path, 2001, 3000)
        self.folder.chmod(0o2775)
        self.start(user=2001, group=3000, extra_groups=[]).kill()
        self.assertEqual(hidden.stat().st_mode & 0o7777, 0o2775, "as its folder")
        hidden.chmod(0o2700)
        second = {"user": 2002, "group": 2002, "extra_groups": [3000]}
        self.assertRegex(self.refused(**second), r"error: \.shelfbeam: cannot be written \(Permission denied\); let")
        self.start(user=2001, group=3000, extra_groups=[]).kill()
        self.open(self.start(**second))

    def limit(self, process, size):
        """The files of a process then grow to this size only."""
        resource.prlimit(process.pid if process else 0, resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))

    def test_a_full_disk_at_the_start(self):
        self.write()
        for size in (0, 10, 500):
            line = self.refused(preexec_fn=lambda size=size: self.limit(None, size))
            self.assertIn("cannot be written", line)
            self.assertEqual(self.content()["store.json"].decode(), STORE)
            self.assertEqual([name for name in self.content() if ".shelfbeam-" in name], [])
        for path in (self.folder / ".shelfbeam").iterdir():
            self.assertEqual(path.stat().st_size, 0, path)
        self.open(self.start()).set("/name", "Nave")

    def test_a_full_disk_during_edits(self):
        self.write()
        server = self.start()
        tab = self.open(server)
        tab.set("/name", "Nave")
        before, revision = self.content(), tab.revision
        for size in (0, 100, len(STORE) + 10):
            self.limit(server.process, size)
            for answer in (tab.set("/name", "x" * 500), tab.set("/fixtures/0/id", "y"), tab.ask("undo")):
                self.assertIn("cannot be written", answer["error"]["message"], size)
            self.assertEqual((self.content(), tab.revision), (before, revision))
        self.write(STORE.replace("Aisle", "Outside"))
        outside = self.content()
        self.assertIn("cannot be written", tab.set("/name", "Lost")["error"]["message"])
        self.assertEqual(self.content(), outside)
        self.limit(server.process, resource.RLIM_INFINITY)
        tab.reach(revision + 1)
        self.assertEqual(tab.json["name"], "Outside")
        self.assertNotIn("error", tab.set("/name", "Apse"))
        self.assertEqual(self.document()["name"], "Apse")


class End(ServeTest):
    def test_a_signal_closes_pages(self):
        self.write()
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            server = self.start()
            tabs = [self.open(server) for _ in range(3)]
            tabs[0].set("/name", number.name)
            server.process.send_signal(number)
            for tab in tabs:
                with self.assertRaises(Closed) as farewell:
                    while True:
                        tab.read()
                self.assertEqual(farewell.exception.code, 1001)
                tab.close()
            self.assertEqual(server.wait(), (0, ""))
            self.assertEqual(self.document()["name"], number.name)


class Address(ServeTest):
    def answer(self, address, target, host=None, method="GET", fields=None, body=b""):
        url = urllib.parse.urlsplit(address)
        connection = http.client.HTTPConnection(url.hostname, url.port, timeout=20)
        self.addCleanup(connection.close)
        connection.putrequest(method, target, skip_host=True)
        connection.putheader("Host", url.netloc if host is None else host)
        for name, value in (fields or {}).items():
            connection.putheader(name, value)
        if body:
            connection.putheader("Content-Length", str(len(body)))
        connection.endheaders(body)
        return connection.getresponse()

    def status(self, address, target, host):
        return self.answer(address, target, host).status

    def test_all_files_of_the_page_are_there(self):
        self.write()
        server = self.start()
        path = urllib.parse.urlsplit(server.address).path
        page = gzip.decompress(self.answer(server.address, path).read()).decode()
        files = re.findall(r'(?:href|src)="([^"]+)"', page)
        self.assertIn("icon.svg", files, "without an icon, browsers ask for /favicon.ico")
        for file in files:
            self.assertEqual(self.answer(server.address, path + file).status, 200, file)

    def test_only_floor_plans_and_tables_are_uploaded(self):
        server = self.start()
        url = urllib.parse.urlsplit(server.address)
        origin = {"Origin": f"http://{url.netloc}"}

        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + b"crc."

        picture = (
            b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 3, 2, 8, 0, 0, 0, 0)) + chunk(b"IEND", b"")
        )

        def put(name, body, fields=origin):
            return self.answer(server.address, f"{url.path}files/{name}", method="PUT", fields=fields, body=body)

        before = sorted(path.name for path in self.folder.iterdir())
        for method in ("PUT", "POST", "DELETE", "PATCH", "OPTIONS"):
            self.assertEqual(self.answer(server.address, url.path + "mesh.glb", method=method).status, 405, method)
        self.assertEqual(put("plan.png", picture, {}).status, 403)
        self.assertEqual(put("plan.png", picture, {"Origin": "http://attacker.example"}).status, 403)
        for name, body in (
            ("plan.png", b"\x89HDF\r\n\x1a\n" + b"0" * 100),
            ("store.json", b"{}"),
            (".shelfbeam", picture),
            ("store.json", picture),
            ("plan.png", picture[:-5]),
            ("plan.pdf", b"<script>alert(1)</script>"),
            ("plan.html", b"%PDF-1.7"),
            ("labels.csv", b"Br\xf6tchen,1"),
        ):
            answer = put(name, body)
            self.assertEqual(answer.status, 422, name)
            self.assertTrue(answer.read(), name)
        for name in ("..%2Fplan.png", "../plan.png", "%2e%2e/plan.png"):
            self.assertIn(put(name, picture).status, (404, 405, 422), name)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), before)
        answer = put("plan.png", picture)
        self.assertEqual(answer.status, 201)
        self.assertEqual(json.loads(answer.read()), {"file": "plan.png", "width": 3, "height": 2})
        self.assertEqual((self.folder / "plan.png").read_bytes(), picture)
        sent = self.answer(server.address, url.path + "files/plan.png")
        self.assertEqual((sent.status, sent.read()), (200, picture))
        answer = put("plan.pdf", b"%PDF-1.7")
        self.assertEqual((answer.status, json.loads(answer.read())), (201, {"file": "plan.pdf"}))
        sent = self.answer(server.address, url.path + "files/plan.pdf")
        self.assertEqual(sent.headers["Content-Type"], "application/pdf")
        for body, name in ((b"id,x\n1,2\n", "labels.csv"), (b"id,x\n3,4\n", "labels-2.csv")):
            answer = put("labels.csv", body)
            self.assertEqual((answer.status, json.loads(answer.read())), (201, {"file": name}))
            self.assertEqual((self.folder / name).read_bytes(), body)
        sent = self.answer(server.address, url.path + "files/labels.csv")
        self.assertEqual(sent.headers["Content-Type"], "text/csv")
        self.assertEqual(self.answer(server.address, url.path + "files/store.json").status, 404)

    def test_only_this_computer_by_default(self):
        server = self.start()
        url = urllib.parse.urlsplit(server.address)
        self.assertEqual(url.hostname, "127.0.0.1")
        with self.assertRaises(ConnectionRefusedError):
            socket.create_connection(("127.0.0.2", url.port), 5)
        self.assertEqual(server.end(signal.SIGINT), (0, ""))

    def test_another_address_is_said(self):
        for address, said in (("127.0.0.2", "127.0.0.2"), ("0.0.0.0", "127.0.0.1")):
            server = self.start("--listen", address)
            url = urllib.parse.urlsplit(server.address)
            self.assertEqual(url.hostname, said)
            for one in server.addresses:
                self.open(server, address=one).close()
            other = server.address.replace(said, "127.0.0.2")
            self.assertEqual(self.status(other, url.path, f"127.0.0.2:{url.port}"), 200 if said == "127.0.0.2" else 403)
            if address == "0.0.0.0":
                self.assertEqual({urllib.parse.urlsplit(one).hostname for one in server.addresses[1:]}, own_addresses())
            code, text = server.end(signal.SIGINT)
            self.assertEqual(code, 0)
            warning = "Other computers can reach this planner at 0.0.0.0;"
            self.assertEqual(warning in text, address == "0.0.0.0", text)

    def test_other_names(self):
        names = ("shop.example", "proxy.example:8443")
        server = self.start(*(word for name in names for word in ("--allow-host", name)))
        url = urllib.parse.urlsplit(server.address)
        for host in (f"shop.example:{url.port}", "shop.example", "SHOP.example", "proxy.example:8443"):
            self.assertEqual(self.status(server.address, url.path, host), 200, host)
            self.open(server, Host=host, Origin=f"http://{host}")
        for host in (f"evil.example:{url.port}", "shop.example.evil", f"proxy.example:{url.port}", ""):
            self.assertEqual(self.status(server.address, url.path, host), 403, host)
            with self.assertRaises(Refused) as refusal:
                self.open(server, Host=host, Origin=f"http://{host}")
            self.assertEqual(refusal.exception.status, 403)

    def test_wrong_addresses(self):
        self.write()
        for options in (("--listen", "256.1.1.1"), ("--listen", "192.0.2.1"), ("--allow-host", "a b"), ("--port", "0")):
            with self.assertRaises(NotStarted) as failure:
                self.start(*options)
            self.assertEqual((failure.exception.code, failure.exception.out), (2, ""), options)
            self.assertTrue(failure.exception.err.startswith("error: "), failure.exception.err)
            self.assertEqual(self.store.read_text(encoding="utf-8"), STORE)


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
        self.write()
        programs = self.scratch / "bin"
        programs.mkdir()
        opener = programs / "xdg-open"
        opener.write_text(XDG_OPEN, encoding="utf-8")
        opener.chmod(0o755)
        self.record = self.scratch / "record"
        search = f"{programs}{os.pathsep}{os.environ['PATH']}"
        self.environment = dict(os.environ, PATH=search, RECORD=str(self.record), DISPLAY=":99")
        self.environment.pop("WAYLAND_DISPLAY", None)

    def recorded(self):
        """Waits for the program: its argument, the mode of the file, and its content."""
        end = time.monotonic() + 20
        while not self.record.exists():
            self.assertLess(time.monotonic(), end, "no browser was opened")
            time.sleep(0.01)
        argument, mode, content = self.record.read_text(encoding="utf-8").split("\n", 2)
        return pathlib.Path(argument), mode, content

    def test_a_private_file_leads_the_browser_to_the_page(self):
        server = self.start(browser=True, env=self.environment)
        page, mode, content = self.recorded()
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
        mine = self.scratch / "mine"
        mine.write_text("mine", encoding="utf-8")
        (self.folder / ".shelfbeam").mkdir()
        (self.folder / ".shelfbeam/open.html").symlink_to(mine)
        server = self.start(browser=True, env=self.environment)
        page, mode, content = self.recorded()
        self.assertEqual((mode, page.is_symlink()), ("600", False))
        self.assertIn(server.address, content)
        self.assertEqual(mine.read_text(encoding="utf-8"), "mine")

    def test_no_browser_without_a_desktop_or_by_option(self):
        plain = {key: value for key, value in self.environment.items() if key != "DISPLAY"}
        for browser, environment in ((True, plain), (False, self.environment)):
            server = self.start(browser=browser, env=environment)
            self.assertEqual(server.end(signal.SIGINT), (0, ""))
            self.assertFalse((self.folder / ".shelfbeam/open.html").exists())
        self.assertFalse(self.record.exists())
