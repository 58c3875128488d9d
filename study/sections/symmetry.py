"""The mirror symmetry of the environment as a test (2.11.1)."""

import numpy as np

from study.core import page
from study.core.findings import Section, verdict
from study.core.hypothesis import pair_test
from study.core.text import percent
from study.draw.charts import histogram

LEVEL = 0.01


def partner_test(study, left, right, shift=0):
    """The four transceivers of the figures against their mirror images, label by label.

    Signals of the left labels come from one matrix, those of the right from the other (both may be the same one
    where its rows are independent). With `shift` the partner is that many columns of the grid beside the image.
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
    return pair_test(
        np.array(a), np.array(b), np.array(ea), np.array(eb), min(left.batches, right.batches) - 1, LEVEL
    )


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
            "The environment is its own mirror image from left to right. Are the signals, up to their "
            "statistical error?"
        ),
    )
    rows = []
    for samples in study.effort.samples:
        signals = study.uniform(samples)
        test = partner_test(study, signals, signals)
        rows.append(_row(f"{samples:,} samples", test))
    control = partner_test(study, signals, signals, shift=1)
    rows.append(_row(f"{samples:,}, partner 1 m aside", control))
    reuse = study.reuse(study.effort.reuse_samples[-1])
    reuse_test, reuse_control = (partner_test(study, reuse, study.reference, shift) for shift in (0, 1))
    rows.append(_row(f"path reuse, {reuse.samples:,}", reuse_test, False))
    rows.append(_row(f"path reuse, {reuse.samples:,}, partner 1 m aside", reuse_control, False))
    header = (
        "pairing",
        "pairs",
        "largest |z|",
        "may be",
        "mean z²",
        "expected",
        "is off by (σ)",
        "may be",
        "|z| > 1.96",
        "test at 1 %",
    )
    result.tables["symmetry"] = (header, rows)
    result.add(
        page.row_of(
            [
                _histogram(test, f"Labels and transceivers opposite each other, {samples:,} samples"),
                _histogram(control, "Control: the partner stands 1 m beside the mirror image"),
            ]
        ),
        page.table(header, rows, numeric=range(1, 9)),
        page.paragraph(
            (
                "Every label of the left half is compared with the one opposite, for the four transceivers "
                "above and their mirror images; z is the difference over its standard error. Two tests at "
                "half a percent each: of the largest |z| among all pairs, and of the mean of z². Walks of "
                "different labels are independent; path reuse shares paths between opposite labels, so "
                "there the two sides come from runs with different seeds, and as neighbouring labels share "
                "paths as well, only its largest |z| is a test. Pairs beyond ±8 are counted at the ends."
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
            f" {test.largest:.1f} standard errors (chance allows {test.limit:.1f}), and the mean of z² is"
            f" {test.mean_square:.2f} (chance: {test.expected_square:.2f})."
        ),
        (
            "The test can tell: with a partner 1 m beside the mirror image the largest is"
            f" {control.largest:.1f} and the mean {control.mean_square:.2f}, with path reuse"
            f" {reuse_control.largest:.0f} and {reuse_control.mean_square:.0f};"
            f" {'both are rejected' if rejected else 'not both are rejected, so the test says little here'}."
        ),
    )
    return result
