"""Files under 1 MB that take as much time or memory as possible, for scripts/try-bombs. Each maker takes a random.Random
and a folder, writes into the folder and returns the file for a command. The random numbers determine counts, sizes and
shapes."""
import bomb_counts
import bomb_formats
import bomb_packed
import bomb_packed_images
import bomb_images
import bomb_texels
from bomb_gltf import written


def makers_of(module):
    """Returns the functions of a module with parameters (r, folder), in their order."""
    return {name: value for name, value in vars(module).items()
            if callable(value) and getattr(value, "__module__", "") == module.__name__
            and value.__code__.co_varnames[:value.__code__.co_argcount] == ("r", "folder")}


def picture(make, ending):
    def maker(r, folder):
        return written(folder, "bomb." + ending, make(r))
    maker.__doc__ = make.__doc__
    return maker


MAKERS = {}
for part in (bomb_texels, bomb_counts, bomb_packed, bomb_formats):
    MAKERS |= makers_of(part)
for part in (bomb_images, bomb_packed_images):
    MAKERS |= {name: picture(make, ending) for name, (make, ending) in part.MAKERS.items()}
