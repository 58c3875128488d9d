"""The number of samples: 2.11.2 and Fig. 2.13."""

import math

import numpy as np
from scipy.stats import t as student

from study.core import page
from study.core.answers import MODELS
from study.core.coverage import missed
from study.core.findings import Section, verdict
from study.core.text import grouped, minus, percent, plural
from study.draw import charts
from study.draw.picture import colour
from study.draw.store_map import signal_legend

TICKS = [5000, 25000, 100000]
ABOVE = 0.3  # errors are measured on entries of at least this share of the requirement


def relative_error(signals, reference):
    """Root mean square of the relative difference from the reference, over the entries of at least ABOVE."""
    matter = reference.mean >= ABOVE * reference.requirement[:, None]
    return float(np.sqrt(np.mean((signals.mean[matter] / reference.mean[matter] - 1) ** 2)))


def coverage(signals, reference):
    """The share of entries of at least ABOVE whose 95 % intervals contain the reference."""
    matter = reference.mean >= ABOVE * reference.requirement[:, None]
    limit = student.isf(0.025, signals.batches - 1)
    apart = np.abs(signals.mean - reference.mean) <= limit * np.hypot(signals.error, reference.error)
    return float(apart[matter].mean())


def links(signals):
    return signals.mean >= signals.requirement[:, None]


def _wrong_side(study, truth):
    """A chart of the pairs that noise moves across the threshold."""
    counts = [
        (int((links(study.uniform(n)) & ~truth).sum()), int((~links(study.uniform(n)) & truth).sum()))
        for n in study.effort.samples
    ]
    axes = charts.axes("samples per label", "pairs", "x", x_ticks=TICKS)
    for words, of_kind in zip(("wrongly above", "wrongly below"), zip(*counts)):
        axes.plot(study.effort.samples, of_kind, label=words)
    axes.set_ylim(bottom=0)
    return page.figure(
        "Pairs on the wrong side of the threshold",
        charts.chart(axes, "Pairs on the wrong side against samples"),
        f"All {grouped(truth.size)} pairs are counted.",
    )


def section(study):
    reference = study.reference
    result = Section("Number of samples", "2.11.2, Fig. 2.13", "What do more samples change, and how many suffice?")
    _, _, column = study.sources(reference)[2]
    level_two = study.levels(reference)[1]
    strongest = reference.mean[level_two, column].max()
    counts = [n for n in study.effort.samples if n != 50000]
    columns, rows = [], []
    truth = links(reference)
    for samples in counts:
        signals = study.uniform(samples)
        columns.append(
            [
                (
                    f"{grouped(samples)} samples",
                    words,
                    study.map.signals(signals, level_two, column, strongest, threshold, words),
                )
                for words, threshold in (("all", None), ("above the threshold", signals.requirement))
            ]
        )
    columns.append(
        [
            ("Reference", words, study.map.signals(reference, level_two, column, strongest, threshold, words))
            for words, threshold in (("path reuse, all", None), ("above the threshold", reference.requirement))
        ]
    )
    result.add(
        page.figure(
            f"Level two, transceiver at the centre ({reference.unit_ids[column]})",
            page.small_maps(columns, {4: "four", 2: "two"}.get(len(columns), "")) + signal_legend(),
            f"The reference is path reuse with {reference.samples:,} samples per label and another seed.",
            "as Fig. 2.13",
        )
    )
    errors = []
    for samples in study.effort.samples:
        signals = study.uniform(samples)
        ours = links(signals)
        errors.append(relative_error(signals, reference))
        rows.append(
            (
                grouped(samples),
                int(ours[level_two, column].sum()),
                int((ours & ~truth)[level_two, column].sum()),
                int((~ours & truth)[level_two, column].sum()),
                grouped(int(ours.sum())),
                grouped(int((ours & ~truth).sum())),
                grouped(int((~ours & truth).sum())),
                percent(errors[-1], 1),
                percent(coverage(signals, reference)),
            )
        )
    rows.append(("reference", int(truth[level_two, column].sum()), 0, 0, grouped(int(truth.sum())), 0, 0, "", ""))
    header = (
        "samples per label",
        "centre, level two: above",
        "wrongly above",
        "wrongly below",
        "all pairs: above",
        "wrongly above",
        "wrongly below",
        "rms relative error",
        "coverage of 95 % intervals",
    )
    result.tables["samples"] = (header, rows)
    axes = charts.axes("samples per label", "rms relative error", "xy", "y", TICKS)
    guide = [(x, errors[0] * math.sqrt(study.effort.samples[0] / x)) for x in axes.set_xlim(3000, 200000)]
    axes.plot(study.effort.samples, errors, label="uniform estimator")
    axes.plot(*zip(*guide), ":", color=colour("muted"), marker="", lw=1.4, label="1/√samples")
    result.add(
        page.row_of(
            [
                page.figure(
                    "Error against samples",
                    charts.chart(axes, "Relative error against samples"),
                    f"Entries of at least {percent(ABOVE)} of the requirement, against the reference.",
                ),
                _wrong_side(study, truth),
            ]
        ),
        page.table(header, rows, numeric=range(1, 9)),
    )
    _judge_outliers(study, result, level_two, column, truth)
    if study.most_samples == 100000:
        _judge_end(study, result, errors, truth)
    _judge_convergence(study, result, errors)
    return result


def _judge_outliers(study, result, rows, column, truth):
    first, last = study.effort.samples[0], study.effort.samples[-1]
    above = {n: links(study.uniform(n)) & ~truth for n in (first, last)}
    everywhere = [int(above[n].sum()) for n in (first, last)]
    shown = [int(above[n][rows, column].sum()) for n in (first, last)]
    result.find(
        "More samples greatly reduce the statistical outliers above the threshold",
        "seen in Fig. 2.13",
        (
            f"{grouped(everywhere[0])} pairs wrongly above at {grouped(first)}, {grouped(everywhere[1])} at"
            f" {grouped(last)}"
        ),
        verdict(everywhere[1] < everywhere[0] / 2, everywhere[1] < everywhere[0]),
        (
            f"With {grouped(first)} samples, {grouped(everywhere[0])} of {grouped(truth.size)} pairs are above"
            f" the threshold only because of sampling errors; with {grouped(last)} samples, {grouped(everywhere[1])}."
        ),
    )
    if last == 100000:
        result.find(
            "At 100,000 samples the outliers are gone",
            "none in Fig. 2.13f",
            f"{shown[1]} of {len(rows)} labels",
            verdict(shown[1] == 0, shown[1] < shown[0]),
            (
                f"With 100,000 samples, {shown[1] or 'none'} of the {len(rows)} labels on level two"
                f" {'is' if shown[1] == 1 else 'are'} wrongly above the threshold of the centre transceiver"
                f" ({shown[0]} with {grouped(first)}). {grouped(everywhere[1])} of all pairs still are."
            ),
            reference="Fig. 2.13f",
        )


def _judge_end(study, result, errors, truth):
    """The possible improvement beyond the paper's maximum number of samples."""
    last = study.most_samples
    wrong = [int((links(study.uniform(n)) != truth).sum()) for n in study.effort.samples[-2:]]
    same, lost = True, 0
    for model in MODELS:
        answer = study.table_answer(last, model, "count")
        same = same and answer.count == study.fewest_in_truth(model).count
        lost += missed(study.reference, answer.selected, model)
    is_enough = same and lost == 0
    result.find(
        "Beyond 100,000 samples neither simulation nor optimisation improves notably",
        "tested, not shown",
        f"rms error still {percent(errors[-1], 1)}; counts {'final' if same else 'not final'}",
        verdict(is_enough and errors[-1] < 0.03, is_enough or errors[-1] < 0.03),
        (
            f"The counts with 100,000 samples are {'' if same else 'not '}equal to those of the reference"
            f" matrix, on which their placements miss {plural(lost, 'label')}. The rms relative error of the"
            f" entries of at least {percent(ABOVE)} of the requirement is {percent(errors[-1], 1)} and still falls."
        ),
        (
            f"Pairs on the wrong side of the threshold: {grouped(wrong[0])} at"
            f" {grouped(study.effort.samples[-2])}, {grouped(wrong[1])} at 100,000."
        ),
        reference="3.5.4",
    )


def _judge_convergence(study, result, errors):
    samples = study.effort.samples
    held = [coverage(study.uniform(n), study.reference) for n in samples]
    reuse = coverage(study.reuse(study.effort.reuse_samples[-1]), study.reference)
    slope = math.log(errors[-1] / errors[0]) / math.log(samples[-1] / samples[0])
    result.find(
        "Convergence is hard to determine",
        "no criterion given",
        (
            f"coverage of 95 % intervals: {percent(held[0])} at {grouped(samples[0])},"
            f" {percent(held[-1])} at {grouped(samples[-1])}"
        ),
        verdict(held[-1] < 0.85, held[-1] < 0.93),
        (
            f"The 95 % intervals from the batches contain the reference for {percent(held[0])} of the entries"
            f" with {grouped(samples[0])} samples, for {percent(held[-1])} with {grouped(samples[-1])}, and for"
            f" {percent(reuse)} with path reuse (entries of at least {percent(ABOVE)} of the requirement)."
        ),
        "So the standard errors of a run show how far it has converged"
        + (
            ""
            if held[0] > 0.93
            else ", but are too small with few samples: low estimates have low standard errors, too"
        )
        + f". The error is proportional to the number of samples to the power {minus(slope)} (Monte Carlo: −0.5).",
    )
