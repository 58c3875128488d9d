"""A coarser grid of candidates, and the solver time that symmetry costs: 3.5.5."""

import numpy as np

from study.core import page
from study.core.answers import MODELS
from study.core.findings import Section, verdict
from study.core.mirror import distance_to_mirror_image
from study.core.signals import write_variant
from study.core.text import percent, seconds, spread
from study.draw.coverage_map import coverage_map


def grids(units):
    """The grids of 2 m and 3 m: (spacing, first column and row, columns of M)."""
    index = [np.unique(units[:, k].round(6), return_inverse=True)[1] for k in (0, 1)]
    for spacing in (2, 3):
        for dx in range(spacing):
            for dy in range(spacing):
                if spacing == 2 or dx == dy:
                    yield spacing, (dx, dy), np.flatnonzero((index[0] % spacing == dx) & (index[1] % spacing == dy))


def interchangeable(reach):
    """Numbers of candidates that reach exactly the same labels as another one, and only a part of them."""
    columns = {}
    for j in range(reach.shape[1]):
        columns.setdefault(reach[:, j].tobytes(), []).append(j)
    same = sum(len(group) for group in columns.values() if len(group) > 1)
    overlap = reach.T.astype(int) @ reach.astype(int)
    sizes = reach.sum(axis=0)
    within = (overlap == sizes[:, None]) & (sizes[None, :] > sizes[:, None])
    return same, int(within.any(axis=1).sum())


def neighbours_in_common(reach, units):
    """For neighbouring candidates, the labels that both reach over the labels that either reaches (median)."""
    apart = np.linalg.norm(units[:, None] - units[None], axis=2)
    pairs = [(a, b) for a, b in np.argwhere(apart < 1.01) if a < b]
    shares = [
        (reach[:, a] & reach[:, b]).sum() / (reach[:, a] | reach[:, b]).sum()
        for a, b in pairs
        if (reach[:, a] | reach[:, b]).any()
    ]
    return float(np.median(shares))


def pair_files(study, signals):
    """Matrices whose columns are pairs of mirror images: the sum (cooperative) or maximum of both signals."""
    mirror = study.mirror()
    left = np.flatnonzero(np.arange(len(mirror.units)) < mirror.units)
    folder = study.program.folder
    for model, join in ((MODELS[0], np.add), (MODELS[1], np.maximum)):
        mean = signals.mean.copy()
        mean[:, left] = join(signals.mean[:, left], signals.mean[:, mirror.units[left]])
        yield (
            model,
            write_variant(signals.path, folder / f"pairs-{signals.samples}-{model}.h5", mean=mean, columns=left),
        )


def section(study):
    result = Section(
        "Coarser grid and symmetry",
        "3.5.5",
        (
            "How many transceivers does a coarser grid of candidates cost, and how much time does it save? Are"
            " optimal placements symmetric, and does symmetry cost time?"
        ),
    )
    signals, path = study.reference, study.reference_file
    rows, coarse, full = [], {model: [] for model in MODELS}, {}
    for model in MODELS:
        full[model] = study.fewest_in_truth(model)
        rows.append(("1 m", model, len(signals.units), full[model].units, "", seconds(full[model].seconds), "1.0"))
    for spacing, (dx, dy), columns in grids(signals.units):
        variant = write_variant(
            path, study.program.folder / f"grid-{signals.samples}-{spacing}-{dx}{dy}.h5", columns=columns
        )
        for model in MODELS:
            answer = study.place(f"grid-{spacing}-{dx}{dy}-{model}", variant, "--model", model)
            more = "" if answer.count is None else answer.count - full[model].count
            coarse[model].append((spacing, more))
            rows.append(
                (
                    f"{spacing} m, from {0.5 + dx:g} / {0.5 + dy:g} m",
                    model,
                    len(columns),
                    answer.units,
                    more,
                    seconds(answer.seconds),
                    f"{full[model].seconds / max(answer.seconds, 1e-3):.1f}",
                )
            )
    header = ("grid", "model", "candidates", "transceivers", "more than at 1 m", "time", "faster by")
    result.tables["coarse_grid"] = (header, rows)
    summary = []
    for spacing in (2, 3):
        for model in MODELS:
            more = [m for s, m in coarse[model] if s == spacing and m != ""]
            summary.append(
                (
                    f"{spacing} m",
                    model,
                    f"{sum(m == 0 for m in more)} of {sum(s == spacing for s, _ in coarse[model])}",
                    f"+{max(more)}" if more else "none",
                )
            )
    reach = signals.mean >= signals.requirement[:, None]
    same, within = interchangeable(reach)
    alike = neighbours_in_common(reach, signals.units)
    apart, symmetric = {}, {}
    for model in MODELS:
        chosen = signals.units[signals.columns(full[model].selected)]
        apart[model] = distance_to_mirror_image(chosen, study.width)
    for model, pairs in pair_files(study, signals):
        symmetric[model] = study.place(f"pairs-{model}", pairs, "--model", model)
    mirrored = (signals.mean + signals.mean[np.ix_(study.mirror().labels, study.mirror().units)]) / 2
    even = write_variant(path, study.program.folder / f"even-{signals.samples}.h5", mean=mirrored)
    times = {
        (model, kind): study.place(f"even-{kind}-{model}", file, "--model", model, "--solver", "mip")
        for model in MODELS
        for kind, file in (("simulated", path), ("symmetric", even))
    }
    symmetry_rows = [
        (
            model,
            full[model].units,
            "none" if symmetric[model].count is None else 2 * symmetric[model].count,
            f"{apart[model]:.1f} m",
            *(seconds(times[model, kind].seconds) for kind in ("simulated", "symmetric")),
        )
        for model in MODELS
    ]
    symmetry_header = (
        "model",
        "fewest",
        "fewest in mirrored pairs",
        "distance to the mirror image",
        "MIP, simulated matrix",
        "MIP, exactly symmetric matrix",
    )
    result.tables["symmetry_of_placements"] = (symmetry_header, symmetry_rows)
    result.add(
        page.row_of(
            [
                coverage_map(
                    study, signals, full[model].selected, f"1 m grid, {model}", cooperative=model == "cooperative"
                )
                for model in MODELS
            ]
        ),
        page.table(("grid", "model", "grids that need no more", "max extra"), summary, numeric=(2, 3)),
        page.table(symmetry_header, symmetry_rows, numeric=range(1, 6)),
        page.details("All grids", page.table(header, rows, numeric=range(2, 7))),
        page.paragraph(
            (
                "On the reference matrix. The distance of a placement to its mirror image is the mean distance"
                " in the best pairing of their transceivers; it is 0 for a symmetric placement. Placements of"
                " mirrored pairs have even counts, because no candidate is on the axis."
            ),
            "note",
        ),
    )
    two = [more for model in MODELS for spacing, more in coarse[model] if spacing == 2]
    fits = [more for more in two if more == 0]
    more_at_most = max((more for more in two if more != ""), default=0)
    result.find(
        "A less granular grid is justified",
        "argued, not tested",
        f"{len(fits)} of {len(two)} 2 m grids need no more",
        verdict(len(fits) == len(two), bool(fits)),
        (
            f"{len(fits)} of {len(two)} placements on 2 m grids with a quarter of the candidates need no more"
            f" transceivers{f'; the others need up to {more_at_most} more' if len(fits) < len(two) else ''}."
        ),
    )
    result.find(
        "Optimal placements are nearly symmetric",
        "observable in Fig. 3.2",
        f"{spread(list(apart.values()), '{:.1f}'.format)} m from the mirror image",
        verdict(max(apart.values()) < 1.0, min(apart.values()) < 1.5),
        f"The placements are {spread(list(apart.values()), '{:.1f}'.format)} m from their mirror images.",
        "Symmetric placements with the same count "
        + (
            "exist"
            if all(s.count and 2 * s.count == full[m].count for m, s in symmetric.items())
            else "need not exist: mirrored pairs require "
            + " and ".join(
                f"{'no finite number' if symmetric[m].count is None else 2 * symmetric[m].count} ({m})" for m in MODELS
            )
        )
        + ", but among equally good placements the program chooses the one with the largest minimum margin.",
    )
    # Times of a few hundredths of a second are not comparable.
    slower = [
        times[model, "symmetric"].seconds / times[model, "simulated"].seconds
        for model in MODELS
        if times[model, "simulated"].seconds > 0.2 or model == MODELS[0]
    ]
    result.find(
        "Symmetry costs the solver time",
        "suspected",
        f"exactly symmetric: {spread(slower, '{:.1f}'.format)} times as long",
        verdict(min(slower) > 1.5, max(slower) > 1.5),
        (
            f"On an exactly symmetric matrix the MIP solver takes {spread(slower, '{:.1f}'.format)} times as"
            " long as on the simulated matrix."
        ),
    )
    result.find(
        "Some transceivers cover identical sets of labels, close ones similar sets",
        "quite possible",
        f"{same} of {len(signals.units)}; neighbours share {percent(alike)}",
        verdict(same > 0, within > 0),
        (
            f"{same} of {len(signals.units)} candidates reach exactly the same labels as another candidate,"
            f" and {within} ({percent(within / len(signals.units))}) reach only a part of another candidate's"
            f" labels. Two candidates 1 m apart both reach {percent(alike)} of the labels that either of them"
            f" reaches (median)."
        ),
    )
    return result
