"""Optimal non-cooperative placements: Table 3.1 and Fig. 3.2."""

from study.core import page, paper
from study.core.coverage import missed
from study.core.findings import Section, verdict
from study.core.seeds import judge_trend
from study.core.text import grouped, percent, seconds, spread
from study.draw.coverage_map import coverage_map


def section(study):
    result = Section(
        "Non-cooperative placement",
        "3.5.1, Table 3.1, Fig. 3.2",
        (
            "How many transceivers are needed if one transceiver alone must reach each label, and how many"
            " labels are reached by several?"
        ),
    )
    rows, counts, shares = [], [], []
    for samples in study.effort.samples:
        row = [grouped(samples)]
        for k, objective in enumerate(("count", "links")):
            answer = study.table_answer(samples, "non-cooperative", objective)
            units, share = paper.OPTIMAL[samples][k]
            row += [
                answer.units,
                units,
                percent(answer.redundant_share),
                f"{share} %",
                missed(study.reference, answer.selected, "non-cooperative"),
            ]
            if k == 0:
                counts.append(answer.count)
            shares.append(answer.redundant_share)
        rows.append(tuple(row))
    header = (
        "samples",
        "transceivers",
        "paper",
        "redundant",
        "paper",
        "missed in truth",
        "and links: transceivers",
        "paper",
        "redundant",
        "paper",
        "missed in truth",
    )
    result.tables["table_3_1"] = (header, rows)
    signals = study.uniform(study.most_samples)
    answers = [study.table_answer(study.most_samples, "non-cooperative", objective) for objective in ("count", "links")]
    result.add(
        page.table(header, rows, numeric=range(1, 11), paper=(2, 4, 7, 9), caption="Table 3.1"),
        page.paragraph(
            (
                "‘Missed in truth’ counts the labels that the placement does not reach on the reference"
                " matrix, an independent and much more precise simulation. [a, b] is the interval between the"
                " lower bound and the count found if the time limit ended the run."
            ),
            "note",
        ),
        page.row_of(
            [
                coverage_map(
                    study, signals, answer.selected, f"{words}, {study.most_samples:,} samples", reference=reference
                )
                for answer, words, reference in zip(
                    answers, ("Transceivers only", "Transceivers and links"), ("as Fig. 3.2a", "as Fig. 3.2b")
                )
            ]
        ),
    )
    printed = [paper.OPTIMAL[n][0][0] for n in study.effort.samples]
    judge_trend(study, result, "non-cooperative", counts, printed, "Table 3.1")
    with_links = shares[1::2]
    drops = [a - b for a, b in zip(shares[0::2], with_links)]
    result.find(
        "Minimising links, too, reduces redundancy at the same count",
        ", ".join(f"{paper.OPTIMAL[n][0][1]} → {paper.OPTIMAL[n][1][1]} %" for n in study.effort.samples),
        ", ".join(f"{percent(a)[:-2]} → {percent(b)}" for a, b in zip(shares[0::2], with_links)),
        verdict(all(d >= 0 for d in drops) and any(d > 0.005 for d in drops), all(d >= 0 for d in drops)),
        (
            "With links as the second objective the redundant share falls by"
            f" {spread([100 * d for d in drops], '{:.0f}'.format)} points."
        ),
        reference="Table 3.1",
    )
    printed_last = paper.OPTIMAL[study.most_samples][1][1]
    result.find(
        "Redundancy nearly vanishes with many samples",
        f"{printed_last} % at {grouped(study.most_samples)}",
        f"{percent(with_links[-1])}",
        verdict(with_links[-1] <= 0.05, with_links[-1] < with_links[0]),
        (
            f"With {grouped(study.most_samples)} samples, two or more transceivers reach"
            f" {percent(with_links[-1])} of the labels even with the fewest links."
        ),
        (
            ""
            if with_links[-1] <= 0.05
            else (
                "The remaining redundancy depends on how the shelves divide among whole transceivers, and so on"
                " dimensions that the paper does not print."
            )
        ),
        reference="Table 3.1",
    )
    times = [
        [study.table_answer(n, "non-cooperative", objective).seconds for n in study.effort.samples]
        for objective in ("count", "links")
    ]
    extra = [b - a for a, b in zip(*times)]
    result.find(
        "The link term costs little extra time, above all with many samples",
        "minimal",
        f"{spread(extra, seconds)} more",
        verdict(max(extra) < max(times[0]), max(extra) < 60 and extra[-1] <= extra[0]),
        (
            f"The link term takes {spread(extra, seconds)} more than the {spread(times[0], seconds)} for the"
            f" count: {seconds(extra[0])} more with {grouped(study.effort.samples[0])} samples and"
            f" {seconds(extra[-1])} more with {grouped(study.most_samples)}."
        ),
        reference="3.5.1",
    )
    return result
