"""Bakes the normal map of a detailed mesh for a simple one. Reads the meshes itself, with numpy, to show what your own
pipeline passes to Cotan; `cotan.bake(path, path)` also reads files.

    python3 bake.py low.obj high.obj normal.png
"""

import sys

import numpy as np

import cotan


def read_obj(file):
    """The mesh in an OBJ file: one vertex for each distinct corner v/vt/vn, polygons triangulated as fans."""
    rows, corners = {"v": [], "vt": [], "vn": []}, []
    with open(file, encoding="utf-8") as lines:
        for line in lines:
            word, *values = line.split() or [""]
            if word in rows:
                rows[word].append(values)
            elif word == "f":
                face = [[int(number or 0) for number in (corner + "//").split("/")[:3]] for corner in values]
                for second, third in zip(face[1:], face[2:]):
                    corners += [face[0], second, third]
    corners, indices = np.unique(np.array(corners, int), axis=0, return_inverse=True)
    v, vt, vn = (np.array(rows[word], np.float32) for word in ("v", "vt", "vn"))
    has_vt, has_vn = (corners[:, 1:] > 0).all(axis=0)  # indices count from 1; 0: missing
    return cotan.Mesh(
        positions=v[corners[:, 0] - 1],
        indices=indices,
        normals=vn[corners[:, 2] - 1] if has_vn else None,
        texcoords=vt[corners[:, 1] - 1] * [1, -1] + [0, 1] if has_vt else None,  # v of OBJ runs up
    )


def main(low, high, out):
    baked = cotan.bake(
        read_obj(low),
        read_obj(high),
        size=512,
        frame="smooth",  # the frame that the shader will use
        progress=lambda done: print(f"\rbaking {done:4.0%}", end="", file=sys.stderr),
    )
    print(file=sys.stderr)
    print(f"{baked.covered} of {baked.texels} texels covered, {baked.missed} of them found no detail")
    cotan.write_image(out, baked.map)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit("usage: bake.py LOW.obj HIGH.obj MAP.png")
    try:
        main(*sys.argv[1:])
    except (cotan.Error, OSError) as error:
        sys.exit(f"bake.py: {error}")
