"""Builds the wheel. With libcotan inside, it is tagged for one platform and any Python 3, since nothing is compiled
against Python. Without the library, the wheel is for all platforms. COTAN_PLATFORM in the environment: the platform's
tag, such as manylinux_2_36_x86_64; default: this system's."""

import os
import pathlib

import setuptools
from wheel.bdist_wheel import bdist_wheel


FOLDER = pathlib.Path(__file__).parent / "cotan"
CARRIED = [file for name in ("libcotan*", "cotan.dll") for file in FOLDER.glob(name)]


class Distribution(setuptools.Distribution):
    def has_ext_modules(self):
        return bool(CARRIED)


class Wheel(bdist_wheel):
    def get_tag(self):
        platform = os.environ.get("COTAN_PLATFORM") or super().get_tag()[2]
        return ("py3", "none", platform if CARRIED else "any")


setuptools.setup(distclass=Distribution, cmdclass={"bdist_wheel": Wheel})
