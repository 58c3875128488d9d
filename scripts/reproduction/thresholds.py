"""The counts with a threshold 2 % lower and higher."""

from reproduction import page
from reproduction.findings import OURS, Section
from reproduction.text import grouped

FACTORS = (0.98, 1, 1.02)


def section(study):
    result = Section("Threshold 2 % lower and higher", "3.5", "Do the numbers of transceivers hang on the threshold that happened to be chosen?")
    threshold = study.reference.requirement[0]
    files = [(grouped(n), study.uniform_file(n)) for n in study.effort.samples] + [("reference", study.reference_file)]
    rows, moved = [], 0
    for words, path in files:
        row = [words]
        for model in ("cooperative", "non-cooperative"):
            answers = [study.place(f"threshold-{path.stem}-{model}-{factor:g}", path, "--model", model, "--threshold",
                                   f"{factor * threshold:.6g}") for factor in FACTORS]
            row += [answer.units for answer in answers]
            moved += len({answer.count for answer in answers}) > 1
        rows.append(tuple(row))
    header = ("samples", *(f"{model} {words}" for model in ("cooperative,", "non-cooperative,") for words in ("−2 %", "as it is", "+2 %")))
    result.tables["thresholds"] = (header, rows)
    result.add(page.table(header, rows, numeric=range(1, 7)))
    total = 2 * len(files)
    result.find("", "", "", OURS, f"Of {total} counts {moved} {'changes' if moved == 1 else 'change'} within ±2 % of the threshold "
                f"({threshold:g} W/m²).", "" if moved == 0 else "Where a count changes, a label is borderline, and a plan at this threshold "
                "rests on less than the materials are known.")
    return result
