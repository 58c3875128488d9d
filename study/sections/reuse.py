"""The same study with path reuse instead of the paper's estimator."""

import numpy as np

from study.core import page, paper
from study.core.coverage import missed
from study.core.findings import Section
from study.core.text import grouped, percent, seconds
from study.draw import charts
from study.sections.sample_count import ABOVE, links, relative_error
from study.sections.sparsity import zeros


def _tables(study):
    """Tables 3.1 to 3.3 on the matrices of path reuse: header and rows. The first row is the paper's last."""
    header = (
        "samples",
        "3.1: fewest",
        "redundant",
        "and links",
        "redundant",
        "3.2: greedy",
        "and links",
        "3.3: fewest",
        "and signal",
        "and links",
    )
    last = paper.SAMPLES[-1]
    rows = [
        (
            f"paper, {grouped(last)}",
            *(word for k, share in paper.OPTIMAL[last] for word in (k, f"{share} %")),
            *(k for k, _ in paper.GREEDY[last]),
            *paper.COOPERATIVE[last],
        )
    ]
    for samples in study.effort.reuse_samples:
        path = study.reuse_file(samples)

        def answer(model, objective, solver="auto", samples=samples, path=path):
            return study.place(
                f"reuse-{samples}-{model}-{objective}-{solver}",
                path,
                "--model",
                model,
                "--objective",
                objective,
                "--solver",
                solver,
            )

        best = [answer("non-cooperative", objective) for objective in ("count", "links")]
        greedy = [answer("non-cooperative", objective, "greedy") for objective in ("count", "links")]
        together = [answer("cooperative", objective) for objective in ("count", "signal", "effective-links")]
        rows.append(
            (
                grouped(study.reuse(samples).samples),
                *(word for one in best for word in (one.units, percent(one.redundant_share))),
                *(one.units for one in greedy),
                *(one.units for one in together),
            )
        )
    return header, rows


def section(study):
    effort, reference = study.effort, study.reference
    result = Section(
        "The same study with path reuse",
        "beyond the paper",
        (
            "How do these results change with the estimator that shares paths between neighbouring labels and"
            " connects to all transceivers at once?"
        ),
    )
    truth = links(reference)
    rows, points = [], {"uniform": [], "reuse": []}
    runs = [("uniform", n, study.uniform_file(n), study.uniform(n)) for n in effort.samples]
    runs += [("reuse", n, study.reuse_file(n), study.reuse(n)) for n in effort.reuse_samples]
    for kind, samples, path, signals in runs:
        summary = study.simulation(path)
        error = relative_error(signals, reference)
        points[kind].append((summary["seconds"], error))
        row = [
            kind,
            grouped(signals.samples),
            seconds(summary["seconds"]),
            percent(error, 1),
            grouped(int((links(signals) != truth).sum())),
            percent(zeros(signals, 0.2), 1),
        ]
        for model in ("non-cooperative", "cooperative"):
            answer = study.place(f"{kind}-{samples}-{model}", path, "--model", model)
            row += [answer.units, missed(reference, answer.selected, model)]
        rows.append(tuple(row))
    header = (
        "estimator",
        "samples",
        "time",
        "rms relative error",
        "pairs on the wrong side",
        "zeros at 20 %",
        "non-cooperative",
        "missed in truth",
        "cooperative",
        "missed in truth",
    )
    result.tables["reuse"] = (header, rows)
    axes = charts.axes("simulation time, s", "rms relative error", "xy", "y")
    for name, kind in (("uniform", "uniform"), ("path reuse", "reuse")):
        axes.plot(*zip(*points[kind]), label=name)
    tables = _tables(study)
    result.tables["reuse_tables"] = tables
    result.add(
        page.row_of(
            [
                page.figure(
                    "Error against time",
                    charts.chart(axes, "Relative error against time"),
                    (
                        f"Entries of at least {percent(ABOVE)} of the requirement, against the reference: path"
                        f" reuse with {grouped(reference.samples)} samples and another seed."
                    ),
                )
            ]
        ),
        page.table(header, rows, numeric=range(1, 10)),
        page.table(*tables, numeric=range(1, 10), caption="Tables 3.1 to 3.3 with path reuse"),
    )
    a, b = study.uniform(effort.samples[-1]), study.reuse(effort.reuse_samples[-1])
    matter = reference.mean >= ABOVE * reference.requirement[:, None]
    work = [
        study.simulation(path)["seconds"]
        for path in (study.uniform_file(effort.samples[-1]), study.reuse_file(effort.reuse_samples[-1]))
    ]
    ratio = np.exp(np.mean(np.log(a.error[matter] ** 2 / b.error[matter] ** 2))) * work[0] / work[1]
    kinds = [row for row in rows if row[0] == "reuse"]
    result.tell(
        f"For the same error, path reuse needs 1/{ratio:.0f} of the time of the paper's estimator (from the"
        f" standard errors; geometric mean over {grouped(int(matter.sum()))} entries)."
    )
    result.tell(
        (
            f"Its placements need {', '.join(row[6] for row in kinds)} (non-cooperative) and"
            f" {', '.join(row[8] for row in kinds)} (cooperative) transceivers at"
            f" {', '.join(row[1] for row in kinds)} samples. They miss"
            f" {', '.join(str(row[7]) for row in kinds)} and {', '.join(str(row[9]) for row in kinds)} labels"
            " on the reference matrix."
        ),
        "A count that stays constant while the error falls is not an effect of noise.",
    )
    return result
