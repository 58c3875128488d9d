"""Small inputs that ask for very much work: done in proportion to their size, or refused by a documented limit."""

import json
import os
import signal
import statistics
import subprocess
import time
from dataclasses import dataclass

import rows
from rows import Row

MEMORY = 100  # MB
SECONDS = 2  # of processor time; tests accept the double, because a busy machine has slower cores


@dataclass(frozen=True)
class Effort:
    """The end of a run, and what it took."""

    end: rows.Run
    seconds: float  # of processor time
    megabytes: float

    def __str__(self):
        return f"{self.seconds:.2f} s, {self.megabytes:.0f} MB, {self.end}"

    def is_small(self):
        return self.seconds < 2 * SECONDS and self.megabytes < MEMORY


def effort(*arguments, folder):
    out, err = folder / "out", folder / "err"
    with open(out, "wb") as stdout, open(err, "wb") as stderr:
        process = subprocess.Popen([rows.PROGRAM, *map(str, arguments)], cwd=folder, stdout=stdout, stderr=stderr)
        _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    texts = (path.read_text(encoding="utf-8", errors="backslashreplace") for path in (out, err))
    return Effort(rows.Run(process.returncode, *texts), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)


def small_room(**changes):
    with open(rows.INPUTS / "small_room.json", encoding="utf-8") as file:
        store = json.load(file)
    for key, value in changes.items():
        if isinstance(store.get(key), dict):
            store[key].update(value)
        else:
            store[key] = value
    return store


def inspected(store, *arguments):
    """Measures `inspect` of a store, which is a function of nothing, so that it is made only when needed."""

    def measure(scratch):
        (scratch / "store.json").write_text(json.dumps(store()), encoding="utf-8")
        return effort("inspect", "store.json", *arguments, folder=scratch)

    return measure


def file_of(name):
    def store():
        with open(rows.INPUTS / name, encoding="utf-8") as file:
            return json.load(file)

    return store


def strips(count, width, **room):
    """Zones side by side."""
    x = [100 * k / count for k in range(count)]
    zones = [
        {"id": f"z{k}", "polygon": [[a, 0], [a + width, 0], [a + width, 50], [a, 50]], "height": 2.9}
        for k, a in enumerate(x)
    ]
    return small_room(room={"size": [100, 60, 3], "zones": zones, **room})


def walls(count):
    return [{"id": f"W{k}", "from": [0, 1 + k], "to": [100, 1 + k]} for k in range(count)]


def copies(kind, count, labels, **keys):
    """A fixture with labels at its places, and its copies."""
    places = [{"id": str(k), "position": [0, 0, 0.6], "normal": [0, -1, 0], "type": "l"} for k in range(labels)]
    return small_room(
        fixtures=[
            {
                "type": kind,
                "id": "t{n}",
                "at": [1, 1, 0],
                "labels": places,
                "repeat": {"count": count, "step": [0.0001, 0]},
                **keys,
            }
        ]
    )


def piece():
    return {"name": "p", "material": "w", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "faces": [[0, 1, 2]]}


def people(number, size, area="room"):
    return small_room(variation={"people": [{"area": area, "number": number, "size": size, "material": "w"}]})


def cabinets(characters):
    """Cabinets with long ids, and a pattern that nearly matches them."""
    cabinet = {
        "type": "gondola",
        "at": [1, 1],
        "length": 1,
        "depth": 0.5,
        "height": 1,
        "material": "w",
        "shelves": [0.4],
        "faces": ["front"],
        "doors": "w",
        "id": "a" * characters,
    }
    return small_room(
        fixtures=[cabinet],
        labels=small_room()["labels"],
        variation={"doors": [{"fixtures": "*" + "a" * (characters // 2) + "b*", "open": 0.1}]},
    )


def refused(*words):
    is_refused = rows.refuses(*words)
    return lambda result: result.is_small() and is_refused(result.end)


def done(result):
    return result.is_small() and result.end.status == 0


def states_of(*arguments):
    """The ends of `inspect` or `simulate` with several numbers of a state."""

    def measure(scratch):
        return [
            rows.run(*arguments, "--state", text, "-o", scratch / "out.json", folder=rows.INPUTS)
            for text in ("-1", "99999999999999999999", "", "1.5")
        ]

    return measure


def are_refused(ends):
    return all(end.status == 2 and "--state" in end.err and "whole number" in end.err for end in ends)


def seconds_of(process):
    """The processor time of a running process."""
    with open(f"/proc/{process.pid}/stat", encoding="utf-8") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def seconds_after_interrupt(store, *arguments):
    """The processor time between an interrupt and the end of a run that draws or reads for long."""

    def measure(scratch):
        (scratch / "store.json").write_text(json.dumps(store()), encoding="utf-8")
        process = subprocess.Popen(
            [rows.PROGRAM, *arguments], cwd=scratch, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        while process.poll() is None and seconds_of(process) < 0.7:
            time.sleep(0.02)
        before = seconds_of(process)
        process.send_signal(signal.SIGINT)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 3:
            raise RuntimeError(f"exit {process.returncode}")
        return usage.ru_utime + usage.ru_stime - before

    return measure


def many_labels():
    places = [[0.5 + 0.0001 * k, 1.02, 0.9] for k in range(10000)]
    return small_room(
        labels=[{"id": str(k), "position": p, "normal": [0, 1, 0], "type": "l"} for k, p in enumerate(places * 12)]
    )


def mean_beside_wall(scratch):
    """The mean deviation from a wall 3 cm away, m, of 25 states of 40 units, and whether none is behind it."""
    units = [{"id": f"u{k}", "type": "t", "position": [0.03, 0.5 + 0.05 * k, 2.9]} for k in range(40)]
    store = small_room(transceivers={"list": units, "grids": []}, variation={"mounting": {"position": 0.05}})
    (scratch / "store.json").write_text(json.dumps(store), encoding="utf-8")
    found = []
    for state in range(25):
        rows.expect_success(
            rows.run("inspect", "store.json", "--state", state, "-o", "s.json", "--quiet", folder=scratch)
        )
        drawn = json.loads((scratch / "s.json").read_text(encoding="utf-8"))
        found += [unit["position"][0] - 0.03 for unit in drawn["transceivers"]["list"]]
    if not all(abs(x) <= 0.03 for x in found):
        raise RuntimeError("a unit moved farther than the wall")
    return statistics.fmean(found)


def warnings(store):
    def measure(scratch):
        (scratch / "store.json").write_text(json.dumps(store()), encoding="utf-8")
        end = rows.expect_success(rows.run("inspect", "store.json", folder=scratch))
        return [line for line in end.out.splitlines() if line.startswith("warning")]

    return measure


def gondola(**keys):
    return {
        "type": "gondola",
        "id": "A",
        "at": [1, 1],
        "length": 2,
        "depth": 0.9,
        "height": 1.8,
        "material": "w",
        "shelves": [0.4, 0.9],
        "labels": {"type": "l", "spacing": 0.3},
        **keys,
    }


def hall(*fixtures):
    """A hall of 3 m with a part of 6 m."""
    high = {"id": "high", "polygon": [[15, 6], [20, 6], [20, 12], [15, 12]], "height": 6}
    return small_room(room={"size": [20, 12, 3], "zones": [high]}, fixtures=list(fixtures), labels=[])


ROWS = [
    Row(
        "people_do_not_fit",
        "below 2 s",
        inspected(file_of("people_do_not_fit.json"), "--state", "0", "-o", "s.json"),
        done,
        is_slow=True,
    ),
    Row(
        "180 people in a small area",
        "below 2 s",
        inspected(lambda: people(180, [0.5, 0.3, 1.75], [[2, 1.5], [4, 1.5], [4, 3], [2, 3]]), "--state", "0"),
        done,
    ),
    Row(
        "6,000 people",
        "refused",
        inspected(
            lambda: small_room(
                variation={
                    "people": [
                        {"id": str(k), "area": "room", "number": 1000, "size": [0.5, 0.3, 1.75], "material": "w"}
                        for k in range(6)
                    ]
                }
            )
        ),
        refused("variation.people[5].number", "at most 5000"),
    ),
    Row(
        "box_labels_times_copies",
        "refused with the key",
        inspected(lambda: copies("box", 10000, 300, size=[0.5, 0.5, 0.5], material="w")),
        refused("fixtures[0].labels: produces 3000000 labels"),
    ),
    Row(
        "labels of a mesh times copies",
        "refused with the key",
        inspected(lambda: copies("mesh", 10000, 300, parts=[piece()])),
        refused("fixtures[0].labels: produces 3000000 labels"),
    ),
    Row(
        "labels of a gondola times copies",
        "refused with the key",
        inspected(
            lambda: small_room(
                fixtures=[gondola(id="A{n}", labels={"type": "l", "count": 1000}, repeat={"count": 10000, "step": 0})]
            )
        ),
        refused("fixtures[0].labels: produces 40000000 labels"),
    ),
    Row("thousand_zones", "below 2 s and 100 MB", inspected(lambda: strips(1000, 0.08)), done, is_slow=True),
    Row(
        "zones and inner walls",
        "refused",
        inspected(lambda: strips(1000, 0.08, inner_walls=walls(40))),
        refused("room: has edges that meet in more than 20,000 points"),
        is_slow=True,
    ),
    Row(
        "zones and long openings",
        "refused",
        inspected(
            lambda: strips(
                1000,
                0.08,
                inner_walls=[
                    {
                        **wall,
                        "openings": [
                            {"at": 1, "width": 98, "bottom": 0.02 * k, "top": 0.02 * k + 0.01} for k in range(9)
                        ],
                    }
                    for wall in walls(9)
                ],
            )
        ),
        refused("room.inner_walls[0].openings[5]", "is one of too many"),
        is_slow=True,
    ),
    Row(
        "presets times fixtures",
        "refused",
        inspected(
            lambda: small_room(
                presets={"p": {"type": "mesh", "at": [1, 1, 0], "parts": [piece()] * 1000}},
                fixtures=[{"preset": "p", "id": str(k)} for k in range(500)],
            )
        ),
        refused(".preset: takes more than 5,000,000 values from presets"),
    ),
    Row(
        "keys of presets times fixtures",
        "refused",
        inspected(
            lambda: small_room(
                presets={
                    "p": {
                        "type": "mesh",
                        "at": [1, 1, 0],
                        "file": "none.obj",
                        "materials": {str(k): "w" for k in range(10_000)},
                    }
                },
                fixtures=[{"preset": "p", "id": str(k)} for k in range(100)],
            )
        ),
        refused("'none.obj' does not exist"),
    ),
    Row(
        "pattern against a long id",
        "refused",
        inspected(lambda: cabinets(50_000)),
        refused("variation.doors", "at most 100,000,000"),
    ),
    Row("inspect --state -1, too large, empty", "refused", states_of("inspect", "people_do_not_fit.json"), are_refused),
    Row(
        "simulate --state -1, too large, empty", "refused", states_of("simulate", "people_do_not_fit.json"), are_refused
    ),
    Row(
        "interrupt while a store is read",
        "0.3 s",
        seconds_after_interrupt(many_labels, "plan", "store.json", "-o", "p"),
        lambda s: s < 0.6,
        is_slow=True,
    ),
    Row(
        "interrupt while states are drawn",
        "0.3 s",
        seconds_after_interrupt(
            lambda: people(1000, [14, 13, 1.7]), "simulate", "store.json", "--states", "1000", "-o", "s.h5"
        ),
        lambda s: s < 0.6,
        is_slow=True,
    ),
    Row("units 3 cm from a wall, mean", "0 +- 0.003 m", mean_beside_wall, rows.between(-0.003, 0.003), is_slow=True),
    Row(
        "shelves around a column below a low ceiling",
        "no warning",
        warnings(
            lambda: hall(
                gondola(),
                {"type": "cylinder", "id": "C", "at": [2, 1.4], "radius": 0.2, "top": "ceiling", "material": "w"},
            )
        ),
        lambda found: not found,
    ),
    Row(
        "copies that overlap",
        "each by its id",
        warnings(lambda: hall(gondola(id="A{n}", repeat={"count": 3, "step": 1.7}))),
        lambda found: (
            len(found) == 2
            and all(f"fixtures[0] (copy '{name}'): fixture '{name}'" in line for name, line in zip(("A2", "A3"), found))
        ),
    ),
]
