"""Signals by Radiance: a scene of Lambertian triangles as its files, and the run of its program rcontrib.

Radiance's `plastic` without specularity is Lambertian on both sides, so such materials map exactly. Glass, mirrors and
rough coats do not: Radiance's models of them differ, and rcontrib misses the light that they reflect onto diffuse
surfaces. They are refused.

A unit is a sphere of RADIUS and of a material of its own, whose radiance varies with the direction so that radiance x
pi RADIUS^2 is the unit's intensity. Radiance aims at the centres of the spheres only (-ds 0 -dj 0), so a unit counts as
a point. Spheres block light, but the 309 units of the grocery have less than a hundred thousandth of its surface.
"""

import pathlib
import resource
import shutil
import subprocess

import numpy as np

RADIUS = 0.001  # m

# Brightness by direction, at most 1. A ray runs towards the unit; A1 to A3 are the unit's axis.
EMISSION = """{ c is the cosine of the angle between the unit's axis and the direction of the light }
unit_cos = -(Dx*A1 + Dy*A2 + Dz*A3);
unit_above(x) = if(x, x, 0);
unit_sin2theta = 2 * unit_above(unit_cos) * sqrt(unit_above(1 - unit_cos*unit_cos));
unit_lambertian = unit_above(unit_cos)^A4;
"""

# 1,024 first rays per record, each of which continues as one path that roulette by weight ends. No ambient value and no
# interpolation replaces a path, and every unit is tested for shadow at every point. Paths have at most 28 bounces,
# because Radiance has room for 32 dimensions (MAXDIM) and does not check it: in both examples, less than 0.02 % of the
# light is reflected more often.
OPTIONS = (
    "-h- -I+ -V+ -u+ -ab 28 -ad 1024 -lr -28 -lw 0.002 -as 0 -aa 0 -av 0 0 0 -aw 0 "
    "-dt 0 -dc 1 -ds 0 -dj 0 -dr 0 -M ./units.txt"
).split()


def is_installed():
    return all(map(shutil.which, ("oconv", "rcontrib")))


def version():
    return subprocess.run(["rcontrib", "-version"], capture_output=True, text=True, check=False).stdout.strip()


def processor_seconds():
    """The processor time of all ended child processes."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def numbers(values):
    return " ".join(f"{value:.9g}" for value in np.ravel(values))


def emission(kind):
    """(name of the brightness, its argument behind the axis, peak intensity in W/sr) of a transceiver type."""
    given = kind["emission"]
    if kind["radius"] == 0 and given["type"] == "sin2theta":
        return "unit_sin2theta", [], given["peak"]
    if kind["radius"] == 0 and given["type"] == "lambertian":
        return "unit_lambertian", [given["order"]], given["flux"] * (given["order"] + 1) / (2 * np.pi)
    raise ValueError(f"cannot map the emission '{given['type']}' or a disc of radius {kind['radius']} m to Radiance")


def reflectance(name, material):
    if material["type"] != "lambertian":
        raise ValueError(f"cannot map the material '{name}' of type '{material['type']}' to Radiance")
    return material["reflectance"]


def scene_lines(store, surfaces):
    """The scene of a resolved store; `surfaces` are (material, triangles). Other materials of its model are markers."""
    known = {name: f"m{k}" for k, name in enumerate(store["materials"])}
    for name, modifier in known.items():
        grey = reflectance(name, store["materials"][name])
        yield f"void plastic {modifier}\n0\n0\n5 {numbers([grey] * 3)} 0 0\n"
    for material, triangles in surfaces:
        for triangle in triangles if material in known else ():
            yield f"{known[material]} polygon t\n0\n0\n9 {numbers(triangle)}\n"
    for k, unit in enumerate(store["transceivers"]["list"]):
        brightness, arguments, peak = emission(store["transceiver_types"][unit["type"]])
        arguments = [*unit["axis"], *arguments]
        yield f"void brightfunc b{k}\n2 {brightness} ./emission.cal\n0\n{len(arguments)} {numbers(arguments)}\n"
        yield f"b{k} light u{k}\n0\n0\n3 {numbers([peak / (np.pi * RADIUS**2)] * 3)}\n"
        yield f"u{k} sphere s\n0\n0\n4 {numbers([*unit['position'], RADIUS])}\n"


def write_scene(folder, store, surfaces):
    """Writes the files scene.rad, emission.cal, units.txt (the units' modifiers) and probes.txt (the labels)."""
    for kind in store["label_types"].values():
        if kind["responsivity"]["type"] != "cosine" or any(kind["size"]):
            raise ValueError("Radiance computes irradiance at points, but a label type has a size or is not 'cosine'")
    folder = pathlib.Path(folder)
    (folder / "scene.rad").write_text("\n".join(scene_lines(store, surfaces)), encoding="ascii")
    (folder / "emission.cal").write_text(EMISSION, encoding="ascii")
    units = range(len(store["transceivers"]["list"]))
    (folder / "units.txt").write_text("".join(f"u{k}\n" for k in units), encoding="ascii")
    probes = [numbers([*label["position"], *label["normal"]]) + "\n" for label in store["labels"]]
    (folder / "probes.txt").write_text("".join(probes), encoding="ascii")


def signals(folder, repeats):
    """(repeats x labels x units, W/m^2; processor seconds) of a written scene.

    One process computes all repeats, because rcontrib seeds its random numbers by the time in seconds.
    """
    folder, before = pathlib.Path(folder), processor_seconds()
    probes, units = ((folder / name).read_text(encoding="ascii") for name in ("probes.txt", "units.txt"))
    with open(folder / "scene.oct", "wb") as octree:
        subprocess.run(["oconv", "-w", "scene.rad"], cwd=folder, stdout=octree, check=True)
    printed = subprocess.run(
        ["rcontrib", *OPTIONS, "scene.oct"],
        cwd=folder,
        input=probes * repeats,
        text=True,
        stdout=subprocess.PIPE,
        check=True,
    ).stdout
    shape = repeats, probes.count("\n"), units.count("\n"), 3  # red, green and blue are equal
    values = np.array(printed.split(), dtype=float)
    if values.size != np.prod(shape):
        raise RuntimeError(f"rcontrib printed {values.size} numbers instead of {np.prod(shape)}")
    return values.reshape(shape)[..., 0], processor_seconds() - before
