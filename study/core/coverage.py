"""What placements do on a matrix: the labels that they miss, and what noise does to the links."""

from study.core.text import grouped


def missed(signals, selected, model):
    """Labels that a placement does not meet on a matrix."""
    chosen = signals.mean[:, signals.columns(selected)]
    got = chosen.sum(axis=1) if model == "cooperative" else chosen.max(axis=1)
    return int((got < signals.requirement).sum())


def noise(study):
    """How noise moves entries across the threshold with the fewest samples."""
    noisy, truth = (
        one.mean >= one.requirement[:, None]
        for one in (study.uniform(study.effort.samples[0]), study.reference)
    )
    return (
        f"With {grouped(study.effort.samples[0])} samples noise takes"
        f" {grouped(int((truth & ~noisy).sum()))} pairs below the threshold and lifts"
        f" {grouped(int((noisy & ~truth).sum()))} above it: it opens gaps, and it closes some."
    )
