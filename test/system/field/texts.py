"""Text from other programs: byte order marks, UTF-16, line ends, null bytes, JSON as editors leave it."""

import json
import re
import shutil

from rows import INPUTS, Row, ends, equals, refuses, run

STORE = {
    "catalogues": ["chain.json"],
    "room": {"size": [6, 4, 3], "floor": "wall", "ceiling": "wall", "walls": "wall"},
    "label_types": {"shelf label": {"threshold": 0.001}},
    "transceiver_types": {
        "ies": {"emission": {"type": "ies", "file": "lamp.ies", "flux": 1}},
        "ldt": {"emission": {"type": "eulumdat", "file": "lamp.ldt", "flux": 1}},
    },
    "fixtures": [
        {"type": "gondola", "id": "A1", "at": [1, 2], "length": 4, "depth": 0.9, "height": 1.8}
        | {"material": "steel", "shelves": [0.4]}
    ],
    "labels": {"csv": "labels.csv"},
    "planogram": {"file": "planogram.csv", "type": "shelf label"},
    "transceivers": {"list": {"csv": "units.csv"}},
}
CHAIN = {"materials": {name: {"type": "lambertian", "reflectance": 0.6} for name in ("wall", "steel")}}
FILES = {
    "store.json": json.dumps(STORE, indent=1),
    "chain.json": json.dumps(CHAIN, indent=1),
    "labels.csv": "id,x,y,z,nx,ny,nz,type\nL1,3,2,0.01,0,0,1,shelf label\n",
    "units.csv": "id,x,y,z,ax,ay,az,roll_deg,type\nU1,3,2,2.9,0,0,-1,0,ies\nU2,2,2,2.9,0,0,-1,0,ldt\n",
    "planogram.csv": "article,fixture,face,level,position\nmilk,A1,front,1,1\n",
    "matrix.csv": "label,T1,T2\nA,0.5,0\nB,0.25,0.75\n",
    "costs.csv": "id,cost\nT1,2\n",
    "pairs.csv": "a,b\nT1,T2\n",
    "weights.csv": "id,weight\nA,2\n",
    "sparse.txt": "2 2 0.5\n1 0 2\n2 0 1 1 1\n",
    "rail.txt": "2 3\n1 1 1\n1 1 2\n3 2 1 2\n",
    "placement.json": "",
}
# The command that reads each file, and the commands that read them all.
READ_STORE = "inspect store.json"
VERIFY = "verify store.json placement.json --samples 256 --json"
VERIFY_UNITS = "verify store.json units.csv --samples 256 --json"
PLACE = "place matrix.csv --threshold 0.2 --costs costs.csv --forbid pairs.csv"
WEIGH = "place matrix.csv --threshold 0.2 --weights weights.csv --at-most 1"
COMMANDS = {
    **dict.fromkeys(("store.json", "chain.json", "labels.csv", "planogram.csv", "lamp.ies", "lamp.ldt"), READ_STORE),
    **dict.fromkeys(("matrix.csv", "costs.csv", "pairs.csv"), PLACE),
    "units.csv": VERIFY_UNITS,
    "placement.json": VERIFY,
    "weights.csv": WEIGH,
    "sparse.txt": "place sparse.txt",
    "rail.txt": "place rail.txt",
}


def write_files(folder, change=lambda text: text.encode("utf-8")):
    for lamp, source in (("lamp.ies", "planes_flow.ies"), ("lamp.ldt", "uplight.ldt")):
        FILES[lamp] = (INPUTS / source).read_text(encoding="utf-8")
    if not FILES["placement.json"]:
        write_to(folder, lambda text: text.encode("utf-8"))
        run("plan store.json -o plan --samples 256 --budget 1 --quiet", folder=folder)
        FILES["placement.json"] = (folder / "plan/placement.json").read_text(encoding="utf-8")
        shutil.rmtree(folder / "plan")
    write_to(folder, change)


def write_to(folder, change):
    for name, text in FILES.items():
        (folder / name).write_bytes(change(text))


def outputs(folder):
    """The output of every command without times."""
    ends = {command: run(command, folder=folder) for command in set(COMMANDS.values())}
    return {command: re.sub(r'"seconds": [^,]*|[\d.]+ s,', "", end.out) for command, end in ends.items() if not end.err}


def read_as_without(change):
    """The commands whose output differs from that for the files without the change, or that fail."""

    def measure(scratch):
        write_files(scratch)
        plain = outputs(scratch)
        write_files(scratch, change)
        changed = outputs(scratch)
        same = {command for command, text in plain.items() if text and text == changed.get(command)}
        return sorted(set(COMMANDS.values()) - same)

    return measure


def unnamed(encoding):
    """The files whose encoding is not named; tables of a store with a mark are read."""

    def measure(scratch):
        write_files(scratch)
        wrong = []
        for name, command in COMMANDS.items():
            text = FILES[name]
            (scratch / name).write_bytes(text.encode(encoding))
            end = run(command, folder=scratch)
            if encoding == "utf-16" and name in ("labels.csv", "planogram.csv"):
                is_right = succeeds(end)
            else:
                is_right = end.status == 2 and name in end.err and "is UTF-16; save it as UTF-8" in end.err
            if not is_right:
                wrong.append(f"{name}: {end}")
            (scratch / name).write_bytes(text.encode("utf-8"))
        return wrong

    return measure


def succeeds(end):
    return end.status == 0 and not end.err


NULL_EXPECTED = "the null byte is escaped, and the rest of the message follows"
ROWS = [
    Row(
        "utf16.json", "UTF-16 is named", ends("inspect utf16.json"), refuses("utf16.json: is UTF-16; save it as UTF-8")
    ),
    Row(
        "null_in_name_obj.json",
        NULL_EXPECTED,
        ends("inspect null_in_name_obj.json"),
        refuses("wh\\x00ite", "add an entry"),
    ),
    Row("comma_behind_last.json", "read", ends("inspect comma_behind_last.json"), succeeds),
    *(
        Row(name, "no command differs", read_as_without(change), equals([]), is_slow=True)
        for name, change in (
            ("marks in all texts", lambda text: text.encode("utf-8-sig")),
            ("lines that end with CR", lambda text: text.replace("\n", "\r").encode("utf-8")),
        )
    ),
    *(
        Row(f"all texts in {encoding}", "the encoding of every file is named", unnamed(encoding), equals([]), True)
        for encoding in ("utf-16", "utf-16-le", "utf-16-be")
    ),
]
