"""The exception that ends an operator with a message."""


class Refused(Exception):
    """Its text is shown to the user: what is wrong and what to do about it."""


def packages():
    """The Python package cotan: the copy inside the add-on, or one on the path of Blender's Python."""
    try:
        from . import cotan
    except ImportError:
        try:
            import cotan
        except ImportError:
            raise Refused("The Python package cotan is missing: install the add-on from its zip") from None
    return cotan
