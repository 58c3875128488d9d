"""Tables that fit two readings, ids that a spreadsheet has changed, names of columns, and NPY headers."""

import shutil

from rows import INPUTS, Row, refuses, run


def place(file, *options):
    return lambda _: run("place", file, *options)


def place_text(text, *options):
    def measure(scratch):
        (scratch / "matrix.csv").write_text(text, encoding="utf-8")
        return run("place", "matrix.csv", "--threshold", "0.2", *options, folder=scratch)

    return measure


def says(*words):
    return lambda end: end.status == 0 and all(word in end.out for word in words)


def planogram_of(*articles):
    """The warnings about the planogram of a store with these articles."""

    def measure(scratch):
        shutil.copy(INPUTS / "scientific_csv.json", scratch / "store.json")
        lines = [f"{article};A1;front;2;{k}" for k, article in enumerate(articles, 1)]
        text = "\n".join(["article;fixture;face;level;position", *lines])
        (scratch / "scientific.csv").write_text(text, encoding="utf-8")
        end = run("inspect", "store.json", folder=scratch)
        return [line for line in end.out.splitlines() if "spreadsheet" in line]

    return measure


def without_header(scratch):
    text = (INPUTS / "number_ids.csv").read_text(encoding="utf-8").split("\n", 1)[1]
    (scratch / "rows.csv").write_text(text, encoding="utf-8")
    return run("place", "rows.csv", "--threshold", "0.2", "--read-as", "labels", folder=scratch)


def names_all(*texts):
    return lambda warnings: len(warnings) == 1 and all(text in warnings[0] for text in texts)


CHANGED = ("#N/A", "#REF!", "#VALUE!", "4006381333931.0", '="4006381333948"')
AMBIGUOUS = refuses("may be ids or signals", "'header'", "(--read-as)")
TWO_LABELS = says("2 labels")

ROWS = [
    Row("number_header.csv", "refused, with a choice", place("number_header.csv", "--threshold", "0.2"), AMBIGUOUS),
    Row(
        "number_header.csv, --read-as header",
        "2 labels",
        place("number_header.csv", "--threshold", "0.2", "--read-as", "header"),
        TWO_LABELS,
    ),
    Row("number_ids.csv", "refused, with a choice", place("number_ids.csv", "--threshold", "0.2"), AMBIGUOUS),
    Row(
        "number_ids.csv, --read-as ids",
        "2 labels",
        place("number_ids.csv", "--threshold", "0.2", "--read-as", "ids"),
        TWO_LABELS,
    ),
    Row("number_ids.csv without its first row, --read-as labels", "2 labels", without_header, TWO_LABELS),
    Row(
        "article numbers beside signals, no header",
        "refused, with a choice",
        place_text("4006381333931,0.5,0.2\n4006381333948,0.3,0.6\n"),
        refuses("may be ids or signals", "'labels'", "(--read-as)"),
    ),
    Row("whole numbers below T1,T2,T3", "refused, with a choice", place_text("T1,T2,T3\n3,0,2\n1,1,4\n"), AMBIGUOUS),
    Row(
        "whole numbers between tabs",
        "refused, with a choice",
        place_text("2\t2\t1\n1\t0\t5\n1\t1\t7\n"),
        refuses("CSV or sparse text", "'signals' or 'sparse'", "(--read-as)"),
    ),
    Row("decimals between tabs", "read", place_text("0.5\t0.2\t0.1\n0.3\t0.6\t0.2\n"), says("2 labels")),
    Row(
        "numbers as ids without a field above the labels",
        "read",
        place_text("7,8\nL1,0.5,0.25\nL2,0,0.5\n"),
        says("2 labels"),
    ),
    Row("an empty last column", "read", place_text("label,T1,\nA,0.5,\nB,0.5,\n"), says("2 labels")),
    Row(
        "both_forms.scp",
        "refused, with a choice",
        place("both_forms.scp"),
        refuses("fits both forms", "'scp' or 'rail'", "(--read-as)"),
    ),
    Row("both_forms.scp, --read-as scp", "1 unit", place("both_forms.scp", "--read-as", "scp"), says("1 transceiver")),
    Row(
        "both_forms.scp, --read-as rail",
        "2 units",
        place("both_forms.scp", "--read-as", "rail"),
        says("2 transceivers"),
    ),
    Row(
        "scientific_csv.json",
        "a warning with the lines",
        lambda _: run("inspect", "scientific_csv.json"),
        says("warning: ", "scientific.csv: ", "'4,00638E+12' in lines 2, 3 and 4"),
    ),
    Row("errors, decimals, formulas as ids", "a warning with all of them", planogram_of(*CHANGED), names_all(*CHANGED)),
    Row(
        "dates and missing values as ids",
        "a warning with all of them",
        planogram_of("01.02.2024", "01-Feb", "NaN"),
        names_all("01.02.2024", "01-Feb", "NaN"),
    ),
    Row(
        "ids of articles and places",
        "no warning",
        planogram_of("4006381333931", "A-1.0", "3E12", "1.2"),
        lambda warnings: warnings == [],
    ),
    Row("capitals_csv.json", "read", lambda _: run("inspect", "capitals_csv.json"), says("2 labels")),
    *(
        Row(f"{name}.npy", "read", place(f"{name}.npy", "--threshold", "0.2"), TWO_LABELS)
        for name in ("other_order", "double_quotes", "python2")
    ),
]
