"""Random edits of a shop with fixtures."""

import copy
import itertools

numbers = itertools.count()


def random_ops(random, document):
    """Operations that fit the document, and change it."""
    fixtures = document["fixtures"]
    kind = random.choice(("move", "move", "copy", "remove", "name"))
    index = random.randrange(len(fixtures))
    path = f"/fixtures/{index}"
    number = next(numbers)
    if kind == "copy" or (kind == "remove" and len(fixtures) < 3):
        new = copy.deepcopy(fixtures[index]) | {"id": f"copy {number}"}
        return [{"path": f"/fixtures/{random.randrange(len(fixtures) + 1)}", "after": new}]
    if kind == "remove":
        return [{"path": path, "before": fixtures[index]}]
    if kind == "name":
        return [{"path": "/name", "before": document["name"], "after": f"Aisle {number}"}]
    at = fixtures[index]["at"]
    # The fraction makes the place new.
    place = round(random.uniform(0, 8), 2) + 1e-6 * (number % 10000)
    return [
        {"path": f"{path}/at/0", "before": at[0], "after": place},
        {"path": f"{path}/at/1", "before": at[1], "after": round(at[1] + random.choice((-0.1, 0.1)), 3)},
    ]
