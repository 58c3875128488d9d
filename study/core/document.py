"""Writes the document, with its sections in the paper's order, and the CSV files."""

import time

from study.core import page, paper
from study.core.findings import OURS
from study.core.program import say, write_text
from study.core.text import escape, grouped
from study.sections import (
    certificate,
    coarse_grid,
    cooperative,
    cut_off,
    environment,
    excess,
    firmness,
    greedy,
    matrix_histogram,
    measurements,
    non_cooperative,
    occlusion,
    redundancy,
    reuse,
    sample_count,
    solver_time,
    sparsity,
    symmetry,
)

SECTIONS = (
    environment.section,
    measurements.section,
    symmetry.section,
    sample_count.section,
    occlusion.section,
    non_cooperative.section,
    greedy.section,
    cooperative.section,
    redundancy.section,
    excess.section,
    solver_time.section,
    cut_off.section,
    sparsity.section,
    matrix_histogram.section,
    coarse_grid.section,
    firmness.section,
    reuse.section,
)


def _cards(study):
    reference = study.reference
    last = study.most_samples
    coop = study.table_answer(last, "cooperative", "count")
    alone = study.table_answer(last, "non-cooperative", "count")
    return [
        (
            "labels and candidates",
            f"{len(reference.labels)} × {len(reference.units)}",
            "ours; the paper says a few hundred",
        ),
        ("samples per label", f"{grouped(study.effort.samples[0])} – {grouped(last)}", "the paper's estimator"),
        ("cooperative", coop.units, f"transceivers at {grouped(last)} samples; paper {paper.COOPERATIVE[last][0]}"),
        ("non-cooperative", alone.units, f"transceivers; paper {paper.OPTIMAL[last][0][0]}"),
        ("threshold", f"{reference.requirement[0]:g}", "W/m², fixed beforehand"),
    ]


def write(study, is_quick):
    """Computes all missing results and writes all files; returns the path of the document."""
    begun = time.monotonic()
    study.make_tables()
    sections = []
    makers = [*SECTIONS, *([certificate.section] if certificate.is_there(study) else [])]
    for number, make in enumerate(makers, 1):
        say(f"section {number} of {len(makers)}: {make.__module__.split('.')[-1].replace('_', ' ')}")
        sections.append(make(study))

    for section in sections:
        for name, (header, rows) in section.tables.items():
            write_text(study.folder / f"{name}.csv", page.csv_text(header, rows))
    findings = [
        (number, one.reference, one.claim, one.paper, one.ours, one.verdict, one.sentence, one.why)
        for number, section in enumerate(sections, 1)
        for one in section.findings
    ]
    write_text(
        study.folder / "findings.csv",
        page.csv_text(("section", "reference", "claim", "paper", "ours", "verdict", "sentence", "why"), findings),
    )
    introduction = page.paragraph(
        "This page repeats the study of ‘Optimal Transceiver Placement in Retail Environments: A Path Tracing"
        " Approach’ on our version of its test environment with its"
        f" estimator{' (quick: fewer samples and solver runs than the full study)' if is_quick else ''}."
        " Every number and every judgement is computed from the files beside this page."
    )
    introduction += page.paragraph(
        (
            "The paper gives no dimensions of its environment and no strength of its devices, so its counts of"
            " transceivers may differ from ours. Trends, shares and statements can be compared."
        ),
        "note",
    )
    summary = study.simulation(study.uniform_file(study.effort.samples[0]))
    footer = (
        f"shelfbeam {escape(study.program.version())} · estimators"
        f" ‘{escape(study.uniform(study.most_samples).estimator)}’ and ‘{escape(study.reference.estimator)}’"
        f" · {grouped(round(summary['rays_per_second']))} rays per second · time limit"
        f" {study.effort.time_limit:g} s per solver run"
    )
    html = page.document("Reproduction of the paper’s study", introduction, _cards(study), sections, footer)
    path = study.folder / "study.html"
    write_text(path, html)
    judged = [one for section in sections for one in section.findings if one.verdict != OURS]
    say(f"{page.summary_sentence(judged)} {time.monotonic() - begun:.0f} s, {study.program.runs} runs of the program")
    return path
