"""Solver time against samples and against the cut-off: 3.5.4."""

import numpy as np

from reproduction import page, paper
from reproduction.charts import Chart, decades, series_legend
from reproduction.findings import Section, verdict
from reproduction.placements import missed
from reproduction.signals import write_variant
from reproduction.text import grouped, listed, percent, seconds, spread

MODELS = ("cooperative", "non-cooperative")


def timed(study, name, signal_file, model, solver):
    """An answer with the fewest transceivers; `solver` is search (ours) or a MIP back end."""
    choice = ["--solver", "auto"] if solver == "search" else ["--solver", "mip", "--backend", solver]
    return study.place(f"time-{name}-{model}-{solver}", signal_file, "--model", model, *choice)


def cut_file(study, samples, cut):
    """The matrix with entries below a share of the requirement set to 0."""
    if cut == 0:
        return study.uniform_file(samples)
    signals = study.uniform(samples)
    mean = np.where(signals.mean >= cut * signals.requirement[:, None], signals.mean, 0)
    return write_variant(signals.path, study.program.folder / f"cut-{samples}-{cut:g}.h5", mean=mean)


def _time(answer):
    """Seconds, with what is open where the time ran out."""
    return seconds(answer.seconds) + ("" if answer.is_count_proven else f", {answer.units} open")


def _series_chart(x_values, series, x_title, x_words, log_x):
    times = [max(time, 0.01) for one in series for time in one]
    ticks = decades(min(times), max(times) * 1.01)
    low = min(x_values) * 0.8 if log_x else min(x_values) - 0.02 * (max(x_values) - min(x_values) + 1)
    high = max(x_values) * 1.25 if log_x else 1.02 * max(x_values)
    chart = Chart((low, high), (ticks[0], max(ticks[-1], ticks[0] * 10)), x_title, "seconds", log_x=log_x, log_y=True)
    chart.ticks(x_values, ticks, x_words)
    for k, one in enumerate(series):
        chart.line([(x, max(time, 0.01)) for x, time in zip(x_values, one)], k)
    return chart.svg(f"Seconds against {x_title}")


def section(study):
    effort = study.effort
    result = Section("Solver time", "3.5.4", "How long does the proof of the fewest transceivers take, depending on the "
                     "quality of the simulation, and on a cut-off of small signals?")
    solvers = ("search", *effort.backends)
    rows, answers, losses = [], {}, {}
    for samples in effort.solver_samples:
        for model in MODELS:
            for solver in solvers:
                answers[samples, model, solver] = timed(study, samples, study.uniform_file(samples), model, solver)
                losses[samples, model, solver] = missed(study.reference, answers[samples, model, solver].selected, model)
            rows.append((grouped(samples), model, *(_time(answers[samples, model, solver]) for solver in solvers),
                         *(losses[samples, model, solver] for solver in solvers)))
    truth = {(model, solver): timed(study, "reference", study.reference_file, model, solver) for model in MODELS for solver in solvers}
    rows += [("reference", model, *(_time(truth[model, solver]) for solver in solvers), *("" for _ in solvers)) for model in MODELS]
    names = ("our search", *(f"MIP ({backend})" for backend in effort.backends))
    header = ("samples", "model", *names, *(f"missed in truth: {name}" for name in names))
    result.tables["solver_time"] = (header, rows)
    mip = effort.backends[0]
    pieces = []
    if len(effort.solver_samples) > 1:
        series = [[answers[n, model, solver].seconds for n in effort.solver_samples]
                  for model, solver in ((MODELS[0], "search"), (MODELS[0], mip), (MODELS[1], "search"), (MODELS[1], mip))]
        pieces.append(page.figure("Time against samples", _series_chart(effort.solver_samples, series, "samples a label", None, True)
                                  + series_legend([f"cooperative, search", f"cooperative, MIP ({mip})", "non-cooperative, search",
                                                   f"non-cooperative, MIP ({mip})"])))

    cut_rows, gains, optimal = [], [], []
    cut_series = {}
    cut_samples = sorted({effort.solver_samples[0], effort.solver_samples[-1]})
    for samples in cut_samples:
        whole = None
        for cut in effort.cut_offs:
            path = cut_file(study, samples, cut)
            zeros = float((study.uniform(samples).mean < cut * study.uniform(samples).requirement[:, None]).mean())
            found = {solver: timed(study, f"{samples}-cut-{cut:g}", path, "cooperative", solver) for solver in ("search", mip)}
            whole = whole or found
            gain = whole[mip].seconds / found[mip].seconds
            if cut > 0:
                if found[mip].is_count_proven:
                    gains.append(gain)
                optimal.append(found["search"].count == whole["search"].count)
            lost = missed(study.uniform(samples), found["search"].selected, "cooperative")
            cut_rows.append((grouped(samples), f"{100 * cut:g} %" if cut else "none", percent(zeros, 1), found["search"].units,
                             _time(found["search"]), _time(found[mip]), f"{gain:.1f}" if found[mip].is_count_proven else f"at most {gain:.1f}", lost))
            cut_series.setdefault(samples, []).append(found[mip].seconds)
    cut_header = ("samples", "cut-off", "zeros", "transceivers", "our search", f"MIP ({mip})", "MIP faster by", "missed without the cut-off")
    result.tables["solver_time_cut_off"] = (cut_header, cut_rows)
    pieces.append(page.figure("Time of the MIP solver against the cut-off, cooperative", _series_chart(
        [100 * cut for cut in effort.cut_offs], list(cut_series.values()), "cut-off, % of the requirement", None, False)
        + series_legend([f"{grouped(n)} samples" for n in cut_series])))
    result.add(page.row_of(pieces), page.table(header, rows, numeric=range(2, len(header)), caption="Time for the proof, by samples"),
               page.table(cut_header, cut_rows, numeric=range(1, 8), caption="Time for the proof, by cut-off (cooperative)"),
               page.paragraph(f"Time limit {effort.time_limit:g} s an answer, threads as many as cores; times are of one run on this machine. "
                              "‘Our search’ is what `place` does by itself; MIP hands the whole model to an ILP solver, as the paper did.",
                              "note"))

    slowest = max(answer.seconds for answer in [*answers.values(), *truth.values()])
    noisy = [answers[effort.solver_samples[0], model, solver] for model in MODELS for solver in solvers]
    worst = max(noisy, key=lambda answer: answer.seconds)
    result.find("With 5,000 samples the solver takes one or two days", "1 to 2 days", f"{seconds(worst.seconds)} at most",
                verdict(worst.seconds > 86400), f"With {grouped(effort.solver_samples[0])} samples the slowest of "
                f"{len(noisy)} proofs takes {seconds(worst.seconds)}" + ("." if all(a.is_count_proven for a in noisy) else
                ", and not all end in the time given.") , "The paper does not name its solver or bounds; a proof of the count alone, "
                "with ties left to later, is also an easier question than the paper's weighted sum.")
    precise = [truth[model, "search"] for model in MODELS]
    result.find("With a converged simulation the solver needs seconds", "seconds", spread([a.seconds for a in precise], seconds),
                verdict(all(a.is_count_proven and a.seconds < 60 for a in precise)),
                f"On the reference matrix our search proves the count in {spread([a.seconds for a in precise], seconds)}; the slowest "
                f"of all runs here took {seconds(slowest)}.")
    ratios = [answers[effort.solver_samples[0], model, solver].seconds / truth[model, solver].seconds for model in MODELS for solver in solvers]
    result.find("Noise makes the problem much harder", "seconds to days", f"{spread(ratios, '{:.1f}'.format)} times the reference's",
                verdict(max(ratios) > 10, max(ratios) > 2),
                f"A proof on {grouped(effort.solver_samples[0])} samples takes {spread(ratios, '{:.1f}'.format)} times as long as on the reference matrix.")
    by_solver = {name: [losses[n, model, solver] for n in effort.solver_samples for model in MODELS] for name, solver in zip(names, solvers)}
    fewest = max(loss for losses_of in by_solver.values() for loss in losses_of)
    second = [max(missed(study.reference, study.table_answer(n, model, objective).selected, model)
                  for model, objective in ((MODELS[0], "signal"), (MODELS[0], "effective-links"), (MODELS[1], "links")))
              for n in effort.samples]
    result.find("Poor simulations lead to poor placements", "more transceivers, skewed outcomes",
                f"labels missed in truth: up to {fewest}, with a second objective {listed(second)}",
                verdict(max(fewest, *second) > 0 and second[-1] < second[0], max(fewest, *second) > 0),
                f"The placements above, each with the fewest transceivers of a noisy matrix, miss up to {fewest} of {len(study.reference.labels)} labels "
                f"in truth; with links or signal as the second objective it is up to {listed(second)} for "
                f"{listed([grouped(n) for n in effort.samples])} samples.",
                "A second objective trims what looks like surplus, and noise looks like surplus. So a plan needs a check on fresh samples."
                if max(second) > fewest else "")
    slower = [answers[n, MODELS[0], solver].seconds > answers[n, MODELS[1], solver].seconds for n in effort.solver_samples for solver in solvers]
    result.find("The cooperative model is harder to solve", "yes", f"slower in {sum(slower)} of {len(slower)} pairs",
                verdict(all(slower), sum(slower) > len(slower) / 2),
                f"The cooperative question takes longer in {sum(slower)} of {len(slower)} pairs of runs.")
    kept = all(optimal)
    open_runs = len(optimal) - len(gains)
    gains = gains or [0.0]
    result.find("A cut-off speeds the solver up, up to 15-fold, and stays optimal", f"up to {paper.CUT_OFF_SPEED}-fold, still optimal",
                f"{spread(gains, '{:.1f}'.format)}-fold, count {'unchanged' if kept else 'changed'}",
                verdict(max(gains) > 2 and kept, max(gains) > 1.2),
                (f"With a cut-off the MIP solver is {spread(gains, '{:.1f}'.format)} times as fast" if open_runs < len(optimal) else
                 "With a cut-off the MIP solver does not finish")
                + (f" where it ends in time (in {open_runs} of {len(optimal)} cases it does not)" if 0 < open_runs < len(optimal) else "")
                + ", and the number of transceivers "
                + ("stays the same." if kept else f"rises in {optimal.count(False)} of {len(optimal)} cases."),
                "A cut-off only takes signal away, so every placement it allows is valid, but the fewest may become more.")
    return result
