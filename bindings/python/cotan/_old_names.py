"""The names of version 0.2, which work once more, with a DeprecationWarning. The next version deletes this file."""

import functools
import importlib
import sys
import warnings
from typing import Any, Callable, TypeVar, cast

NAMES = {
    "model_pictures": "model_images",
    "pictures": "images",
    "read_picture": "read_image",
    "write_picture": "write_image",
}
_PACKAGE = __name__.rpartition(".")[0]  # also where it lies inside another package, as in the Blender add-on
Function = TypeVar("Function", bound=Callable[..., Any])


def _warn(old: str, new: str) -> None:
    warnings.warn(f"{old} is now called {new}", DeprecationWarning, stacklevel=3)


def of_package(name: str) -> Any:
    """What the package calls `name` today; its __getattr__."""
    if name not in NAMES:
        raise AttributeError(f"module 'cotan' has no attribute '{name}'")
    _warn(f"cotan.{name}", f"cotan.{NAMES[name]}")
    return getattr(sys.modules[_PACKAGE], NAMES[name])


def of_module(old: str, new: str) -> None:
    """Lets `import cotan.OLD` find the module cotan.NEW, whose functions have old names, too."""
    module = importlib.import_module(f"{_PACKAGE}.{new}")
    setattr(module, "__getattr__", of_package)
    sys.modules[f"{_PACKAGE}.{old}"] = module


def attribute(old: str, new: str) -> Any:
    """A property that reads the attribute `new`."""

    def read(this: Any) -> Any:
        _warn(old, new)
        return getattr(this, new)

    return property(read)


def keyword(old: str, new: str) -> Callable[[Function], Function]:
    """Lets a function take the argument `new` by its old name."""

    def decorate(function: Function) -> Function:
        @functools.wraps(function)
        def renamed(*arguments: Any, **given: Any) -> Any:
            if old in given and new not in given:
                _warn(f"the argument {old}", new)
                given[new] = given.pop(old)
            return function(*arguments, **given)

        return cast(Function, renamed)

    return decorate
