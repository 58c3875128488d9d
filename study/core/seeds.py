"""Several runs with the fewest samples, to show how the counts vary between seeds."""

from collections import Counter

from study.core.answers import MODELS
from study.core.coverage import noise
from study.core.findings import verdict
from study.core.study import STORE
from study.core.text import grouped, listed, plural, spread


def answers(study):
    """The placements with the fewest transceivers: (seed, model, answer)."""
    samples = study.effort.samples[0]
    for seed in range(1, study.effort.seeds + 1):
        path = study.uniform_file(samples)
        if seed > 1:
            path = study.program.run(
                f"uniform-{samples}-{seed}.h5",
                ["simulate", STORE, "--estimator", "uniform", "--samples", samples, "--seed", seed],
                [STORE],
            )
        for model in MODELS:
            yield seed, model, study.place(f"seed-{samples}-{seed}-{model}", path, "--model", model)


def counts(study, model):
    return Counter(answer.count for _, kind, answer in answers(study) if kind == model)


def count_words(found):
    return " and ".join(f"{count} in {plural(times, 'run')}" for count, times in sorted(found.items()))


def judge_trend(study, result, model, ours, printed, reference):
    """Judges whether fewer samples need more transceivers: in the rows of the table, and with other seeds."""
    truth = study.fewest_in_truth(model)
    seeds = counts(study, model)
    samples = [grouped(n) for n in study.effort.samples]
    more = sum(times for count, times in seeds.items() if count > truth.count)
    result.find(
        "More samples need fewer transceivers",
        spread(printed, "{}".format),
        f"{spread(ours, '{}'.format)}; with {samples[0]} samples {count_words(seeds)}",
        verdict(ours[-1] < ours[0] and more > seeds.total() / 2, ours[-1] < ours[0] or more > 0),
        (
            f"The count is {listed(ours)} for {listed(samples)} samples and {truth.units} on the reference"
            f" matrix; the paper has {listed(printed)}. With {samples[0]} samples and several seeds it is"
            f" {count_words(seeds)}."
        ),
        noise(study),
        reference=reference,
    )
