"""Builds the Python package: `pip install --no-build-isolation .` (docs/python.md).

Builds the compiled part by CMake in build/wheel or, to reuse another build, in the folder of the environment variable
SHELFBEAM_BUILD.
"""

import os
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent
VERSION = re.search(r"project\(shelfbeam VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        build = Path(os.environ.get("SHELFBEAM_BUILD", ROOT / "build" / "wheel")).resolve()
        if not (build / "CMakeCache.txt").exists():
            options = {"CMAKE_BUILD_TYPE": "Release", "CMAKE_UNITY_BUILD": "ON", "Python_EXECUTABLE": sys.executable}
            options |= {f"SHELFBEAM_{part}": "OFF" for part in ("TESTS", "BENCH")}
            words = [f"-D{name}={value}" for name, value in options.items()]
            subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", *words], check=True)
        jobs = str(os.cpu_count() or 1)
        subprocess.run(["cmake", "--build", build, "--target", "shelfbeam_python", "--parallel", jobs], check=True)
        module = build / "python" / "shelfbeam" / f"_core{sysconfig.get_config_var('EXT_SUFFIX')}"
        if not module.exists():
            raise SystemExit(f"{build} was built for another Python: remove it, or unset SHELFBEAM_BUILD")
        target = Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(module, target)
        subprocess.run(["strip", target], check=True)


setup(
    version=VERSION,
    package_dir={"": "src/python"},
    packages=["shelfbeam"],
    package_data={"shelfbeam": ["*.pyi", "py.typed"]},
    ext_modules=[Extension("shelfbeam._core", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
)
