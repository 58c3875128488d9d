"""Usage: dxf_corpus.py FOLDER

Writes DXF files, and expected.json with what ezdxf (0.18 or later) says about each: the length and the bounds of the
lines of each layer, the texts, the unit, or the code of the error.
"""

import json
import pathlib
import sys

import ezdxf
from dxf import by_ezdxf, by_hand
from dxf.facts import facts


class Corpus:
    def __init__(self, folder):
        folder.mkdir(parents=True, exist_ok=True)
        self.folder = folder
        self.expected = {}

    def save(self, doc, name, unit=None, kind="asc", **more):
        """Writes a drawing of ezdxf, and expects what ezdxf reads of it."""
        doc.saveas(self.folder / name, fmt=kind)
        self.expected[name] = facts(ezdxf.readfile(self.folder / name), unit, **more)

    def write(self, name, content, **facts_or_error):
        (self.folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        self.expected[name] = facts_or_error


corpus = Corpus(pathlib.Path(sys.argv[1]))
for module in (by_ezdxf, by_hand):
    for name, function in list(vars(module).items()):
        if name.startswith("write_"):
            function(corpus)
(corpus.folder / "expected.json").write_text(json.dumps(corpus.expected))
print(len(corpus.expected), "files by ezdxf", ezdxf.__version__)
