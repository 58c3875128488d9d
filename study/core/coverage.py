"""The labels that a placement misses on a matrix, and the pairs that noise moves across the threshold."""

from study.core.text import grouped


def missed(signals, selected, model):
    """The number of labels that a placement does not reach on a matrix."""
    chosen = signals.mean[:, signals.columns(selected)]
    got = chosen.sum(axis=1) if model == "cooperative" else chosen.max(axis=1)
    return int((got < signals.requirement).sum())


def noise(study):
    """A sentence on the entries that noise moves across the threshold with the fewest samples."""
    noisy, truth = (
        one.mean >= one.requirement[:, None] for one in (study.uniform(study.effort.samples[0]), study.reference)
    )
    return (
        f"With {grouped(study.effort.samples[0])} samples, noise moves"
        f" {grouped(int((truth & ~noisy).sum()))} pairs below the threshold and"
        f" {grouped(int((noisy & ~truth).sum()))} pairs above it."
    )
