"""Solver time against samples: 3.5.4."""

from study.core import page
from study.core.answers import MODELS
from study.core.coverage import missed
from study.core.findings import Section, verdict
from study.core.text import grouped, listed, percent, seconds, spread
from study.draw import charts

DAY = 86400


def timed(study, name, signal_file, model, solver):
    """A placement with the fewest transceivers; `solver` is "search" (ours) or a MIP back end."""
    choice = ["--solver", "auto"] if solver == "search" else ["--solver", "mip", "--backend", solver]
    return study.place(f"time-{name}-{model}-{solver}", signal_file, "--model", model, *choice)


def time_words(answer):
    """Seconds, and the open interval of the count if the time limit ended the run."""
    return seconds(answer.seconds) + ("" if answer.is_count_proven else f", {answer.units} open")


def time_chart(x_values, series, x_title, log):
    """Lines of seconds by name on a logarithmic axis; times below 0.01 s are drawn there."""
    axes = charts.axes(x_title, "seconds", log, x_ticks=x_values)
    for name, times in series.items():
        axes.plot(x_values, [max(time, 0.01) for time in times], label=name)
    return charts.chart(axes, f"Seconds against {x_title}")


class Runs:
    """All timed placements: by samples, model and solver, and on the reference matrix by model and solver."""

    def __init__(self, study):
        self.samples = study.effort.solver_samples
        self.solvers = ("search", *study.effort.backends)
        self.names = ("our search", *(f"MIP ({backend})" for backend in study.effort.backends))
        self.noisy = {
            (n, model, solver): timed(study, n, study.uniform_file(n), model, solver)
            for n in self.samples
            for model in MODELS
            for solver in self.solvers
        }
        self.precise = {
            (model, solver): timed(study, "reference", study.reference_file, model, solver)
            for model in MODELS
            for solver in self.solvers
        }
        self.missed = {key: missed(study.reference, answer.selected, key[1]) for key, answer in self.noisy.items()}

    def with_fewest_samples(self):
        return [self.noisy[self.samples[0], model, solver] for model in MODELS for solver in self.solvers]


def _table(runs, result):
    rows = [
        (
            grouped(n),
            model,
            *(time_words(runs.noisy[n, model, solver]) for solver in runs.solvers),
            *(runs.missed[n, model, solver] for solver in runs.solvers),
        )
        for n in runs.samples
        for model in MODELS
    ]
    rows += [
        (
            "reference",
            model,
            *(time_words(runs.precise[model, solver]) for solver in runs.solvers),
            *("" for _ in runs.solvers),
        )
        for model in MODELS
    ]
    header = ("samples", "model", *runs.names, *(f"missed in truth: {name}" for name in runs.names))
    result.tables["solver_time"] = (header, rows)
    return page.table(header, rows, numeric=range(2, len(header)))


def _chart(runs):
    if len(runs.samples) < 2:
        return ""
    chart = time_chart(
        runs.samples,
        {
            f"{model}, {name}": [runs.noisy[n, model, solver].seconds for n in runs.samples]
            for model in MODELS
            for solver, name in list(zip(runs.solvers, runs.names))[:2]
        },
        "samples per label",
        "xy",
    )
    return page.row_of([page.figure("Time for the proof against samples", chart)])


def section(study):
    result = Section(
        "Solver time",
        "3.5.4",
        (
            "How does the time to prove the smallest count depend on the quality of the simulation, and how"
            " good are placements from poor simulations?"
        ),
    )
    runs = Runs(study)
    result.add(
        _chart(runs),
        _table(runs, result),
        page.paragraph(
            (
                f"The time limit is {study.effort.time_limit:g} s per run, with one thread per core. Times are"
                " of one run on one machine. ‘Our search’ is the default of `place`; MIP passes the whole model"
                " to an ILP solver, as the paper did. ‘Missed in truth’ is defined in the section on"
                " non-cooperative placement."
            ),
            "note",
        ),
    )
    _judge_times(study, runs, result)
    _judge_placements(study, runs, result)
    return result


def _judge_times(study, runs, result):
    noisy = runs.with_fewest_samples()
    worst = max(noisy, key=lambda answer: answer.seconds)
    ended = all(answer.is_count_proven for answer in noisy)
    result.find(
        "With 5,000 samples the solver takes one or two days",
        "1 to 2 days",
        f"{seconds(worst.seconds)} at most",
        verdict(worst.seconds > DAY, not ended),
        f"With {grouped(runs.samples[0])} samples the slowest of {len(noisy)} proofs takes"
        f" {seconds(worst.seconds)}" + ("." if ended else ", and some do not end within the time limit."),
        (
            "The paper names neither its solver nor the weights of the two parts of its objective; here only"
            " the count is proven."
        ),
    )
    searches = [runs.precise[model, "search"] for model in MODELS]
    slowest = max(answer.seconds for answer in [*runs.noisy.values(), *runs.precise.values()])
    result.find(
        "With a converged simulation the solver needs seconds",
        "seconds",
        spread([a.seconds for a in searches], seconds),
        verdict(all(a.is_count_proven and a.seconds < 60 for a in searches)),
        (
            "On the reference matrix our search proves the count in"
            f" {spread([a.seconds for a in searches], seconds)}; the slowest of all runs of this section took"
            f" {seconds(slowest)}."
        ),
    )
    spent = [sum(answer.seconds for answer in some) for some in (noisy, runs.precise.values())]
    ratio = spent[0] / spent[1]
    result.find(
        "Noise makes the problem much harder",
        "seconds to days",
        f"{ratio:.1f} times as long",
        verdict(ratio > 10, ratio > 3),
        (
            f"All proofs on {grouped(runs.samples[0])} samples together take {seconds(spent[0])}, and all"
            f" proofs on the reference matrix {seconds(spent[1])}: a factor of {ratio:.1f}."
        ),
    )
    pairs = [
        (solver, runs.noisy[n, MODELS[0], solver].seconds > runs.noisy[n, MODELS[1], solver].seconds)
        for n in runs.samples
        for solver in runs.solvers
    ]
    search, ilp = ([slower for solver, slower in pairs if (solver == "search") == ours] for ours in (True, False))
    result.find(
        "The cooperative model is harder to solve",
        "yes",
        f"ILP slower in {sum(ilp)} of {len(ilp)} pairs, our search in {sum(search)} of {len(search)}",
        verdict(all(ilp), sum(ilp) > len(ilp) / 2),
        (
            f"The cooperative problem takes longer in {sum(ilp)} of {len(ilp)} pairs of runs of an ILP"
            f" solver, and in {sum(search)} of {len(search)} pairs of runs of our search."
        ),
    )


def _judge_placements(study, runs, result):
    fewest = max(runs.missed.values())
    second = [
        max(
            missed(study.reference, study.table_answer(n, model, objective).selected, model)
            for model, objective in ((MODELS[0], "signal"), (MODELS[0], "effective-links"), (MODELS[1], "links"))
        )
        for n in study.effort.samples
    ]
    labels = len(study.reference.labels)
    result.find(
        "Poor simulations lead to poor placements",
        "more transceivers, skewed outcomes",
        f"labels missed in truth: up to {fewest}; with a second objective up to {listed(second)}",
        verdict(max(fewest, *second) > 0 and second[-1] < second[0], max(fewest, *second) > 0),
        (
            f"On the reference matrix the placements of this table miss up to {fewest} of {labels} labels"
            f" ({percent(fewest / labels, 1)}). With links or signal as the second objective they miss up to"
            f" {listed(second)} for {listed([grouped(n) for n in study.effort.samples])} samples."
        ),
        (
            "A second objective removes apparent surplus, and some of that surplus is noise. A plan therefore"
            " needs verification with independent samples."
            if max(second) > fewest
            else ""
        ),
    )
