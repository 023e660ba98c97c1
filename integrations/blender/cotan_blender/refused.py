"""What ends an operator with one plain sentence."""


class Refused(Exception):
    """Its text goes to the user as it is: what is wrong, and what to do about it."""


def packages():
    """The Python package cotan: the copy inside the add-on, or one that Blender's Python finds."""
    try:
        from . import cotan
    except ImportError:
        try:
            import cotan
        except ImportError:
            raise Refused("The Python package cotan is missing: install the add-on from its zip") from None
    return cotan
