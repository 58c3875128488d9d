"""Names in mounting.dxf that CAD programs would take for codes, and the unit of the drawing."""

import json
import re

from rows import INPUTS, Row, expect_success, run

IDS = ["Ü1", "Ö1", "\\U+00DC1", "at 45%%d", "50%", "a^J", "%%c%%c", "😀", "?1"]


def pairs(text):
    lines = text.rstrip("\n").split("\n")
    return list(zip(map(int, lines[0::2]), lines[1::2]))


def drawn(scratch):
    """The drawing of a plan in which units of these ids are mounted."""
    store = json.loads((INPUTS / "plain_store.json").read_text(encoding="utf-8"))
    store["transceivers"]["list"] = [
        {"id": name, "position": [0.5 + 0.5 * k, 2, 2.9], "type": "unit"} for k, name in enumerate(IDS)
    ]
    store["transceivers"]["installed"] = IDS
    (scratch / "store.json").write_text(json.dumps(store), encoding="utf-8")
    expect_success(run("plan", "store.json", "-o", "plan", "--samples", "256", "--budget", "1", folder=scratch))
    return pairs((scratch / "plan/mounting.dxf").read_bytes().decode("ascii"))


def shown(text):
    """A text as CAD programs show it, whether they read letters or codes first."""
    if re.search(r"\^[^ ]", text):
        raise RuntimeError(f"{text} has a code")
    text = re.sub(r"\\U\+([0-9A-F]{4})", lambda code: chr(int(code[1], 16)), text.replace("^ ", "^"))
    if "%%" in text:
        raise RuntimeError(f"{text} has a code")
    return text.encode("utf-16-le", "surrogatepass").decode("utf-16-le").replace("\u200b", "")


def ids(scratch):
    groups = drawn(scratch)
    values = [
        shown(before[1])
        for before, after in zip(groups, groups[1:])
        if before[0] == 1 and after == (2, "ID") and before[1]
    ]
    return sorted(values)


def notes(scratch):
    groups = drawn(scratch)
    begin = groups.index((0, "TEXT"))
    return next(value for code, value in groups[begin:] if code == 1)


ROWS = [
    Row("ids in mounting.dxf", "as in the store", ids, lambda found: found == sorted(IDS)),
    Row("unit of mounting.dxf", "metres", notes, lambda text: "1 drawing unit = 1 m" in text),
]
