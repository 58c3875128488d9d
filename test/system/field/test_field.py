"""Checks the rows that take no time."""

import pathlib
import tempfile
import unittest

import rows


class Field(unittest.TestCase):
    IS_SLOW = False

    def test_rows(self):
        count = 0
        for kind, chosen in rows.kinds().items():
            for row in chosen:
                if row.is_slow != self.IS_SLOW:
                    continue
                count += 1
                with self.subTest(kind=kind, row=row.name), tempfile.TemporaryDirectory() as scratch:
                    result = row.measure(pathlib.Path(scratch))
                    self.assertTrue(row.is_right(result), f"{result}; expected: {row.expected}")
        self.assertGreater(count, 0)
