"""The HTML document: one self-contained file that is also well-formed XML."""

import csv
import io
import re
from pathlib import Path

from study.core.findings import AGREES, DIFFERS, OURS, PARTLY
from study.core.text import escape, listed, plural

STYLE = Path(__file__).with_name("page.css")


def table(header, rows, numeric=(), paper=(), wide=(), caption=""):
    """`numeric`, `paper` (muted) and `wide` (with line breaks) are column indices."""

    def classes(k):
        names = [name for name, places in (("n", numeric), ("paper", paper), ("w", wide)) if k in places]
        return f' class="{" ".join(names)}"' if names else ""

    head = "".join(f'<th scope="col"{classes(k)}>{escape(words)}</th>' for k, words in enumerate(header))
    body = "".join(
        "<tr>" + "".join(f"<td{classes(k)}>{escape(cell)}</td>" for k, cell in enumerate(row)) + "</tr>\n"
        for row in rows
    )
    title = f"<caption>{escape(caption)}</caption>" if caption else ""
    return f'<div class="scroll"><table>{title}<thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody></table></div>\n'


def figure(caption, content, note="", reference=""):
    small = f" <small>{escape(reference)}</small>" if reference else ""
    below = f'<p class="note">{escape(note)}</p>\n' if note else ""
    return f"<figure><figcaption>{escape(caption)}{small}</figcaption>\n{content}{below}</figure>\n"


def row_of(figures, css_class="pair"):
    return f'<div class="{css_class}">\n{"".join(figures)}</div>\n'


def small_maps(columns, css_class=""):
    """Maps in columns of two, each (heading, small words, picture); on narrow pages side by side."""
    cells = "".join(
        f"<div><h4>{escape(heading)} <small>{escape(words)}</small></h4>{picture}</div>\n"
        for column in columns
        for heading, words, picture in column
    )
    return f'<div class="maps {css_class}">\n{cells}</div>\n'


def paragraph(words, css_class=""):
    return f'<p class="{css_class}">{escape(words)}</p>\n' if css_class else f"<p>{escape(words)}</p>\n"


def details(summary, content):
    return f"<details><summary>{escape(summary)}</summary>\n{content}</details>\n"


def _pill(verdict):
    return f'<span class="v v-{verdict.replace(" ", "-")}">{escape(verdict)}</span>'


def _finding(finding):
    why = f'<p class="why">{escape(finding.why)}</p>\n' if finding.why else ""
    return (
        f'<div class="finding v-{finding.verdict.replace(" ", "-")}">{_pill(finding.verdict)}'
        f"<p>{escape(finding.sentence)}</p>\n{why}</div>\n"
    )


def _section(number, section):
    findings = "".join(map(_finding, section.findings))
    return (
        f'<section id="s{number}">\n<h2>{number}. {escape(section.title)} '
        f'<span class="ref">{escape(section.reference)}</span></h2>\n'
        f'<p class="question">{escape(section.question)}</p>\n{findings}{"".join(section.body)}</section>\n'
    )


def _overview(rows):
    """The table of all statements; on narrow pages each row becomes a block."""
    body = "".join(
        f'<tr><td>{where}</td><td class="w">{escape(claim)}</td><td class="w paper"'
        f' data-is="paper">{escape(theirs)}</td><td class="w"'
        f' data-is="here">{escape(ours)}</td><td>{pill}</td></tr>\n'
        for where, claim, theirs, ours, pill in rows
    )
    head = "".join(
        f'<th scope="col">{words}</th>' for words in ("section", "statement of the paper", "paper", "here", "")
    )
    return (
        '<div class="scroll"><table'
        f' class="overview"><thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody></table></div>\n'
    )


def summary_sentence(findings):
    """A sentence with the number of the paper's statements that hold here."""
    count = {verdict: sum(one.verdict == verdict for one in findings) for verdict in (AGREES, PARTLY, DIFFERS)}
    total = sum(count.values())
    parts = [f"{count[AGREES]} agree with our figures"]
    if count[PARTLY]:
        parts.append(f"{count[PARTLY]} {'agrees' if count[PARTLY] == 1 else 'agree'} in part")
    parts.append(f"{count[DIFFERS]} {'does' if count[DIFFERS] == 1 else 'do'} not")
    return f"{plural(total, 'statement')} of the paper can be examined here: {listed(parts)}."


def document(title, introduction, cards, sections, footer):
    findings = [(number, one) for number, section in enumerate(sections, 1) for one in section.findings]
    contents = "".join(
        f'<li><a href="#s{number}">{escape(section.title)}</a></li>\n' for number, section in enumerate(sections, 1)
    )
    shown = "".join(
        f'<div class="card"><dt>{escape(name)}</dt><dd>{escape(value)}<small>{escape(words)}</small></dd></div>\n'
        for name, value, words in cards
    )
    rows = [
        (f'<a href="#s{number}">{escape(one.reference)}</a>', one.claim, one.paper, one.ours, _pill(one.verdict))
        for number, one in findings
        if one.verdict != OURS
    ]
    overview = _overview(rows)
    body = "".join(_section(number, section) for number, section in enumerate(sections, 1))
    return (
        '<!DOCTYPE html>\n<html lang="en" xmlns="http://www.w3.org/1999/xhtml">\n<head>\n<meta'
        ' charset="utf-8"/>\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1"/>\n'
        f"<title>{escape(title)}</title>\n<style>\n{STYLE.read_text(encoding='utf-8')}</style>\n</head>\n<body>\n"
        '<main>\n<p class="kicker">shelfbeam ·'
        f" scripts/reproduce</p>\n<h1>{escape(title)}</h1>\n"
        f'<p class="answer">{escape(summary_sentence([one for _, one in findings]))}</p>\n'
        f'{introduction}<dl class="cards">\n{shown}</dl>\n'
        f"<section>\n<h2>Statements of the paper and our results</h2>\n{overview}</section>\n"
        '<nav aria-label="Sections"><h3>Sections, in the paper\'s'
        f" order</h3>\n<ol>\n{contents}</ol></nav>\n{body}"
        f"<footer>{footer}</footer>\n</main>\n</body>\n</html>\n"
    )


def csv_text(header, rows):
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(
        [[f"{cell:.9g}" if isinstance(cell, float) else re.sub(r"\s+", " ", str(cell)) for cell in row] for row in rows]
    )
    return text.getvalue()
