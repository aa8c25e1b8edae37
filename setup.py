"""Builds the compiled half of the Python module by CMake; pyproject.toml says the rest.

CAROM_WHEEL_BUILD names CMake's build folder (default build/wheel-cmake); one that is there, of this Python and with
CAROM_BUILD_PYTHON, is used as it is configured.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
VERSION = re.search(r"project\(carom VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


class ByCMake(build_ext):
    def build_extension(self, extension):
        build = pathlib.Path(os.environ.get("CAROM_WHEEL_BUILD", ROOT / "build" / "wheel-cmake"))
        if not (build / "CMakeCache.txt").exists():
            subprocess.run(["cmake", "-S", ROOT, "-B", build, *(["-G", "Ninja"] if shutil.which("ninja") else []),
                            "-DCMAKE_BUILD_TYPE=Release", "-DCAROM_BUILD_PYTHON=ON", "-DCAROM_PRECOMPILE=ON",
                            "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=12",
                            f"-DPython3_EXECUTABLE={sys.executable}", f"-DPYTHON_EXECUTABLE={sys.executable}"],
                           check=True)
        subprocess.run(["cmake", "--build", build, "--target", "carom_python", "--parallel"], check=True)
        target = pathlib.Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        built = build / "python" / "carom" / target.name
        if not built.exists():
            raise SystemExit(f"setup.py: {build} has built no {target.name}: it is of another Python")
        shutil.copy2(built, target)
        subprocess.run([os.environ.get("STRIP", "strip"), "--strip-unneeded", target], check=True)


(ROOT / "build").mkdir(exist_ok=True)
setup(
    version=VERSION,
    packages=["carom"],
    package_dir={"": "python"},
    package_data={"carom": ["__init__.pyi", "py.typed"]},
    ext_modules=[Extension("carom._carom", [])],
    cmdclass={"build_ext": ByCMake},
    options={"egg_info": {"egg_base": "build"}, "build": {"build_base": "build/wheel"}},
    zip_safe=False,
)
