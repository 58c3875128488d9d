"""Small inputs that ask for very much work: done in proportion to their size, or refused by a documented limit."""

import json
import os
import resource
import statistics
from dataclasses import dataclass
from functools import partial

from harness import Process, Run
from rows import Row, between, input_store, output, refuses, run, write_store

MEMORY = 100  # MB
SECONDS = 2  # of processor time; tests accept the double, because a busy machine has slower cores


@dataclass(frozen=True)
class Effort:
    """The end of a run, and what it took."""

    end: Run
    seconds: float  # of processor time
    megabytes: float

    def __str__(self):
        return f"{self.seconds:.2f} s, {self.megabytes:.0f} MB, {self.end}"

    def is_small(self):
        return self.seconds < 2 * SECONDS and self.megabytes < MEMORY


def effort(line, folder):
    process = Process(line, folder=folder)
    _, status, usage = os.wait4(process.process.pid, 0)
    process.process.returncode = os.waitstatus_to_exitcode(status)
    end = process.wait()
    process.close()
    return Effort(end, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)


def small_room(**changes):
    store = input_store("small_room.json")
    for key, value in changes.items():
        if isinstance(store.get(key), dict):
            store[key].update(value)
        else:
            store[key] = value
    return store


def inspected(store, options=""):
    """Measures `inspect` of a store, which is a function of nothing, so that it is made only when needed."""
    return lambda scratch: effort(f"inspect {write_store(scratch, store())} {options}", scratch)


def box(x, width, depth):
    return [[x, 0], [x + width, 0], [x + width, depth], [x, depth]]


def strips(count, width, **room):
    """Zones side by side."""
    zones = [{"id": f"z{k}", "polygon": box(100 * k / count, width, 50), "height": 2.9} for k in range(count)]
    return small_room(room={"size": [100, 60, 3], "zones": zones, **room})


def walls(count, **keys):
    return [{"id": f"W{k}", "from": [0, 1 + k], "to": [100, 1 + k], **keys} for k in range(count)]


def windows(count):
    """Openings as long as a wall, one above the other."""
    return [{"at": 1, "width": 98, "bottom": 0.02 * k, "top": 0.02 * k + 0.01} for k in range(count)]


def copies(kind, count, labels, **keys):
    """A fixture with labels at its places, and its copies."""
    places = [{"id": str(k), "position": [0, 0, 0.6], "normal": [0, -1, 0], "type": "l"} for k in range(labels)]
    repeat = {"count": count, "step": [0.0001, 0]}
    fixture = {"type": kind, "id": "t{n}", "at": [1, 1, 0], "labels": places, "repeat": repeat}
    return small_room(fixtures=[{**fixture, **keys}])


def preset_store(count, **preset):
    """Fixtures of one preset, a mesh."""
    presets = {"p": {"type": "mesh", "at": [1, 1, 0], **preset}}
    return small_room(presets=presets, fixtures=[{"preset": "p", "id": str(k)} for k in range(count)])


PIECE = {"name": "p", "material": "w", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "faces": [[0, 1, 2]]}
KEYS = {"file": "none.obj", "materials": {str(k): "w" for k in range(10_000)}}


def people(number, size, area="room", times=1):
    one = {"area": area, "number": number, "size": size, "material": "w"}
    return small_room(variation={"people": [{**one, "id": str(k)} for k in range(times)] if times > 1 else [one]})


def gondola(**keys):
    return {
        **{"type": "gondola", "id": "A", "at": [1, 1], "length": 2, "depth": 0.9, "height": 1.8, "material": "w"},
        **{"shelves": [0.4, 0.9], "labels": {"type": "l", "spacing": 0.3}, **keys},
    }


def cabinets(characters):
    """Cabinets with long ids, and a pattern that nearly matches them."""
    cabinet = gondola(id="a" * characters, faces=["front"], doors="w")
    del cabinet["labels"]
    doors = [{"fixtures": "*" + "a" * (characters // 2) + "b*", "open": 0.1}]
    return small_room(fixtures=[cabinet], labels=small_room()["labels"], variation={"doors": doors})


def refused(*words):
    is_refused = refuses(*words)
    return lambda result: result.is_small() and is_refused(result.end)


def done(result):
    return result.is_small() and result.end.status == 0


def states_of(verb):
    """Measures the ends of a verb with several numbers of a state."""
    texts = ("-1", "99999999999999999999", "''", "1.5")
    return lambda scratch: [
        run(f"{verb} people_do_not_fit.json --state {text} -o {scratch}/out.json") for text in texts
    ]


def are_refused(ends):
    return all(end.status == 2 and "--state" in end.err and "whole number" in end.err for end in ends)


def seconds_of(process):
    """The processor time of a running process."""
    with open(f"/proc/{process.pid}/stat", encoding="utf-8") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def seconds_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def seconds_after_interrupt(store, line):
    """The processor time between an interrupt and the end of a run that draws or reads for long."""

    def measure(scratch):
        write_store(scratch, store())
        begun = seconds_of_children()
        process = Process(line, folder=scratch)
        process.wait_until(lambda: seconds_of(process.process) >= 0.7)
        before = seconds_of(process.process)
        end = process.end()
        process.close()
        if end.status != 3:
            raise RuntimeError(str(end))
        return seconds_of_children() - begun - before

    return measure


def many_labels():
    places = [[0.5 + 0.0001 * k, 1.02, 0.9] for k in range(10000)] * 12
    return small_room(
        labels=[{"id": str(k), "position": p, "normal": [0, 1, 0], "type": "l"} for k, p in enumerate(places)]
    )


def mean_beside_wall(scratch):
    """The mean deviation from a wall 3 cm away, m, of 25 states of 40 units, and whether none is behind it."""
    units = [{"id": f"u{k}", "type": "t", "position": [0.03, 0.5 + 0.05 * k, 2.9]} for k in range(40)]
    write_store(
        scratch, small_room(transceivers={"list": units, "grids": []}, variation={"mounting": {"position": 0.05}})
    )
    found = []
    for state in range(25):
        output(f"inspect store.json --state {state} -o s.json --quiet", folder=scratch)
        drawn = json.loads((scratch / "s.json").read_text(encoding="utf-8"))
        found += [unit["position"][0] - 0.03 for unit in drawn["transceivers"]["list"]]
    if not all(abs(x) <= 0.03 for x in found):
        raise RuntimeError("a unit moved farther than the wall")
    return statistics.fmean(found)


def warnings(*fixtures):
    """Measures the warnings about fixtures in a hall of 3 m with a part of 6 m."""

    def measure(scratch):
        high = {"id": "high", "polygon": [[15, 6], [20, 6], [20, 12], [15, 12]], "height": 6}
        store = small_room(room={"size": [20, 12, 3], "zones": [high]}, fixtures=fixtures, labels=[])
        lines = output("inspect", write_store(scratch, store), folder=scratch).splitlines()
        return [line for line in lines if line.startswith("warning")]

    return measure


def name_copies(found):
    """Whether the warnings name the second and the third copy."""
    starts = [f"fixtures[0] (copy '{name}'): fixture '{name}'" for name in ("A2", "A3")]
    return len(found) == 2 and all(start in line for start, line in zip(starts, found))


def refused_rows(*table, is_slow=False):
    return [Row(name, "refused", inspected(store), refused(*words), is_slow) for name, store, *words in table]


PERSON = [0.5, 0.3, 1.75]
AREA = [[2, 1.5], [4, 1.5], [4, 3], [2, 3]]
NOT_FITTING = partial(input_store, "people_do_not_fit.json")
COLUMN = {"type": "cylinder", "id": "C", "at": [2, 1.4], "radius": 0.2, "top": "ceiling", "material": "w"}
BOX = {"size": [0.5, 0.5, 0.5], "material": "w"}
SHELVES = gondola(id="A{n}", labels={"type": "l", "count": 1000}, repeat={"count": 10000, "step": 0})

ROWS = [
    Row("people_do_not_fit", "below 2 s", inspected(NOT_FITTING, "--state 0 -o s.json"), done, is_slow=True),
    Row("180 people in a small area", "below 2 s", inspected(lambda: people(180, PERSON, AREA), "--state 0"), done),
    *refused_rows(
        ("6,000 people", lambda: people(1000, PERSON, times=6), "variation.people[5].number", "at most 5000"),
        (
            "box_labels_times_copies",
            lambda: copies("box", 10000, 300, **BOX),
            "fixtures[0].labels: produces 3000000 labels",
        ),
        (
            "labels of a mesh times copies",
            lambda: copies("mesh", 10000, 300, parts=[PIECE]),
            "fixtures[0].labels: produces 3000000 labels",
        ),
        (
            "labels of a gondola times copies",
            lambda: small_room(fixtures=[SHELVES]),
            "fixtures[0].labels: produces 40000000 labels",
        ),
        (
            "presets times fixtures",
            lambda: preset_store(500, parts=[PIECE] * 1000),
            ".preset: takes more than 5,000,000 values from presets",
        ),
        ("pattern against a long id", lambda: cabinets(50_000), "variation.doors", "at most 100,000,000"),
    ),
    *refused_rows(
        ("keys of presets times fixtures", lambda: preset_store(50, **KEYS), "'none.obj' does not exist"),
        (
            "zones and inner walls",
            lambda: strips(1000, 0.08, inner_walls=walls(40)),
            "room: has edges that meet in more than 20,000 points",
        ),
        (
            "zones and long openings",
            lambda: strips(1000, 0.08, inner_walls=walls(9, openings=windows(9))),
            "room.inner_walls[0].openings[5]",
            "is one of too many",
        ),
        is_slow=True,
    ),
    Row("thousand_zones", "below 2 s and 100 MB", inspected(lambda: strips(1000, 0.08)), done, is_slow=True),
    *(
        Row(f"{verb} --state -1, too large, empty", "refused", states_of(verb), are_refused)
        for verb in ("inspect", "simulate")
    ),
    Row(
        "interrupt while a store is read",
        "0.3 s",
        seconds_after_interrupt(many_labels, "plan store.json -o p"),
        between(-0.1, 0.6),
        is_slow=True,
    ),
    Row(
        "interrupt while states are drawn",
        "0.3 s",
        seconds_after_interrupt(lambda: people(1000, [14, 13, 1.7]), "simulate store.json --states 1000 -o s.h5"),
        between(-0.1, 0.6),
        is_slow=True,
    ),
    Row("units 3 cm from a wall, mean", "0 +- 0.003 m", mean_beside_wall, between(-0.003, 0.003), is_slow=True),
    Row(
        "shelves around a column below a low ceiling",
        "no warning",
        warnings(gondola(), COLUMN),
        lambda found: not found,
    ),
    Row(
        "copies that overlap",
        "each by its id",
        warnings(gondola(id="A{n}", repeat={"count": 3, "step": 1.7})),
        name_copies,
    ),
]
