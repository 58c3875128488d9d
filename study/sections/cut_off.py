"""Solver time against a cut-off of small signals: 3.5.4."""

import numpy as np

from study.core import page, paper
from study.core.coverage import missed
from study.core.findings import Section, verdict
from study.core.signals import write_variant
from study.core.text import grouped, percent, spread
from study.sections.solver_time import time_chart, time_words, timed


def cut_file(study, samples, cut):
    """The matrix with entries below a share of the requirement set to 0."""
    signals = study.uniform(samples)
    mean = np.where(signals.mean >= cut * signals.requirement[:, None], signals.mean, 0)
    return write_variant(signals.path, study.program.folder / f"cut-{samples}-{cut:g}.h5", mean=mean)


def answers(study, samples, cut, solvers):
    if cut == 0:
        return {solver: timed(study, samples, study.uniform_file(samples), "cooperative", solver) for solver in solvers}
    path = cut_file(study, samples, cut)
    return {solver: timed(study, f"{samples}-cut-{cut:g}", path, "cooperative", solver) for solver in solvers}


def section(study):
    effort = study.effort
    result = Section(
        "A cut-off of small signals",
        "3.5.4",
        ("How much faster is the solver if small signals are set to zero, and is its placement still optimal?"),
    )
    mip = effort.backends[0]
    rows, gains, kept, series = [], [], [], {}
    for samples in sorted({effort.solver_samples[0], effort.solver_samples[-1]}):
        signals = study.uniform(samples)
        whole = answers(study, samples, 0, ("search", mip))
        for cut in effort.cut_offs:
            found = answers(study, samples, cut, ("search", mip))
            gain = whole[mip].seconds / found[mip].seconds
            ended = found[mip].is_count_proven
            if cut > 0:
                gains += [gain] if ended else []
                kept.append(found["search"].count == whole["search"].count)
            zeros = float((signals.mean < cut * signals.requirement[:, None]).mean())
            rows.append(
                (
                    grouped(samples),
                    f"{100 * cut:g} %" if cut else "none",
                    percent(zeros, 1),
                    found["search"].units,
                    *(time_words(found[solver]) for solver in ("search", mip)),
                    f"{gain:.1f}" if ended else f"less than {gain:.1f}",
                    missed(signals, found["search"].selected, "cooperative"),
                )
            )
            series.setdefault(f"{grouped(samples)} samples", []).append(found[mip].seconds)
    header = (
        "samples",
        "cut-off",
        "zeros",
        "transceivers",
        "our search",
        f"MIP ({mip})",
        "MIP faster by",
        "missed without the cut-off",
    )
    result.tables["cut_off"] = (header, rows)
    cuts = [100 * cut for cut in effort.cut_offs]
    chart = time_chart(cuts, series, "cut-off, % of the requirement", "y")
    result.add(
        page.row_of([page.figure(f"Time of the MIP solver ({mip}) against the cut-off", chart)]),
        page.table(header, rows, numeric=range(1, 8)),
        page.paragraph(
            (f"Cooperative, fewest transceivers; a run ends at the time limit of {effort.time_limit:g} s."), "note"
        ),
    )

    open_runs = len(kept) - len(gains)
    found = f"{spread(gains, '{:.1f}'.format)}-fold" if gains else "no proof within the time limit"
    sentence = (
        f"With a cut-off the MIP solver is {spread(gains, '{:.1f}'.format)} times as fast"
        if gains
        else ("With a cut-off the MIP solver finds no proof within the time limit")
    )
    if gains and open_runs:
        sentence += f" if it ends within the time limit (in {open_runs} of {len(kept)} cases it does not)"
    changed = kept.count(False)
    sentence += ", and the number of transceivers " + (
        f"rises in {changed} of {len(kept)} cases." if changed else "stays the same."
    )
    result.find(
        "A cut-off makes the solver up to 15 times as fast, and its placement stays optimal",
        f"up to {paper.CUT_OFF_SPEED}-fold, still optimal",
        f"{found}, count {'rises' if changed else 'unchanged'}",
        verdict(bool(gains) and max(gains) > 2 and not changed, bool(gains) and max(gains) > 1.2),
        sentence,
        (
            "A cut-off only removes signal. Every placement that it allows is feasible, but the smallest count"
            " may rise, and the problem may then become harder."
            if changed
            else ""
        ),
    )
    return result
