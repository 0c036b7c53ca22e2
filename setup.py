"""Builds the module by CMake; pyproject.toml has the rest.

VLBEAM_BUILD_DIR=FOLDER takes a build that is configured already, CMAKE_ARGS adds options, VLBEAM_JOBS=N compiles N files
at a time.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent


class Build(build_ext):
    def build_extension(self, extension):
        build = Path(os.environ.get("VLBEAM_BUILD_DIR") or ROOT / "build-wheel")
        if not (build / "CMakeCache.txt").exists() or "VLBEAM_BUILD_DIR" not in os.environ:
            options = ["-DCMAKE_BUILD_TYPE=Release", "-DVLBEAM_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}"]
            options += [f"-DVLBEAM_{part}=OFF" for part in ("BUILD_STUDIES", "BUILD_TESTS", "BUILD_BENCH", "INSTALL")]
            subprocess.run(["cmake", "-S", ROOT, "-B", build, *options, *os.environ.get("CMAKE_ARGS", "").split()], check=True)
        jobs = os.environ.get("VLBEAM_JOBS") or str(os.cpu_count() or 1)
        subprocess.run(["cmake", "--build", build, "--target", "vlbeam_python", "--parallel", jobs], check=True)
        made, package = build / "python" / "vlbeam", Path(self.get_ext_fullpath(extension.name)).parent
        package.mkdir(parents=True, exist_ok=True)
        for path in [*made.glob("_vlbeam*.so"), *made.glob("_vlbeam*.pyd"), made / "_scene.pyi"]:
            shutil.copy2(path, package / path.name)
        shutil.copytree(made / "scenes", package / "scenes", dirs_exist_ok=True)


# Out of the sources, and apart from `build`, which is CMake's.
scratch = ROOT / "build-wheel" / "setuptools"
scratch.mkdir(parents=True, exist_ok=True)
where = {"build": {"build_base": str(scratch)}, "egg_info": {"egg_base": str(scratch)}}

version = re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
setup(version=version, ext_modules=[Extension("vlbeam._vlbeam", [])], cmdclass={"build_ext": Build}, options=where)
