"""The processor time of an edit in three stores, for each kind of value that people change, on an idle machine."""

import os
import pathlib
import re
import shutil
import time

from harness import ROOT
from planner import ServeTest

LIMITS = {"grocery": 10, "supermarket": 40, "hypermarket": 200}  # ms for an edit
EDITS = 30

# What people change, and the number of the store that stands for it.
CHANGES = {
    "place": r"/fixtures/\d+/at/0",
    "preset": r"/presets/[^/]+/(length|depth|height)",
    "material": r"/materials/[^/]+/(reflectance|ior|eta|roughness)",
    "label type": r"/label_types/.*",
    "room": r"/room/(size/2|height)",
}


def numbers_in(value, path=""):
    """The paths and values of all numbers of a document."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        yield path, value
    entries = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in entries:
        yield from numbers_in(inner, f"{path}/{key}")


def processor_time(process):
    """So far, in ms."""
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text(encoding="utf-8").split(") ")[1].split(" ")
    return 1000 * (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Edits(ServeTest):
    def times(self, name):
        """Processor time and time in ms for each kind of edit."""
        folder = shutil.copytree(ROOT / "examples" / name, self.scratch / name)
        server = self.serve(folder=folder)
        tab = self.open(server)
        # The search for warnings begins after each pause of 0.3 s; it is a process of its own.
        for kind, pattern in CHANGES.items():
            found = next(((path, one) for path, one in numbers_in(tab.json) if re.fullmatch(pattern, path)), None)
            if not found:
                continue
            path, first = found
            values = [first, first * 1.001] * EDITS
            cpu, begin = processor_time(server.process), time.monotonic()
            for before, after in zip(values, values[1 : EDITS + 1]):
                self.assertNotIn("error", tab.edit({"path": path, "before": before, "after": after}, label=kind))
            yield kind, (processor_time(server.process) - cpu) / EDITS, 1000 * (time.monotonic() - begin) / EDITS
        server.close()

    def test_need_little_time(self):
        for name, limit in LIMITS.items():
            for kind, cpu, wall in self.times(name):
                what = f"{name}: processor time of an edit, {kind} (on the disk after {wall:.0f} ms)"
                print(f"{what:76} {cpu:8.1f} ms  at most {limit} ms")
                with self.subTest(name=name, kind=kind):
                    self.assertLessEqual(cpu, limit)
