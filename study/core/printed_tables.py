"""Prints tables 3.1 to 3.3 as text from the folder of scripts/thesis-tables, as the last step of that script."""

import sys

from study.core import paper
from study.core.answers import table_answer


def print_table(title, samples, columns, row):
    print(title)
    print(f"{'samples':>8}" + "".join(f" | {column:<14} {'paper':<8}" for column in columns))
    for count in samples:
        print(f"{count:>8}" + "".join(f" | {ours:<14} {theirs:<8}" for ours, theirs in row(count)))
    print()


def print_tables(folder, samples):
    def non_cooperative(solver, printed):
        return lambda count: [
            (table_answer(folder, count, "non-cooperative", objective, solver).with_share, f"{k} {share}%")
            for objective, (k, share) in zip(("count", "links"), printed[count])
        ]

    print_table(
        "Table 3.1: non-cooperative, optimal; transceivers and labels reached redundantly",
        samples,
        ("count", "and links"),
        non_cooperative("auto", paper.OPTIMAL),
    )
    print_table(
        "Table 3.2: non-cooperative, greedy", samples, ("count", "and links"), non_cooperative("greedy", paper.GREEDY)
    )
    # In the cooperative model all links are a constant times the count, so they cannot rank selections.
    print_table(
        (
            "Table 3.3: cooperative, optimal; transceivers. Our links are effective links (signals that meet the"
            " requirement),\nbecause the paper's links are a multiple of the number of transceivers"
        ),
        samples,
        ("count", "and signal", "and eff. links"),
        lambda count: [
            (table_answer(folder, count, "cooperative", objective, "auto").units, f"{k}")
            for objective, k in zip(("count", "signal", "effective-links"), paper.COOPERATIVE[count])
        ],
    )


if __name__ == "__main__":
    print_tables(sys.argv[1], [int(word) for word in sys.argv[2:]])
