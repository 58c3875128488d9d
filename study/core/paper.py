"""The numbers that the paper prints. All its other results are figures without a scale."""

SAMPLES = (5000, 25000, 50000, 100000)

# Tables 3.1 and 3.2: (transceivers, % redundant), minimising transceivers, and minimising transceivers and links.
OPTIMAL = {5000: ((8, 54), (8, 41)), 25000: ((6, 21), (6, 17)), 50000: ((6, 27), (6, 9)), 100000: ((5, 2), (5, 1))}
GREEDY = {5000: ((10, 77), (10, 71)), 25000: ((9, 72), (9, 72)), 50000: ((9, 70), (8, 58)), 100000: ((9, 59), (9, 60))}

# Table 3.3: transceivers; transceivers and signal; transceivers and links.
COOPERATIVE = {5000: (6, 6, 6), 25000: (5, 5, 5), 50000: (4, 4, 4), 100000: (4, 4, 4)}

# 3.5.4: % of zeros in M before and after the cut-off, and the largest speed-up of the solver.
ZEROS_BEFORE = (0, 7)
ZEROS_AFTER = (40, 50)
CUT_OFF_SPEED = 15

# 3.5.3: most labels of the cooperative placement are below the first excess (%); many of the non-cooperative
# placement are within the second.
COOPERATIVE_EXCESS = 200
NON_COOPERATIVE_EXCESS = (400, 500)
