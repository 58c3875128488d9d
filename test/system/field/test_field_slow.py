"""Checks the rows that simulate for seconds."""

import test_field


class SlowField(test_field.Field):
    IS_SLOW = True


del test_field.Field  # otherwise unittest runs it here, too
