"""Parts of a store: emitters, responsivities and materials."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import Any

from .options import Path

Material = float | str | Mapping[str, Any]


@dataclass(frozen=True)
class Emitter:
    """A transceiver type: its name and its keys (docs/formats/store/transceiver_types.md)."""

    name: str
    keys: Mapping[str, Any]

    @classmethod
    def from_ies(cls, path: Path, flux: float, **keys: Any) -> Emitter:
        """The shape of an IES LM-63 file, scaled to `flux` (W). `keys`: further ones, such as `cost`."""
        return cls._from_file("ies", path, flux, keys)

    @classmethod
    def from_ldt(cls, path: Path, flux: float, **keys: Any) -> Emitter:
        """The shape of an EULUMDAT file, scaled to `flux` (W)."""
        return cls._from_file("eulumdat", path, flux, keys)

    @classmethod
    def lambertian(cls, flux: float, order: float = 1, name: str = "lambertian", **keys: Any) -> Emitter:
        """flux (order + 1) / (2 pi) cos^order theta (W/sr)."""
        return cls(name, {"emission": {"type": "lambertian", "flux": flux, "order": order}, **keys})

    @classmethod
    def _from_file(cls, kind: str, path: Path, flux: float, keys: Mapping[str, Any]) -> Emitter:
        file = os.path.abspath(path)
        return cls(FilePath(file).stem, {"emission": {"type": kind, "file": file, "flux": flux}, **keys})


def cosine(exponent: float = 1, cutoff_deg: float = 90) -> dict[str, Any]:
    """The responsivity cos^exponent theta, 0 beyond the cut-off."""
    return {"type": "cosine_power", "exponent": exponent, "cutoff_deg": cutoff_deg}


def glass(ior: float = 1.5, solid: bool = False, **keys: Any) -> dict[str, Any]:
    """Clear glass: a pane that is a single surface, or the surface of a solid."""
    return {"type": "dielectric" if solid else "thin_dielectric", "ior": ior, **keys}


def material(value: Material) -> dict[str, Any]:
    """A number is the reflectance of a diffuse surface, a text a name of data/materials_940nm.json."""
    return dict(value) if isinstance(value, Mapping) else {"type": "lambertian", "reflectance": value}
