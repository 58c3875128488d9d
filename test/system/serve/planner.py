"""A running `shelfbeam serve`, and its pages without a browser (docs/formats/planner.md)."""

import copy
import http.client
import json
import os
import pathlib
import re
import subprocess
import unittest
import urllib.parse

from harness import Process, ProgramTest
from websocket import TEXT, WebSocket

# Comments and layout, so that an edit that does not keep them is noticed.
STORE = """// A shop of one aisle.
{
  "name": "Aisle",   // as on the door
  "room": { "size": [9, 6, 3], "floor": "w", "ceiling": "w", "walls": "w" },
  "materials": { "w": { "type": "lambertian", "reflectance": 0.5 } },
  "label_types": { "l": { "threshold": 0.05 } },
  "transceiver_types": { "t": { "emission": { "type": "lambertian", "flux": 3 } } },
  "fixtures": [
    // the left side
    { "type": "box", "id": "a", "at": [1, 1, 0], "size": [1, 0.5, 1], "material": "w" },
    { "type": "box", "id": "b", "at": [1, 3, 0], "size": [1, 0.5, 1], "material": "w" },  // by the door

    { "type": "box", "id": "c", "at": [5, 1, 0],
      "size": [1, 0.5, 1], "material": "w" },
    { "type": "box", "id": "d", "at": [5, 3, 0], "size": [1, 0.5, 1], "material": "w" }
  ],
  "labels": [ { "id": "x", "position": [1.5, 1.52, 0.9], "normal": [0, 1, 0], "type": "l" } ],
  "transceivers": { "list": [ { "id": "T", "position": [4, 3, 2.9], "type": "t" } ] }
}
"""


def without_comments(text):
    """The value of STORE after edits; none of its strings contains two slashes."""
    return json.loads(re.sub(r"//[^\n]*", "", text))


def plain_store(**changes):
    return without_comments(STORE) | changes


class NotStarted(Exception):
    def __init__(self, end):
        super().__init__(str(end))
        self.end = end


def command(folder, *options, browser=False):
    return ["serve", folder, *([] if browser else ["--no-browser"]), "--no-light", "--json", *options]


class Server(Process):
    """`options` of `serve`, and of subprocess.Popen. `browser`: whether it may open one."""

    def __init__(self, folder, *options, browser=False, **process):
        super().__init__(*command(folder, *options, browser=browser), stdin=subprocess.DEVNULL, **process)
        if not self.wait_until(lambda: self.printed().endswith("\n}\n")):
            end = self.wait()
            self.close()
            if "has no page" in end.err and not os.environ.get("CI"):
                raise unittest.SkipTest(end.err)
            raise NotStarted(end)
        printed = json.loads(self.printed())
        self.address, self.addresses = printed["address"], printed["addresses"]

    def status(self, key):
        """A line of /proc/PID/status, in bytes."""
        text = pathlib.Path(f"/proc/{self.process.pid}/status").read_text(encoding="utf-8")
        return 1024 * int(re.search(rf"^{key}:\s+(\d+) kB", text, re.MULTILINE)[1])


def parent_of(document, path):
    """The object or list with the value of a JSON pointer, and its key there."""
    *way, last = [part.replace("~1", "/").replace("~0", "~") for part in path.split("/")[1:]]
    for part in way:
        document = document[int(part)] if isinstance(document, list) else document[part]
    return document, int(last) if isinstance(document, list) else last


def edited(document, ops):
    """The document after operations, as a page computes it."""
    document = copy.deepcopy(document)
    for op in ops:
        parent, key = parent_of(document, op["path"])
        if "after" not in op:
            del parent[key]
        elif "before" not in op and isinstance(parent, list):
            parent.insert(key, op["after"])
        else:
            parent[key] = op["after"]
    return document


class Tab:
    """A page: keeps the document as the server's messages describe it."""

    def __init__(self, address, **fields):
        self.socket = WebSocket(address, **fields)
        self.events = []  # all messages without id
        self.frames = []  # all binary messages
        self.seen = 0  # of the events
        self.last_id = 0
        self.history, self.problems = {"steps": []}, []
        self.project = self.next("project")
        self.number = self.project["tab"]

    def close(self):
        self.socket.close()

    def read(self):
        """Takes the next message; returns it if it is an answer."""
        kind, data = self.socket.receive()
        if kind != TEXT:
            self.frames.append(data)
            return None
        message = json.loads(data)
        if "id" in message:
            return message
        self.events.append(message)
        if message["event"] in ("project", "changed"):
            self.json = message["json"] if "json" in message else edited(self.json, message.get("ops", []))
            self.revision, self.locked = message["revision"], message["locked"]
            history = message["history"]
            earlier = self.history["steps"][: history["from"]]
            self.history = {"position": history["position"], "steps": earlier + history["steps"]}
            self.problems = message.get("problems", self.problems)
        return None

    def next(self, name):
        """The next event of this name after the one that was asked for last."""
        while True:
            while self.seen < len(self.events):
                self.seen += 1
                if self.events[self.seen - 1]["event"] == name:
                    return self.events[self.seen - 1]
            self.read()

    def reach(self, revision):
        while self.revision < revision:
            self.read()

    def send(self, do, **keys):
        self.last_id += 1
        self.socket.send(json.dumps({"id": self.last_id, "do": do, **keys}))

    def ask(self, do, **keys):
        """Sends a request; returns its answer. Events before it are read, too."""
        self.send(do, **keys)
        while True:
            answer = self.read()
            if answer is not None:
                assert answer["id"] == self.last_id, answer
                return answer

    def edit(self, *ops, label="Edit"):
        return self.ask("edit", label=label, ops=list(ops))

    def set(self, path, value, label="Edit"):
        parent, key = parent_of(self.json, path)
        return self.edit({"path": path, "before": parent[key], "after": value}, label=label)

    def changes(self):
        return [event for event in self.events if event["event"] == "changed"]


class ServeTest(ProgramTest):
    """A test with a folder `shop`, alone in an empty folder."""

    def setUp(self):
        super().setUp()
        self.scratch = self.folder
        self.folder = self.scratch / "shop"
        self.folder.mkdir()
        self.store = self.folder / "store.json"

    def write_store(self, content=STORE):
        """Replaces store.json, as an editor does."""
        self.write("new", content).rename(self.store)

    def serve(self, *options, folder=None, **process):
        server = Server(folder or self.folder, *options, **process)
        self.addCleanup(server.close)
        return server

    def refusal(self, *options, **process):
        """The only line that a server prints which does not start."""
        with self.assertRaises(NotStarted) as failure:
            self.serve(*options, **process)
        end = failure.exception.end
        self.assertEqual((end.status, end.out), (2, ""), end.err)
        self.assertRegex(end.err, r"\Aerror: [^\n]*\n\Z", options)
        return end.err

    def open(self, server, address=None, **fields):
        tab = Tab(address or server.address, **fields)
        self.addCleanup(tab.close)
        return tab

    def document(self):
        return without_comments(self.text("store.json"))

    def connect(self, address, name="", method="GET", **fields):
        """A connection on which the head of a request is sent; `name` is the rest of the address."""
        url = urllib.parse.urlsplit(address)
        connection = http.client.HTTPConnection(url.hostname, url.port, timeout=20)
        self.addCleanup(connection.close)
        connection.putrequest(method, url.path + name, skip_host=True)
        for field, value in {"Host": url.netloc, **fields}.items():
            connection.putheader(field, value)
        connection.endheaders()
        return connection

    def reply(self, *arguments, **fields):
        return self.connect(*arguments, **fields).getresponse()

    def put(self, server, name, body=b"", size=None, **fields):
        """A connection on which a page has sent a file of this size, or its beginning."""
        url = urllib.parse.urlsplit(server.address)
        head = {"Origin": f"http://{url.netloc}", "Content-Length": str(len(body) if size is None else size), **fields}
        connection = self.connect(server.address, f"files/{name}", "PUT", **head)
        connection.send(body)
        return connection
