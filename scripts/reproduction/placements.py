"""Tables 3.1 and 3.3, Figs 3.2 and 3.4: optimal placements in both models."""

import numpy as np

from reproduction import page, paper
from reproduction.findings import Section, verdict
from reproduction.store_map import legend
from reproduction.text import grouped, listed, percent, spread

LEGEND = [("often", "reached by two or more"), ("once", "by one"), ("missed", "by none"), ("unit", "chosen transceiver")]


def missed(signals, selected, model):
    """Labels that a placement does not meet on a matrix."""
    chosen = signals.mean[:, signals.columns(selected)]
    got = chosen.sum(axis=1) if model == "cooperative" else chosen.max(axis=1)
    return int((got < signals.requirement).sum())


def coverage_map(study, signals, selected, title, note="", reference="", cooperative=False):
    """All labels; of those above each other the one that fewest reach is drawn on top."""
    columns = signals.columns(selected)
    serving = (signals.mean[:, columns] >= signals.requirement[:, None]).sum(axis=1)
    if cooperative:
        serving = np.where(signals.mean[:, columns].sum(axis=1) >= signals.requirement, serving + 1, 0)
    order = np.argsort(-serving, kind="stable")
    symbols = ["missed" if serving[i] == 0 else "once" if serving[i] == 1 else "often" for i in order]
    marks = study.map.labels(signals, order, symbols) + study.map.units(signals.units[columns])
    shown = [("often", "one alone suffices"), ("once", "only together"), ("missed", "not reached"), LEGEND[3]]
    return page.figure(title, study.map.picture(marks, title) + legend(shown if cooperative else LEGEND), note, reference)


def non_cooperative(study):
    result = Section("Non-cooperative placement", "3.5.1, Table 3.1, Fig. 3.2",
                     "How many transceivers are needed where each label must be reached by one alone, and how many labels "
                     "are reached more than once?")
    rows, counts, shares = [], [], []
    for samples in study.effort.samples:
        row = [grouped(samples)]
        for k, objective in enumerate(("count", "links")):
            answer = study.table_answer(samples, "non-cooperative", objective)
            units, share = paper.OPTIMAL[samples][k]
            row += [answer.units, units, percent(answer.redundant_share), f"{share} %",
                    missed(study.reference, answer.selected, "non-cooperative")]
            if k == 0:
                counts.append(answer.count)
            shares.append(answer.redundant_share)
        rows.append(tuple(row))
    header = ("samples", "transceivers", "paper", "redundant", "paper", "missed in truth", "and links: transceivers", "paper",
              "redundant", "paper", "missed in truth")
    result.tables["table_3_1"] = (header, rows)
    signals = study.uniform(study.most_samples)
    answers = [study.table_answer(study.most_samples, "non-cooperative", objective) for objective in ("count", "links")]
    result.add(page.table(header, rows, numeric=range(1, 11), paper=(2, 4, 7, 9), caption="Table 3.1"),
               page.paragraph("‘Missed in truth’ counts the labels that the placement does not reach on the reference matrix, "
                              "which was simulated apart and much more precisely. [a, b] means at least a, at most b, where "
                              "time ran out.", "note"),
               page.row_of([coverage_map(study, signals, answer.selected, f"{words}, {study.most_samples:,} samples",
                                         reference=reference)
                            for answer, words, reference in zip(answers, ("Transceivers only", "Transceivers and links"),
                                                                ("as Fig. 3.2a", "as Fig. 3.2b"))]))
    first, last = counts[0], counts[-1]
    truth = study.place("reference-non-cooperative-count", study.reference_file, "--model", "non-cooperative")
    printed = [paper.OPTIMAL[n][0][0] for n in study.effort.samples]
    result.find("More samples, fewer transceivers", spread(printed, "{}".format), spread(counts, "{}".format),
                verdict(last < first), f"The count is {listed([str(c) for c in counts])} for "
                f"{listed([grouped(n) for n in study.effort.samples])} samples, and {truth.units} on the reference matrix; the "
                f"paper has {listed([str(c) for c in printed])}.",
                "" if last < first else _noise(study), reference="Table 3.1")
    with_links = shares[1::2]
    drops = [a - b for a, b in zip(shares[0::2], with_links)]
    result.find("Minimising links, too, makes redundancy smaller at the same count",
                ", ".join(f"{paper.OPTIMAL[n][0][1]} → {paper.OPTIMAL[n][1][1]} %" for n in study.effort.samples),
                ", ".join(f"{percent(a)[:-2]} → {percent(b)}" for a, b in zip(shares[0::2], with_links)),
                verdict(all(d >= 0 for d in drops) and any(d > 0.005 for d in drops), all(d >= 0 for d in drops)),
                f"With links as the second objective the redundant share falls by {spread([100 * d for d in drops], '{:.0f}'.format)} "
                "points.", reference="Table 3.1")
    printed_last = paper.OPTIMAL[study.most_samples][1][1]
    result.find("Redundancy nearly vanishes with many samples", f"{printed_last} % at {grouped(study.most_samples)}",
                f"{percent(with_links[-1])}", verdict(with_links[-1] <= 0.05, with_links[-1] < with_links[0]),
                f"At {grouped(study.most_samples)} samples {percent(with_links[-1])} of the labels are reached twice or more even "
                "with the fewest links.",
                "" if with_links[-1] <= 0.05 else "Both models need whole transceivers; how much is left over depends on how the "
                "shelves divide among them, so on dimensions that the paper does not print.", reference="Table 3.1")
    return result


def _noise(study):
    """How noise moves entries across the threshold with the fewest samples."""
    noisy, truth = (one.mean >= one.requirement[:, None] for one in (study.uniform(study.effort.samples[0]), study.reference))
    return (f"With {grouped(study.effort.samples[0])} samples noise takes {grouped(int((truth & ~noisy).sum()))} pairs below the threshold "
            f"and lifts {grouped(int((noisy & ~truth).sum()))} above it: gaps that it makes at one candidate it closes at another, and the "
            "search has many to choose from.")


def cooperative(study):
    result = Section("Cooperative placement", "3.5.2, Table 3.3, Fig. 3.4",
                     "How many transceivers are needed where their signals add up, and do the objectives differ?")
    rows, counts, same = [], [], []
    for samples in study.effort.samples:
        row = [grouped(samples)]
        answers = [study.table_answer(samples, "cooperative", objective) for objective in ("count", "signal", "effective-links")]
        for answer, units in zip(answers, paper.COOPERATIVE[samples]):
            row += [answer.units, units, missed(study.reference, answer.selected, "cooperative")]
        rows.append(tuple(row))
        counts.append([answer.count for answer in answers])
        same.append(set(answers[1].selected) == set(answers[2].selected))
    header = ("samples", "transceivers", "paper", "missed in truth", "and signal", "paper", "missed in truth", "and links", "paper",
              "missed in truth")
    result.tables["table_3_3"] = (header, rows)
    signals = study.uniform(study.most_samples)
    figures = [coverage_map(study, signals, study.table_answer(study.most_samples, "cooperative", objective).selected,
                            f"{words}, {study.most_samples:,} samples", reference=reference, cooperative=True)
               for objective, words, reference in (("count", "Transceivers only", "as Fig. 3.4a"),
                                                   ("signal", "Transceivers and signal", "as Fig. 3.4b"))]
    result.add(page.table(header, rows, numeric=range(1, 10), paper=(2, 5, 8), caption="Table 3.3"),
               page.paragraph("Links are counted where one transceiver brings the whole requirement (the paper's sum over all "
                              "pairs is the same for every selection of so many transceivers).", "note"),
               page.row_of(figures))
    single = [row[0] for row in counts]
    truth = study.place("reference-cooperative-count", study.reference_file)
    printed = [paper.COOPERATIVE[n][0] for n in study.effort.samples]
    result.find("More samples, fewer transceivers", spread(printed, "{}".format), spread(single, "{}".format),
                verdict(single[-1] < single[0]),
                f"The count is {listed([str(c) for c in single])} for {listed([grouped(n) for n in study.effort.samples])} samples and "
                f"{truth.units} on the reference matrix; the paper has {listed([str(c) for c in printed])}.",
                "" if single[-1] < single[0] else _noise(study), reference="Table 3.3")
    result.find("All objectives need the same number of transceivers", "equal in every row",
                f"equal in {sum(len(set(c)) == 1 for c in counts)} of {len(counts)} rows",
                verdict(all(len(set(c)) == 1 for c in counts)),
                f"The three objectives agree on the count in {sum(len(set(c)) == 1 for c in counts)} of {len(counts)} rows, as they must: "
                "fewest transceivers come first.", reference="Table 3.3")
    result.find("Fewest with signal and fewest with links give the same placement", "at 100 000", f"the same in {sum(same)} of {len(same)} rows",
                verdict(same[-1], any(same)),
                f"The placements of least signal and of fewest links are the same in {sum(same)} of {len(same)} rows.",
                "" if same[-1] else "Among placements with so few transceivers the least signal and the fewest links are not the "
                "same wish: links count only where one transceiver suffices alone.", reference="Fig. 3.4")
    fewer = [c - study.table_answer(n, "non-cooperative", "count").count for c, n in zip(single, study.effort.samples)]
    ours_pair = f"{single[-1]} against {single[-1] - fewer[-1]}"
    result.find("Cooperation needs fewer transceivers", f"{paper.COOPERATIVE[study.most_samples][0]} against "
                f"{paper.OPTIMAL[study.most_samples][0][0]}", ours_pair, verdict(all(d < 0 for d in fewer), any(d < 0 for d in fewer)),
                f"Where signals add up {ours_pair} transceivers are needed at {grouped(study.most_samples)} samples.", reference="3.5.3")
    return result
