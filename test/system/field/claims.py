"""Stores whose certified bound is below that of the matrix, or equal to it: page 1 and the results of a batch name
the certified one, and call all else simulated. `at_least` EUR are certified, `proven` are for the matrix."""

import csv
import html
import json
import re

from rows import INPUTS, Row, equals, output, run

STORE = "two_prices.json"
AMOUNT = r"([0-9,]+(?:\.[0-9]+)?) EUR"


def placement(folder):
    return json.loads((folder / "placement.json").read_text(encoding="utf-8"))


def first_page(folder):
    header = re.search(r"<header.*?</header>", (folder / "report.html").read_text(encoding="utf-8"), re.DOTALL)
    return html.unescape(re.sub(r"<[^>]*>", " ", header.group())).replace("\u00a0", " ")


def amount(pattern, text):
    """The amount that a sentence names, or None without the sentence."""
    found = re.search(pattern, text)
    return found and float(found.group(1).replace(",", ""))


def faults(page, plan):
    """The claims of page 1 beyond the certificate and the matrix."""
    certificate, spend = plan["certificate"], plan["objective_value"]
    at_least, proven = certificate["cost_lower_bound"], plan["lower_bound"]
    is_minimum = at_least >= spend * (1 - 1e-9)
    open_labels = certificate["missed"] + certificate["undecided"] + certificate["not_verified_yet"]
    found = []
    if "No cheaper choice is enough." in page and not is_minimum:
        found.append("an uncertified minimum without an addition")
    if "confirms this with" in page and (not is_minimum or open_labels):
        found.append("'this' was not confirmed")
    named = amount(rf"confirms with [0-9.]+ % confidence that [^.]* and that at least {AMOUNT}", page)
    if named is not None and not at_least - 0.01 <= named <= at_least + 1e-6:
        found.append(f"{named} confirmed, {at_least} certified")
    named = amount(rf"For the simulated signals, it is proven that at least {AMOUNT}", page)
    if named is not None and not proven - 0.01 <= named <= proven + 1e-6:
        found.append(f"{named} proven, {proven} for the matrix")
    if "It is proven that at least" in page:
        found.append("a bound without its scope")
    return found


def planned(options):
    def measure(scratch):
        end = run(f"plan {STORE} -o {scratch}/plan --quiet {options}")
        if end.status not in (0, 3):
            raise RuntimeError(str(end))
        return faults(first_page(scratch / "plan"), placement(scratch / "plan")) or "no fault"

    return measure


def batch_bounds(scratch):
    """The bound of a store in results.csv, and that of its certificate."""
    (scratch / "stores").mkdir()
    (scratch / "stores/a.json").write_bytes((INPUTS / STORE).read_bytes())
    output("batch stores -o r --quiet -- --lexicographic", folder=scratch)
    with open(scratch / "r/results.csv", newline="", encoding="utf-8") as file:
        bound = int(next(csv.DictReader(file))["lower_bound"])
    return bound, placement(scratch / "r/plans/a")["certificate"]["count_lower_bound"]


ROWS = [
    *(
        Row(name, "no fault", planned(options), equals("no fault"), is_slow=True)
        for name, options in (
            ("certified as for the matrix", ""),
            ("greedy selection", "--solver greedy"),
            ("budget for a part of the bound", "--budget 0.2 --survive-failure"),
            ("no budget", "--budget 0.001"),
        )
    ),
    Row(
        "bound in the results of a batch",
        "that of the certificate",
        batch_bounds,
        lambda bounds: bounds[0] == bounds[1] > 0,
        is_slow=True,
    ),
]
