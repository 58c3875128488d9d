"""More random values of test_misuse.py, and the ends of test_ends.py more often."""

import test_ends
import test_misuse


class SlowMisuse(test_misuse.Misuse):
    SEEDS = (2, 3)


class SlowEnds(test_ends.Ends):
    TIMES = 3


del test_ends.Ends, test_ends.Forks, test_misuse.Misuse  # otherwise unittest runs them here, too
