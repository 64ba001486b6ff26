"""The wheel: CMake builds the module and installs it, with the library and its data, into the package.

DASHPOT_BUILD_DIR names a folder that CMake has built in already; without it, one is made and takes minutes.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    def run(self):
        built = os.environ.get("DASHPOT_BUILD_DIR")
        folder = Path(built or self.build_temp).resolve()
        if not built:
            self.build(folder)
        into = Path(self.build_lib).resolve()
        subprocess.run(["cmake", "--install", folder, "--prefix", into, "--component", "wheel"], check=True)

    def build(self, folder):
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=OFF", f"-DDASHPOT_PYTHON_EXECUTABLE={sys.executable}"]
        try:
            import pybind11

            options.append(f"-Dpybind11_DIR={pybind11.get_cmake_dir()}")
        except ImportError:
            pass  # then CMake finds Debian's
        subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", *options], check=True)
        subprocess.run(["cmake", "--build", folder, "--target", "dashpot_core"], check=True)


MADE = Path("build/wheel")  # relative, as setuptools wants it
MADE.mkdir(parents=True, exist_ok=True)
version = re.search(r"project\(dashpot VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]
setup(
    version=version,
    ext_modules=[Extension("dashpot._core", [])],
    cmdclass={"build_ext": CMakeBuild},
    options={"build": {"build_base": str(MADE)}, "egg_info": {"egg_base": str(MADE)}},
)
