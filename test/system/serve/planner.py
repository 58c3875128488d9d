"""A running `shelfbeam serve`, and its pages without a browser (docs/formats/planner.md)."""

import copy
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from websocket import TEXT, WebSocket

ROOT = pathlib.Path(__file__).parents[3]
PROGRAM = os.environ["SHELFBEAM"]

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
    def __init__(self, code, out, err):
        super().__init__(f"exit code {code}: {err}")
        self.code, self.out, self.err = code, out, err


def command(folder, *options, browser=False):
    return [PROGRAM, "serve", folder, *([] if browser else ["--no-browser"]), "--no-light", "--json", *options]


class Server:
    """`options` of `serve`, and of subprocess.Popen. `browser`: whether it may open one."""

    def __init__(self, folder, *options, browser=False, **process):
        self.process = subprocess.Popen(
            command(folder, *options, browser=browser),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            **process,
        )
        lines = []
        while lines[-1:] != ["}\n"]:
            lines.append(self.process.stdout.readline())
            if lines[-1]:
                continue
            out, err = self.process.communicate()
            if "has no page" in err and not os.environ.get("CI"):
                raise unittest.SkipTest(err)
            raise NotStarted(self.process.returncode, "".join(lines) + out, err)
        printed = json.loads("".join(lines))
        self.address, self.addresses = printed["address"], printed["addresses"]

    def kill(self):
        self.process.kill()
        self.wait()

    def end(self, signal_number):
        """Its exit code and messages after a signal."""
        self.process.send_signal(signal_number)
        return self.wait()

    def wait(self):
        _, err = self.process.communicate(timeout=30)
        return self.process.returncode, err

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


class ServeTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.scratch = pathlib.Path(scratch.name)
        self.folder = self.scratch / "shop"
        self.folder.mkdir()
        self.store = self.folder / "store.json"

    def write(self, content=STORE):
        """Replaces store.json, as an editor does."""
        new = self.folder / "new"
        new.write_text(content if isinstance(content, str) else json.dumps(content), encoding="utf-8")
        new.rename(self.store)

    def start(self, *options, folder=None, **process):
        server = Server(folder or self.folder, *options, **process)
        self.addCleanup(server.wait)
        self.addCleanup(server.process.kill)
        return server

    def open(self, server, address=None, **fields):
        tab = Tab(address or server.address, **fields)
        self.addCleanup(tab.close)
        return tab

    def document(self):
        return without_comments(self.store.read_text(encoding="utf-8"))
