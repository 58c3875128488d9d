"""Photometric files as laboratories and programs write them."""

import re

from rows import Row, expect_success, refuses, run


def peak(store):
    """W/sr"""

    def measure(_):
        text = expect_success(run("inspect", store)).out
        return float(re.search(r"^ +unit +\S+ +\S+ +\S+ +(\S+)", text, re.MULTILINE)[1])

    return measure


ROWS = [
    Row(
        "planes_flow_ies.json", "0.3864 W/sr, as in lines", peak("planes_flow_ies.json"), lambda value: value == 0.3864
    ),
    Row("one_line_ies.json", "0.3864 W/sr", peak("one_line_ies.json"), lambda value: value == 0.3864),
    Row("uplight_ldt.json", "0.259 W/sr", peak("uplight_ldt.json"), lambda value: abs(value - 0.259) < 0.001),
    Row(
        "all_planes_ldt.json",
        "the number of planes does not fit the symmetry",
        lambda _: run("inspect", "all_planes_ldt.json"),
        refuses("line 3", "symmetry 2", "C-planes"),
    ),
]
