"""Names in mounting.dxf that CAD programs would take for codes, and the unit of the drawing."""

import re

from rows import Row, input_store, output, write_store

IDS = ["Ü1", "Ö1", "\\U+00DC1", "at 45%%d", "50%", "a^J", "%%c%%c", "😀", "?1"]


def drawn(scratch):
    """The (code, value) pairs of the drawing of a plan in which units of these ids are mounted."""
    store = input_store("plain_store.json")
    store["transceivers"] = {
        "list": [{"id": name, "position": [0.5 + 0.5 * k, 2, 2.9], "type": "unit"} for k, name in enumerate(IDS)],
        "installed": IDS,
    }
    output("plan", write_store(scratch, store), *"-o plan --samples 256 --no-certificate".split(), folder=scratch)
    lines = (scratch / "plan/mounting.dxf").read_text(encoding="ascii").rstrip("\n").split("\n")
    return list(zip(map(int, lines[0::2]), lines[1::2]))


def shown(text):
    """A text as CAD programs show it, whether they read letters or codes first."""
    if re.search(r"\^[^ ]", text):
        raise RuntimeError(f"{text} has a code")
    text = re.sub(r"\\U\+([0-9A-F]{4})", lambda code: chr(int(code[1], 16)), text.replace("^ ", "^"))
    if "%%" in text:
        raise RuntimeError(f"{text} has a code")
    return text.encode("utf-16-le", "surrogatepass").decode("utf-16-le").replace("\u200b", "")


def ids_and_note(scratch):
    groups = drawn(scratch)
    values = [before[1] for before, after in zip(groups, groups[1:]) if before[0] == 1 and after == (2, "ID")]
    begin = groups.index((0, "TEXT"))
    note = next(value for code, value in groups[begin:] if code == 1)
    return sorted(shown(value) for value in values if value), note


ROWS = [
    Row(
        "mounting.dxf",
        "ids as in the store, unit metres",
        ids_and_note,
        lambda found: found[0] == sorted(IDS) and "1 drawing unit = 1 m" in found[1],
    )
]
