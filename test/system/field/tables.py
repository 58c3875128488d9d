"""Tables that fit two readings, ids that a spreadsheet has changed, names of columns, and NPY headers."""

import shutil

from rows import INPUTS, Row, ends, refuses, run, says


def place(text):
    """Measures `place` of a table with this text."""

    def measure(scratch):
        (scratch / "matrix.csv").write_text(text, encoding="utf-8")
        return run("place matrix.csv --threshold 0.2", folder=scratch)

    return measure


def planogram_of(*articles):
    """The warnings about the planogram of a store with these articles."""

    def measure(scratch):
        shutil.copy(INPUTS / "scientific_csv.json", scratch / "store.json")
        lines = [f"{article};A1;front;2;{k}" for k, article in enumerate(articles, 1)]
        text = "\n".join(["article;fixture;face;level;position", *lines])
        (scratch / "scientific.csv").write_text(text, encoding="utf-8")
        end = run("inspect store.json", folder=scratch)
        return [line for line in end.out.splitlines() if "spreadsheet" in line]

    return measure


def without_header(scratch):
    text = (INPUTS / "number_ids.csv").read_text(encoding="utf-8").split("\n", 1)[1]
    (scratch / "rows.csv").write_text(text, encoding="utf-8")
    return run("place rows.csv --threshold 0.2 --read-as labels", folder=scratch)


def names_all(*texts):
    return lambda warnings: len(warnings) == 1 and all(text in warnings[0] for text in texts)


def row(name, options, expected, is_right):
    """A row of a matrix among the inputs."""
    return Row(
        f"{name}, {options}" if options else name, expected, ends(f"place {name} --threshold 0.2 {options}"), is_right
    )


CHANGED = ("#N/A", "#REF!", "#VALUE!", "4006381333931.0", '="4006381333948"')
DATES = ("01.02.2024", "01-Feb", "NaN")
PLAIN = ("4006381333931", "A-1.0", "3E12", "1.2")
CHOICE = "refused, with a choice"
AMBIGUOUS = refuses("may be ids or signals", "'header'", "(--read-as)")
ARTICLES = refuses("may be ids or signals", "'labels'", "(--read-as)")
SPARSE = refuses("CSV or sparse text", "'signals' or 'sparse'", "(--read-as)")
TWO_LABELS = says("2 labels")

ROWS = [
    row("number_header.csv", "", CHOICE, AMBIGUOUS),
    row("number_header.csv", "--read-as header", "2 labels", TWO_LABELS),
    row("number_ids.csv", "", CHOICE, AMBIGUOUS),
    row("number_ids.csv", "--read-as ids", "2 labels", TWO_LABELS),
    Row("number_ids.csv without its first row, --read-as labels", "2 labels", without_header, TWO_LABELS),
    *(
        Row(name, expected, place(text), is_right)
        for name, expected, text, is_right in (
            ("article numbers, no header", CHOICE, "4006381333931,0.5,0.2\n4006381333948,0.3,0.6\n", ARTICLES),
            ("whole numbers below T1,T2,T3", CHOICE, "T1,T2,T3\n3,0,2\n1,1,4\n", AMBIGUOUS),
            ("whole numbers between tabs", CHOICE, "2\t2\t1\n1\t0\t5\n1\t1\t7\n", SPARSE),
            ("decimals between tabs", "read", "0.5\t0.2\t0.1\n0.3\t0.6\t0.2\n", TWO_LABELS),
            ("numbers as ids, no field above the labels", "read", "7,8\nL1,0.5,0.25\nL2,0,0.5\n", TWO_LABELS),
            ("an empty last column", "read", "label,T1,\nA,0.5,\nB,0.5,\n", TWO_LABELS),
        )
    ),
    Row(
        "both_forms.scp",
        CHOICE,
        ends("place both_forms.scp"),
        refuses("fits both forms", "'scp' or 'rail'", "(--read-as)"),
    ),
    Row("both_forms.scp, --read-as scp", "1 unit", ends("place both_forms.scp --read-as scp"), says("1 transceiver")),
    Row(
        "both_forms.scp, --read-as rail", "2 units", ends("place both_forms.scp --read-as rail"), says("2 transceivers")
    ),
    Row(
        "scientific_csv.json",
        "a warning with the lines",
        ends("inspect scientific_csv.json"),
        says("warning: ", "scientific.csv: ", "'4,00638E+12' in lines 2, 3 and 4"),
    ),
    Row("errors, decimals, formulas as ids", "a warning with all of them", planogram_of(*CHANGED), names_all(*CHANGED)),
    Row("dates and missing values as ids", "a warning with all of them", planogram_of(*DATES), names_all(*DATES)),
    Row("ids of articles and places", "no warning", planogram_of(*PLAIN), lambda warnings: warnings == []),
    Row("capitals_csv.json", "read", ends("inspect capitals_csv.json"), TWO_LABELS),
    *(row(f"{name}.npy", "", "read", TWO_LABELS) for name in ("other_order", "double_quotes", "python2")),
]
