#!/usr/bin/env python3
"""Makes the HDF5 files in this folder with h5py: files as other programs write them, and invalid files."""

import pathlib

import h5py
import numpy as np

folder = pathlib.Path(__file__).parent
texts = lambda *values: np.array([value.encode() for value in values], dtype="S")


def signal_file(name, libver="latest"):
    """A valid signal file of 2 labels and 3 transceivers, in h5py's default data types and layouts."""
    file = h5py.File(folder / name, "w", libver=libver)
    for key, value in {"program_version": "9", "store_hash": "", "estimator": "by hand"}.items():
        file.attrs[key] = np.bytes_(value)
    file.attrs["format_version"] = 1
    file.attrs["seed"] = 7
    file.attrs["wavelength_nm"] = 940.0
    file["mean"] = np.array([[1, 2, 3], [4, 5, 6]], dtype=">f4")
    file.create_dataset("standard_error", data=np.full((2, 3), 0.5), compression="gzip", shuffle=True)
    file.create_dataset("direct", data=np.ones((2, 3)), maxshape=(None, None), fletcher32=True)
    file["labels/id"] = texts("L1", "L2 longer")
    file["labels/type"] = texts("a", "a")
    file["labels/position"] = file["labels/normal"] = np.ones((2, 3))
    for key in ("requirement", "link_cost", "signal_cost"):
        file["labels/" + key] = np.array([0.5, 0.25])
    file["labels/batches"] = file["labels/samples"] = np.array([4, 5], dtype=np.int16)
    file["transceivers/id"] = texts("T1", "T2", "T3")
    file["transceivers/type"] = texts("c", "c", "c")
    file["transceivers/position"] = file["transceivers/axis"] = np.ones((3, 3))
    file["transceivers/cost"] = np.ones(3)
    file["transceivers/installed"] = np.array([0, 1, 0], dtype=np.int8)
    return file


def replace(file, path, *args, **options):
    del file[path]
    file.create_dataset(path, *args, **options)


signal_file("foreign.h5").close()
signal_file("old_format.h5", libver="earliest").close()
with signal_file("claims_labels.h5") as file:
    replace(file, "labels/id", shape=(10**12,), dtype="S8")
with signal_file("claims_entries.h5") as file:
    replace(file, "mean", shape=(2, 3), dtype="f4", chunks=(1, 3))
with signal_file("variable_texts.h5") as file:
    replace(file, "labels/id", data=["L1", "L2"], dtype=h5py.string_dtype())
