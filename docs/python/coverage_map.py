"""Simulates a room from a mesh with two photometric files, places the fewest units, and maps their coverage."""

import sys
from pathlib import Path

import shelfbeam as sb

here, output = Path(__file__).parent, Path(sys.argv[1] if len(sys.argv) > 1 else "coverage.png")
photometry = here.parents[1] / "examples" / "chiller"
lab = sb.Store.from_mesh(here / "lab.glb", {"Wall*": 0.7, "Floor": 0.3, "Window": sb.glass(1.5), "*": 0.5})
wide = sb.Emitter.from_ies(photometry / "batwing.ies", flux=1.0)
narrow = sb.Emitter.from_ldt(photometry / "narrow-aisle.ldt", flux=1.0)
lab.add_receivers("pd", plane=0.85, spacing=0.25, threshold=0.05, responsivity=sb.cosine(cutoff_deg=80))
lab.add_candidates([wide, narrow], spacing=1.0, below_ceiling=0.05)
signals = sb.simulate(lab, samples=2000, seed=7)
best = sb.place(signals)
print(best)
signals.plot_coverage(best, z=0.85).savefig(output, dpi=150)
