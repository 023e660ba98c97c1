"""Bakes the normal map of a detailed mesh for a simple one. The meshes are read here, with numpy alone, to show what a
pipeline of your own hands to Cotan; `cotan.bake(path, path)` reads files by itself.

    python3 bake.py low.obj high.obj normal.png
"""

import sys

import numpy as np

import cotan


def read_obj(file):
    """The triangles of an OBJ file whose corners are v/vt/vn, one vertex for each different corner."""
    rows = {"v": [], "vt": [], "vn": [], "f": []}
    with open(file, encoding="utf-8") as lines:
        for line in lines:
            word, *values = line.split() or [""]
            if word in rows:
                rows[word].append([value.split("/") for value in values] if word == "f" else values)
    corners = np.array(rows["f"], int).reshape(-1, 3) - 1  # three numbers a corner, counted from 1
    corners, indices = np.unique(corners, axis=0, return_inverse=True)
    positions, texcoords, normals = (np.array(rows[word], np.float32) for word in ("v", "vt", "vn"))
    return cotan.Mesh(
        positions=positions[corners[:, 0]],
        indices=indices,
        normals=normals[corners[:, 2]],
        texcoords=texcoords[corners[:, 1]] * [1, -1] + [0, 1],  # v of OBJ runs up
    )


def main(low, high, out):
    baked = cotan.bake(
        read_obj(low),
        read_obj(high),
        size=512,
        frame="smooth",  # that the shader will read the map with
        progress=lambda done: print(f"\rbaking {done:4.0%}", end="", file=sys.stderr),
    )
    print(file=sys.stderr)
    print(f"{baked.covered} of {baked.texels} texels covered, {baked.missed} of them found no detail")
    cotan.write_picture(out, baked.map)


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except cotan.Error as error:
        sys.exit(f"bake.py: {error}")
