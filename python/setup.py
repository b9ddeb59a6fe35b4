"""Builds the package by CMake, for `pip install ./python` (docs/python.md)."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

PROJECT = Path(__file__).resolve().parent.parent
OPTIONS = {
    "CMAKE_BUILD_TYPE": "Release",
    "CMAKE_UNITY_BUILD": "ON",
    "SWEEPFACE_BUILD_TOOL": "OFF",
    "SWEEPFACE_BUILD_SHARED": "OFF",
    "SWEEPFACE_BUILD_PICTURE": "ON",
    "SWEEPFACE_BUILD_PYTHON": "ON",
    "SWEEPFACE_PYTHON": sys.executable,
}


class BuildByCMake(build_ext):
    def build_extension(self, extension):
        """Builds it, unless SWEEPFACE_BUILD names a build folder that has it."""
        built = os.environ.get("SWEEPFACE_BUILD")
        folder = Path(built or self.build_temp).resolve()
        if not built:
            told = [f"-D{name}={value}" for name, value in OPTIONS.items()]
            subprocess.run(["cmake", "-S", PROJECT, "-B", folder, *told], check=True)
            subprocess.run(["cmake", "--build", folder, "--target", "sweepface_python", "--parallel"], check=True)
        target = Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(folder / "python" / "sweepface" / target.name, target)


setup(ext_modules=[Extension("sweepface._core", [])], cmdclass={"build_ext": BuildByCMake})
