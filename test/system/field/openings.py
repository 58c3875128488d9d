"""Units whose light comes through a door or from the corner beside a column: their errors must not be too small.

The tables STORE_truth.csv are the signals by particles, which start at the units:
simulate STORE.json --estimator uniform --strategy particle --direct exact --samples 400000 --seed 77
"""

from functools import partial

from rows import INPUTS, Row, output, table

SEEDS = range(1, 9)
STUDENT = 2.131  # 95 %, 15 degrees of freedom


def column(path, unit):
    names, *lines = table(path)
    return [float(line[names.index(unit)]) for line in lines]


def shares(store, unit, scratch):
    """In runs of 16 batches, in percent: the entries of a unit whose 95 % interval contains the truth, and those more
    than three standard errors from it."""
    truth = column(INPUTS / f"{store}_truth.csv", unit)
    found = []
    for seed in SEEDS:
        out = scratch / f"{seed}.h5"
        output(f"simulate {store}.json -o {out} --samples 2096 --seed {seed} --quiet")
        estimates = []
        for what in ("mean", "standard-error"):
            output(f"export {out} --what {what} -o {scratch}/{what}.csv")
            estimates.append(column(scratch / f"{what}.csv", unit))
        found += [abs(mean - true) / error for mean, error, true in zip(*estimates, truth)]
    limits = (sum(z <= STUDENT for z in found), sum(z > 3 for z in found))
    return tuple(round(100 * count / len(found), 1) for count in limits)


def is_honest(result):
    within, beyond = result
    return 90 <= within <= 99 and beyond <= 4


ROWS = [
    Row(
        f"{store}.json, {unit}",
        "about 95 % within the interval, 1 % beyond 3 errors",
        partial(shares, store, unit),
        is_honest,
        is_slow=True,
    )
    for store, unit in (("side_room", "in side room"), ("unit_by_column", "at 15 cm, far side"))
]
