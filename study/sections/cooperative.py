"""Optimal cooperative placements: Table 3.3 and Fig. 3.4."""

from study.core import page, paper
from study.core.coverage import missed
from study.core.findings import Section, verdict
from study.core.seeds import judge_trend
from study.core.text import grouped
from study.draw.coverage_map import coverage_map


def section(study):
    result = Section(
        "Cooperative placement",
        "3.5.2, Table 3.3, Fig. 3.4",
        "How many transceivers are needed if their signals add up, and do the objectives differ?",
    )
    rows, counts, same = [], [], []
    for samples in study.effort.samples:
        row = [grouped(samples)]
        answers = [
            study.table_answer(samples, "cooperative", objective)
            for objective in ("count", "signal", "effective-links")
        ]
        for answer, units in zip(answers, paper.COOPERATIVE[samples]):
            row += [answer.units, units, missed(study.reference, answer.selected, "cooperative")]
        rows.append(tuple(row))
        counts.append([answer.count for answer in answers])
        same.append(set(answers[1].selected) == set(answers[2].selected))
    header = (
        "samples",
        "transceivers",
        "paper",
        "missed in truth",
        "and signal",
        "paper",
        "missed in truth",
        "and links",
        "paper",
        "missed in truth",
    )
    result.tables["table_3_3"] = (header, rows)
    signals = study.uniform(study.most_samples)
    figures = [
        coverage_map(
            study,
            signals,
            study.table_answer(study.most_samples, "cooperative", objective).selected,
            f"{words}, {study.most_samples:,} samples",
            reference=reference,
            cooperative=True,
        )
        for objective, words, reference in (
            ("count", "Transceivers only", "as Fig. 3.4a"),
            ("signal", "Transceivers and signal", "as Fig. 3.4b"),
        )
    ]
    result.add(
        page.table(header, rows, numeric=range(1, 10), paper=(2, 5, 8), caption="Table 3.3"),
        page.paragraph(
            (
                "A link counts only if one transceiver alone meets the requirement. (The paper's sum over all"
                " pairs is equal for all selections with the same count.)"
            ),
            "note",
        ),
        page.row_of(figures),
    )
    single = [row[0] for row in counts]
    printed = [paper.COOPERATIVE[n][0] for n in study.effort.samples]
    judge_trend(study, result, "cooperative", single, printed, "Table 3.3")
    result.find(
        "All objectives lead to the same number of transceivers",
        "equal in every row",
        f"equal in {sum(len(set(c)) == 1 for c in counts)} of {len(counts)} rows",
        verdict(all(len(set(c)) == 1 for c in counts)),
        (
            f"The three objectives agree on the count in {sum(len(set(c)) == 1 for c in counts)} of"
            f" {len(counts)} rows. They must agree, because the count is minimised first."
        ),
        reference="Table 3.3",
    )
    result.find(
        "Minimising signal and minimising links give the same placement",
        "at 100,000",
        f"the same in {sum(same)} of {len(same)} rows",
        verdict(same[-1], any(same)),
        (
            f"The placements with the least signal and with the fewest links are equal in {sum(same)} of"
            f" {len(same)} rows."
        ),
        (
            ""
            if same[-1]
            else (
                "Among placements of minimum count the two objectives differ: a link counts only if one"
                " transceiver alone meets the requirement."
            )
        ),
        reference="Fig. 3.4",
    )
    fewer = [c - study.table_answer(n, "non-cooperative", "count").count for c, n in zip(single, study.effort.samples)]
    ours_pair = f"{single[-1]} against {single[-1] - fewer[-1]}"
    result.find(
        "Cooperation needs fewer transceivers",
        f"{paper.COOPERATIVE[study.most_samples][0]} against {paper.OPTIMAL[study.most_samples][0][0]}",
        ours_pair,
        verdict(all(d < 0 for d in fewer), any(d < 0 for d in fewer)),
        f"If signals add up, {ours_pair} transceivers are needed with {grouped(study.most_samples)} samples.",
        reference="3.5.3",
    )
    return result
