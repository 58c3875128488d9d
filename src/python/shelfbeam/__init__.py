"""Plans where to mount infrared transceivers so that every receiver gets enough light, and proves it.

A `Store` describes a shop or a room; `simulate` gives the signal of every label (receiver) from every candidate
transceiver as NumPy arrays; `place` chooses the fewest or cheapest transceivers with a proven bound; `plan` does both,
certifies the plan with independent samples, and writes the report. docs/python.md has examples. Keywords have the
names and defaults of the command line. Lengths are in m, signals in W/m².
"""

from ._core import __version__
from .comparison import Comparison, compare
from .errors import Error, InputError, Interrupted, OutOfMemory, OutputError, ShelfbeamWarning
from .impulse import ImpulseResponse, impulse_response
from .parts import Emitter, cosine, glass, material
from .options import Progress
from .placement import Evaluation, Placement, evaluate, place
from .plans import Plan, Verification, plan, verify
from .preview import Column, LightOperator, WhatIf, what_if
from .scene import Problem, Scene
from .signals import Signals, StateSignals, simulate
from .store import Store

__all__ = [
    "Column", "Comparison", "Emitter", "Error", "Evaluation", "ImpulseResponse", "InputError", "Interrupted",
    "LightOperator", "OutOfMemory", "OutputError", "Placement", "Plan", "Problem", "Progress", "Scene",
    "ShelfbeamWarning", "Signals", "StateSignals", "Store", "Verification", "WhatIf", "__version__", "compare",
    "cosine", "evaluate", "glass", "impulse_response", "material", "place", "plan", "simulate", "verify", "what_if",
]  # fmt: skip
