#!/usr/bin/env python3
"""Usage: test/data/make_written_numbers.py > test/data/written_numbers.tsv

Writes spellings of known numbers by the habits of several countries, one in each line: the spelling; the unit of length
of its field, or "-" for a number without one; another number that the table has before it, or "-"; the number that the
spelling stands for (of lengths in m); and "read", or "refused" for a spelling that stands for another number elsewhere.
"""

import random
from fractions import Fraction

METRES = {"m": Fraction(1), "cm": Fraction(1, 100), "mm": Fraction(1, 1000), "ft": Fraction(381, 1250), "in": Fraction(127, 5000)}
NAMES = {"m": ["m", " m", "M"], "cm": ["cm", " cm", "\u00a0cm", "CM"], "mm": ["mm", " mm", "\u202fmm", "Mm"]}
IMPERIAL = {"ft": ["ft", " ft", "'", "\u2032", " feet", " foot", "\u2019"], "in": ["in", " in", '"', "\u2033", " inch", " inches", "''"]}
# Decimal mark and mark of thousands.
HABITS = [(".", ","), (",", "."), (",", "\u00a0"), (",", "\u202f"), (".", "'"), (".", "\u2019"), (",", " "), (".", " "), (".", ""), (",", "")]


def spelling(value, decimals, mark, group):
    whole, behind = f"{value:.{decimals}f}".split(".") if decimals else (str(int(value)), "")
    if group:
        whole = f"{int(whole):,}".replace(",", group)
    return whole + (mark + behind if decimals else "")


def is_unclear(text, is_imperial):
    """One mark before three digits: as decimals or as thousands."""
    for mark in ".,":
        first, found, last = text.partition(mark)
        is_one = found and first.isdigit() and last.isdigit() and first[0] != "0"
        if is_one and len(first) <= 3 and len(last) == 3 and not (is_imperial and mark == "."):
            return True
    return False


def decimal_case(rng):
    mark, group = rng.choice(HABITS)
    unit = rng.choice(["-", "m", "cm", "mm", "cm", "mm"] + (["ft", "in"] if mark == "." and group in ("", ",") else []))
    own = unit if unit == "-" or rng.random() < 0.5 else rng.choice(list(METRES) if mark == "." and group in ("", ",") else ["m", "cm", "mm"])
    decimals = rng.choice([0, 0, 1, 2, 3, 3])
    number = Fraction(rng.randrange(10 ** rng.choice([1, 2, 3, 4, 5, 6, 7])), 10**decimals)
    text = spelling(float(number), decimals, mark, group)
    is_named = own != unit or (unit != "-" and rng.random() < 0.3)
    is_imperial = is_named and own in IMPERIAL
    if is_imperial and any(c in text for c in "'\u2019"):
        return None
    shown = rng.choice(["-", "0" + mark + "5"])
    # Another number shows how decimals are written: thousands with the other mark are not what programs export.
    refused = is_unclear(text, is_imperial) and (shown == "-" or mark not in text)
    name = rng.choice((IMPERIAL if own in IMPERIAL else NAMES)[own]) if is_named else ""
    sign = rng.choice(["", "", "", "-", "\u2212", "+"])
    value = (-number if sign in ("-", "\u2212") else number) * (METRES[own] if unit != "-" else 1)
    return sign + text + name, unit, shown, value, "refused" if refused else "read"


def foot_case(rng):
    feet, inches = rng.randrange(1, 40), Fraction(rng.randrange(12))
    below = rng.choice([0, 2, 4, 8, 16])
    above = rng.randrange(1, below) if below else 0
    share = f" {above}/{below}" if below else ""
    mark = rng.choice(['"', "\u2033", " in", "in", "''", "\u201d"])
    foot = rng.choice(["'", "\u2032", " ft", "ft", "\u2019"])
    between = rng.choice(["-", " ", ""]) if foot != "ft" else rng.choice(["-", " "])
    form = rng.choice(["both", "both", "inches", "unmarked"])
    value = inches + (Fraction(above, below) if below else 0)
    unit = rng.choice(list(METRES))
    if form == "inches":
        return f"{inches}{share}{mark}", unit, "-", value * METRES["in"], "read"
    text = f"{feet}{foot}{between}{inches}{share}"
    whole = (12 * feet + value) * METRES["in"]
    if form == "unmarked":
        return text, unit, "-", whole, "refused"
    return text + mark, unit, "-", whole, "read"


def main():
    rng = random.Random(87)
    cases = {}
    while len(cases) < 2200:
        case = (foot_case if rng.random() < 0.15 else decimal_case)(rng)
        if case:
            cases.setdefault(case[:3], case)
    for text, unit, shown, value, outcome in cases.values():
        print(text, unit, shown, repr(float(value)), outcome, sep="\t")


main()
