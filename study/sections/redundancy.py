"""Redundancy of cooperative placements, and layouts with transceivers in the corners and the centre (3.5.2)."""

import numpy as np

from study.core import page
from study.core.findings import Section, verdict
from study.core.text import percent
from study.draw.coverage_map import coverage_map


def redundancy(signals, columns):
    """Shares of labels that are still reached without their weakest transceiver, and without any one of them."""
    chosen = signals.mean[:, columns]
    total = chosen.sum(axis=1)
    return (
        float(np.mean(total - chosen.min(axis=1) >= signals.requirement)),
        float(np.mean(total - chosen.max(axis=1) >= signals.requirement)),
    )


def corners_and_centre(signals, width, depth):
    """All layouts of four transceivers at the corners of a rectangle about the centre, and one in the centre."""
    centre = signals.unit_at(width / 2, depth / 2)
    xs, ys = (sorted({round(v, 6) for v in signals.units[:, k]}) for k in (0, 1))
    for x in xs[: len(xs) // 2]:
        for y in ys[: len(ys) // 2]:
            yield (x, y), [signals.unit_at(a, b) for a in (x, width - x) for b in (y, depth - y)] + [centre]


def section(study):
    result = Section(
        "Redundancy, and corners with a centre",
        "3.5.2",
        (
            "How many labels are still reached without one transceiver of a cooperative placement? And does a"
            " layout of one transceiver in each corner and one in the centre reduce redundancy?"
        ),
    )
    signals = study.reference
    best = study.fewest_in_truth("cooperative")
    layouts = list(corners_and_centre(signals, *study.store["room"]["size"][:2]))

    def met(columns):
        return signals.mean[:, columns].sum(axis=1) >= signals.requirement

    corner = layouts[0]
    widest = max(
        layouts,
        key=lambda layout: (met(layout[1]).sum(), (signals.mean[:, layout[1]].sum(axis=1) / signals.requirement).min()),
    )
    names = [
        (f"fewest possible ({best.units})", signals.columns(best.selected)),
        ("corners of the grid and centre (5)", corner[1]),
        (f"best rectangle and centre (5), {widest[0][0]:g} and {widest[0][1]:g} m from the walls", widest[1]),
    ]
    rows = []
    for words, columns in names:
        least, any_one = redundancy(signals, columns)
        alone = float(np.mean((signals.mean[:, columns] >= signals.requirement[:, None]).sum(axis=1) >= 2))
        margin = float((signals.mean[:, columns].sum(axis=1) / signals.requirement).min())
        rows.append(
            (
                words,
                f"{int(met(columns).sum())} of {len(signals.labels)}",
                f"{margin:.2f}",
                percent(least),
                percent(any_one),
                percent(alone),
            )
        )
    header = (
        "placement",
        "labels reached",
        "smallest margin",
        "reached without their weakest transceiver",
        "reached whichever one fails",
        "two reach them alone",
    )
    result.tables["redundancy"] = (header, rows)
    result.tables["corners_and_centre"] = (
        ("from the left wall, m", "from the front wall, m", "labels reached", "smallest margin"),
        [
            (x, y, int(met(columns).sum()), float((signals.mean[:, columns].sum(axis=1) / signals.requirement).min()))
            for (x, y), columns in layouts
        ],
    )
    result.add(
        page.row_of(
            [
                coverage_map(study, signals, [signals.unit_ids[j] for j in columns], words, cooperative=True)
                for words, columns in (
                    ("Corners of the grid and centre", corner[1]),
                    ("The best rectangle and centre", widest[1]),
                )
            ]
        ),
        page.table(header, rows, numeric=range(1, 6), wide=(0,)),
        page.paragraph(
            (f"On the reference matrix. All {len(layouts)} rectangles about the centre that fit the grid were tried."),
            "note",
        ),
    )
    least, any_one = redundancy(signals, names[0][1])
    result.find(
        "Almost all labels would allow the removal of a transceiver",
        "almost 100 %",
        f"{percent(least)}; any transceiver: {percent(any_one)}",
        verdict(least > 0.95, least > 0.8),
        (
            f"{percent(least)} of the labels are still reached without the transceiver that contributes least"
            f" to them, but only {percent(any_one)} are still reached whichever transceiver fails."
        ),
        "The paper's definition can be read both ways; a planner needs the second reading.",
    )
    corner_met, widest_met = int(met(corner[1]).sum()), int(met(widest[1]).sum())
    corner_any = redundancy(signals, corner[1])[1]
    complete = [
        words
        for words, count in (("the very corners", corner_met), ("the best rectangle", widest_met))
        if count == len(signals.labels)
    ]
    result.find(
        "Corners and centre reduce redundancy, at the price of a transceiver",
        "5 instead of 4",
        f"corners: {corner_met} of {len(signals.labels)} reached, best rectangle: {widest_met}",
        verdict(corner_met == len(signals.labels) and corner_any <= any_one, widest_met == len(signals.labels)),
        (
            f"Five transceivers at the corners of the grid and in the centre reach {corner_met} of"
            f" {len(signals.labels)} labels; the best rectangle with a centre reaches {widest_met}."
            f" The optimal placement has {best.units} transceivers."
        ),
        ("" if "the very corners" in complete else "A transceiver in a corner sends much of its light into the walls."),
    )
    return result
