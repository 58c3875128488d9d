"""The findings of a section: a statement of the paper, our figures for it, and whether they agree."""

from dataclasses import dataclass, field

AGREES, PARTLY, DIFFERS, OURS = "agrees", "in part", "differs", "ours"


@dataclass(frozen=True)
class Finding:
    """`paper` and `ours` are short enough for a table column; `sentence` states the finding in words."""

    reference: str  # section, table or figure of the paper
    claim: str  # in our words
    paper: str
    ours: str
    verdict: str
    sentence: str
    why: str = ""


@dataclass
class Section:
    title: str
    reference: str
    question: str
    body: list = field(default_factory=list)  # pieces of HTML
    findings: list = field(default_factory=list)
    tables: dict = field(default_factory=dict)  # CSV files: name -> (header, rows)

    def add(self, *pieces):
        self.body.extend(pieces)

    def find(self, claim, paper, ours, verdict, sentence, why="", reference=None):
        self.findings.append(Finding(reference or self.reference, claim, paper, ours, verdict, sentence, why))

    def tell(self, sentence, why=""):
        """Adds a finding on which the paper makes no statement."""
        self.findings.append(Finding(self.reference, "", "", "", OURS, sentence, why))


def verdict(holds, holds_in_part=False):
    return AGREES if holds else PARTLY if holds_in_part else DIFFERS
