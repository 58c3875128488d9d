"""Zeros of the matrix before and after a cut-off: 3.5.4 and Fig. 3.6."""

import numpy as np

from study.core import page
from study.core.findings import Section, verdict
from study.core.text import grouped, percent, spread
from study.draw import charts, matrix_picture

CUTS = (0, 0.01, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 1)


def zeros(signals, cut):
    """Share of entries that are zero, or below a share of the requirement."""
    values = signals.mean
    return float((values <= 0).mean() if cut == 0 else (values < cut * signals.requirement[:, None]).mean())


def section(study):
    result = Section(
        "Sparsity of the matrix",
        "3.5.4, Fig. 3.6",
        "How many entries of M are zero, before and after small entries are set to zero?",
    )
    samples = study.effort.samples
    all_signals = [study.uniform(n) for n in samples] + [study.reference]
    names = [f"{grouped(n)} samples" for n in samples] + ["reference"]
    rows = [
        (f"{100 * cut:g} %" if cut else "none", *(percent(zeros(one, cut), 1) for one in all_signals)) for cut in CUTS
    ]
    header = ("cut-off", *map(grouped, samples), "reference")
    result.tables["zeros"] = (header, rows)
    inside = [cut for cut in CUTS if all(0.4 <= zeros(one, cut) <= 0.5 for one in all_signals[:-1])]
    shown_cut = inside[0] if inside else 0.2
    shown = [(names[0], all_signals[0]), (names[len(samples) - 1], all_signals[len(samples) - 1])]
    reference = "as Fig. 3.6"
    figures = [
        page.figure(
            f"{name}, cut at {100 * cut:g} %",
            matrix_picture.picture(
                one.mean >= cut * one.requirement[:, None], f"Entries of M above {100 * cut:g} % of the requirement"
            ),
            "",
            reference,
        )
        for name, one in shown
        for cut in (shown_cut, 1)
    ]
    axes = charts.axes("cut-off, share of the requirement", "zeros", "x", "xy", [0.01, 0.03, 0.1, 0.3, 1])
    for place in (0, len(samples) - 1, len(samples)):
        axes.plot(CUTS[1:], [zeros(all_signals[place], cut) for cut in CUTS[1:]], label=names[place])
    axes.set_ylim(0, 1.02)
    result.add(
        page.row_of(figures, "quad"),
        page.row_of(
            [
                page.figure("Zeros against the cut-off", charts.chart(axes, "Share of zeros against the cut-off")),
                page.figure("Zeros by samples per label", page.table(header, rows, numeric=range(1, len(header)))),
            ]
        ),
        page.paragraph(
            (
                "Rows of the pictures are labels, columns are transceivers. An entry is coloured if its signal"
                " is at least the cut-off, a share of the requirement. At 100 % the picture is the reach matrix"
                " of the non-cooperative model."
            ),
            "note",
        ),
    )
    before = [zeros(one, 0) for one in all_signals[:-1]]
    result.find(
        "M is highly dense, 0 to 7 % zeros",
        "0 to 7 %",
        spread(before, lambda v: percent(v, 1)),
        verdict(all(v <= 0.07 for v in before), any(v <= 0.07 for v in before)),
        f"Before the cut-off {spread(before, lambda v: percent(v, 2))} of the entries are zero"
        + ("; the fewest samples have the most zeros." if before[0] == max(before) > min(before) else "."),
        (
            ""
            if max(before) > 0
            else "Here every label receives some light from every candidate even with the fewest samples."
        ),
    )
    after = [zeros(one, shown_cut) for one in all_signals[:-1]]
    result.find(
        "After a cut-off 40 to 50 % zeros",
        "40 to 50 %",
        f"{spread(after, lambda v: percent(v, 1))} at {100 * shown_cut:g} %",
        verdict(bool(inside), any(0.4 <= v <= 0.5 for v in after)),
        (
            f"A cut-off at {100 * shown_cut:g} % of the requirement makes"
            f" {spread(after, lambda v: percent(v, 1))} of the entries zero. The paper does not give its"
            " cut-off."
        ),
    )
    best = all_signals[len(samples) - 1]
    chosen = best.mean[:, best.columns(study.table_answer(samples[-1], "cooperative", "count").selected)]
    small = chosen < shown_cut * best.requirement[:, None]
    carried = float(np.where(small, chosen, 0).sum() / chosen.sum())
    most = float((np.where(small, chosen, 0).sum(axis=1) / best.requirement).max())
    result.find(
        "The signal below a cut-off hardly matters to a placement",
        "negligible",
        f"{percent(carried, 1)} of the signal, at most {percent(most)} of a requirement",
        verdict(carried < 0.05 and most < 0.1, carried < 0.05),
        (
            f"Entries below {100 * shown_cut:g} % of the requirement carry {percent(carried, 1)} of the signal"
            f" of the chosen transceivers, but at single labels they add up to {percent(most)} of the"
            " requirement."
        ),
        reference="3.5.4",
    )
    reach_zeros = [zeros(one, 1) for one in all_signals[:-1]]
    result.find(
        "The non-cooperative model is quite sparse",
        "typically quite sparse",
        f"{spread(reach_zeros, percent)} zeros",
        verdict(min(reach_zeros) > 0.75, min(reach_zeros) > 0.5),
        f"{spread(reach_zeros, percent)} of the entries of the reach matrix are zero.",
        reference="3.5.4",
    )
    edges = [zeros(one, 0.05) for one in (all_signals[0], all_signals[len(samples) - 1])]
    result.find(
        "Noise shows in the sparsity pattern",
        "seen in Fig. 3.6",
        f"zeros at a cut of 5 %: {percent(edges[0], 1)} against {percent(edges[1], 1)}",
        verdict(edges[0] > 1.2 * edges[1], edges[0] > edges[1]),
        (
            f"At a cut-off of 5 % the noisiest matrix has {percent(edges[0], 1)} zeros and the most precise of"
            f" the series {percent(edges[1], 1)}: noise moves small entries across any cut-off."
        ),
        reference="Fig. 3.6",
    )
    return result
