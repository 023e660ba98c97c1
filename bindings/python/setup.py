"""A wheel that carries libcotan is for one kind of machine, and for every Python 3 there: no part of it is compiled
against Python. Without the library the wheel is for all machines."""

import pathlib

import setuptools
from wheel.bdist_wheel import bdist_wheel


class Wheel(bdist_wheel):
    def finalize_options(self):
        super().finalize_options()
        folder = pathlib.Path(__file__).parent / "cotan"
        self.root_is_pure = not any(f for name in ("libcotan*", "cotan.dll") for f in folder.glob(name))

    def get_tag(self):
        python, abi, platform = super().get_tag()
        return ("py3", "none", "any" if self.root_is_pure else platform)


setuptools.setup(cmdclass={"bdist_wheel": Wheel})
