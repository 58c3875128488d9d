"""Robustness of the counts: thresholds 2 % lower and higher, and other seeds."""

from collections import Counter

from study.core import page, seeds
from study.core.answers import MODELS
from study.core.coverage import missed
from study.core.findings import Section
from study.core.text import grouped, plural

FACTORS = (0.98, 1, 1.02)


def _thresholds(study, result):
    threshold = study.reference.requirement[0]
    files = [(grouped(n), study.uniform_file(n)) for n in study.effort.samples] + [("reference", study.reference_file)]
    rows, moved = [], 0
    for words, path in files:
        row = [words]
        for model in MODELS:
            answers = [
                study.place(
                    f"threshold-{path.stem}-{model}-{factor:g}",
                    path,
                    "--model",
                    model,
                    "--threshold",
                    f"{factor * threshold:.6g}",
                )
                for factor in FACTORS
            ]
            row += [answer.units for answer in answers]
            moved += len({answer.count for answer in answers}) > 1
        rows.append(tuple(row))
    header = ("samples", *(f"{model}, {words}" for model in MODELS for words in ("−2 %", "unchanged", "+2 %")))
    result.tables["thresholds"] = (header, rows)
    result.add(
        page.table(header, rows, numeric=range(1, 7), caption="Transceivers for thresholds 2 % lower and higher")
    )
    result.tell(
        (
            f"{moved} of {2 * len(files)} counts {'changes' if moved == 1 else 'change'} within ±2 % of the"
            f" threshold ({threshold:g} W/m²)."
        ),
        (
            ""
            if moved == 0
            else (
                "A count that changes has a borderline label. A plan at this threshold then depends on"
                " materials more precisely than they are known."
            )
        ),
    )


def _seeds(study, result):
    rows, found = {}, {model: Counter() for model in MODELS}
    for seed, model, answer in seeds.answers(study):
        found[model][answer.count] += 1
        rows.setdefault(seed, [seed]).extend((answer.units, missed(study.reference, answer.selected, model)))
    header = ("seed", *(words for model in MODELS for words in (model, "missed in truth")))
    result.tables["seeds"] = (header, list(rows.values()))
    listing = page.table(*result.tables["seeds"], numeric=range(1, 5))
    result.add(page.details(f"{plural(len(rows), 'seed')}, one by one", listing))
    result.tell(
        f"With {grouped(study.effort.samples[0])} samples and {plural(len(rows), 'seed')} the counts are"
        f" {seeds.count_words(found[MODELS[0]])} with and {seeds.count_words(found[MODELS[1]])} without"
        " cooperation; the paper has one run of each."
    )


def section(study):
    result = Section(
        "Robustness of the counts",
        "3.5",
        "Do the numbers of transceivers depend on the choice of the threshold or of the random numbers?",
    )
    _thresholds(study, result)
    _seeds(study, result)
    return result
