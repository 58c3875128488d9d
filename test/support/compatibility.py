"""Files that released versions wrote, assembled as those versions left them.

test/system/compatibility/VERSION keeps the files that differ between versions. The store files do not: the one that a
user wrote, and the one that `plan` wrote, are kept once.
"""

import pathlib
import re
import shutil

KEPT = pathlib.Path(__file__).parents[1] / "system/compatibility"
VERSIONS = sorted(folder.name for folder in KEPT.iterdir() if re.fullmatch(r"\d+\.\d+\.\d+", folder.name))
SAMPLES = (KEPT / "samples").read_text().strip()  # of the interrupted simulation


def old_plan(version, folder):
    """Fills `folder`, created if missing, with the store, signal and placement of a version's plan; returns it."""
    shutil.copytree(KEPT / version / "plan", folder, dirs_exist_ok=True)
    if not (folder / "store.json").exists():  # a version that writes it otherwise keeps its own
        shutil.copy(KEPT / "plan_store.json", folder / "store.json")
    return folder


def old_files(version, folder):
    """Fills `folder` with store.json, interrupted.h5.checkpoint and plan/ of a version; returns it."""
    old_plan(version, folder / "plan")
    shutil.copy(KEPT / "store.json", folder)
    shutil.copy(KEPT / version / "interrupted.h5.checkpoint", folder)
    return folder
