"""Tests the mirror symmetry of the environment (2.11.1)."""

import numpy as np

from study.core import page
from study.core.findings import Section, verdict
from study.core.hypothesis import pair_test
from study.core.text import percent
from study.draw.charts import histogram

LEVEL = 0.01


def partner_test(study, left, right, shift=0):
    """Compares the four transceivers of the figures with their mirror images, label by label.

    The signals of the left labels come from the matrix `left`, the others from `right`; both may be the same matrix
    if its rows are independent. With `shift`, the partner is that many grid columns beside the mirror image.
    """
    mirror = study.mirror()
    pairs = mirror.left_labels
    a, b, ea, eb = [], [], [], []
    for column in sorted({column for _, _, column in study.sources(left)}):
        partner = mirror.units[column]
        place = left.units[partner] + [shift, 0, 0]
        if abs(place[0] - study.width / 2) > study.width / 2:
            place = left.units[partner] - [shift, 0, 0]
        other = left.unit_at(*place[:2])
        a.append(left.mean[pairs, column])
        ea.append(left.error[pairs, column])
        b.append(right.mean[mirror.labels[pairs], other])
        eb.append(right.error[mirror.labels[pairs], other])
    return pair_test(np.array(a), np.array(b), np.array(ea), np.array(eb), min(left.batches, right.batches) - 1, LEVEL)


def _row(words, test, is_spread_tested=True):
    passes = test.passes if is_spread_tested else test.largest <= test.limit
    return (
        words,
        len(test.z),
        f"{test.largest:.2f}",
        f"{test.limit:.2f}",
        f"{test.mean_square:.3f}",
        f"{test.expected_square:.3f}",
        *((f"{test.spread_z:.1f}", f"{test.spread_limit:.2f}") if is_spread_tested else ("", "")),
        percent(test.beyond, 1),
        "passes" if passes else "rejected",
    )


def _histogram(test, words):
    edges = np.linspace(-8, 8, 33)
    counts = np.histogram(np.clip(test.z, -7.99, 7.99), edges)[0]
    return page.figure(
        words,
        histogram(
            list(edges),
            [int(c) for c in counts],
            "difference / standard error",
            "pairs",
            words,
            ticks=[-8, -4, -2, 0, 2, 4, 8],
        ),
    )


def section(study):
    result = Section(
        "Mirror symmetry",
        "2.11.1",
        (
            "The environment is mirror-symmetric from left to right. Are the signals symmetric within their "
            "statistical error?"
        ),
    )
    rows = []
    for samples in study.effort.samples:
        signals = study.uniform(samples)
        test = partner_test(study, signals, signals)
        rows.append(_row(f"{samples:,} samples", test))
    control = partner_test(study, signals, signals, shift=1)
    rows.append(_row(f"{samples:,}, partner displaced by 1 m", control))
    reuse = study.reuse(study.effort.reuse_samples[-1])
    reuse_test, reuse_control = (partner_test(study, reuse, study.reference, shift) for shift in (0, 1))
    rows.append(_row(f"path reuse, {reuse.samples:,}", reuse_test, False))
    rows.append(_row(f"path reuse, {reuse.samples:,}, partner displaced by 1 m", reuse_control, False))
    header = (
        "pairing",
        "pairs",
        "largest |z|",
        "limit",
        "mean z²",
        "expected",
        "deviation (σ)",
        "limit",
        "|z| > 1.96",
        "test at 1 %",
    )
    result.tables["symmetry"] = (header, rows)
    result.add(
        page.row_of(
            [
                _histogram(test, f"Labels and transceivers opposite each other, {samples:,} samples"),
                _histogram(control, "Control: the partner is 1 m beside the mirror image"),
            ]
        ),
        page.table(header, rows, numeric=range(1, 9)),
        page.paragraph(
            (
                "Every label of the left half is compared with the opposite label, for the four transceivers "
                "above and their mirror images; z is the difference divided by its standard error. There are "
                "two tests at 0.5 % each: of the largest |z| among all pairs, and of the mean of z². The "
                "uniform estimator samples every label independently. Path reuse shares paths between opposite "
                "labels, so its two sides come from runs with different seeds. Because neighbouring labels "
                "share paths, too, only its largest |z| is tested. Pairs beyond ±8 are counted at the ends."
            ),
            "note",
        ),
    )
    uniform_passes = [row[-1] == "passes" for row in rows[: len(study.effort.samples)]]
    rejected = not control.passes and reuse_control.largest > reuse_control.limit
    result.find(
        "The expected mirror symmetry is achieved",
        "seen in the figures",
        (
            f"{sum(uniform_passes)} of {len(uniform_passes)} sample counts pass; asymmetric pairing "
            f"{'rejected' if rejected else 'not rejected'}"
        ),
        verdict(all(uniform_passes) and rejected, any(uniform_passes) and rejected),
        (
            f"With {samples:,} samples the largest of {len(test.z)} differences is"
            f" {test.largest:.1f} standard errors (limit: {test.limit:.1f}), and the mean of z² is"
            f" {test.mean_square:.2f} (expected: {test.expected_square:.2f})."
        ),
        (
            "The test detects asymmetry: with a partner 1 m beside the mirror image the largest |z| is"
            f" {control.largest:.1f} and the mean of z² is {control.mean_square:.2f}, with path reuse"
            f" {reuse_control.largest:.0f} and {reuse_control.mean_square:.0f};"
            f" {'both are rejected' if rejected else 'at least one passes, so the test is weak here'}."
        ),
    )
    return result
