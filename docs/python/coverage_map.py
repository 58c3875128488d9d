"""Simulates a room from a mesh with two photometric files, places the fewest units, and maps their coverage."""

import sys
from pathlib import Path

import shelfbeam as sb

here, output = Path(__file__).parent, Path(sys.argv[1] if len(sys.argv) > 1 else "coverage.png")
examples = here.parents[1] / "examples"
surfaces = {"Wall*": 0.7, "Floor": 0.3, "Bench": 0.5, "Cupboard": 0.6, "Window": sb.glass(1.5)}
lab = sb.Store.from_mesh(here / "lab.glb", surfaces)
wide = sb.Emitter.from_ies(examples / "chiller" / "batwing.ies", flux=1.0)
narrow = sb.Emitter.from_ldt(examples / "chiller" / "narrow-aisle.ldt", flux=1.0)
lab.add_receivers("pd", plane=0.85, spacing=0.25, threshold=0.05, responsivity=sb.cosine(cutoff_deg=80),
                  area=[(0, 0), (8, 5.25)])  # fmt: skip
lab.add_candidates([wide, narrow], spacing=1.0, z=2.95)
signals = sb.simulate(lab, samples=2000, seed=7)
best = sb.place(signals)
print(best)
signals.plot_coverage(best, z=0.85, unit="dB").savefig(output, dpi=150)
