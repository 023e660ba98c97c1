"""Meshes and normal maps by formula. uv as in glTF: v points down the image; green points up unless stated."""

import dataclasses

import numpy as np


@dataclasses.dataclass
class Mesh:
    position: np.ndarray
    normal: np.ndarray
    uv: np.ndarray
    triangles: np.ndarray
    tangent: np.ndarray = None

    def moved(self, offset=(0, 0, 0), scale=1.0):
        """The mesh scaled by one number, then moved."""
        return dataclasses.replace(self, position=self.position * scale + np.asarray(offset, float))

    def charted(self, scale, offset=(0, 0)):
        """The mesh with uv * scale + offset."""
        return dataclasses.replace(self, uv=self.uv * np.asarray(scale, float) + np.asarray(offset, float))


def joined(meshes):
    """One mesh of several."""
    starts = np.cumsum([0] + [len(m.position) for m in meshes])
    return Mesh(*[np.concatenate([getattr(m, key) for m in meshes]) for key in ("position", "normal", "uv")],
                np.concatenate([m.triangles + start for m, start in zip(meshes, starts)]))


def split(mesh):
    """The mesh with its own vertices for each triangle."""
    corners = mesh.triangles.reshape(-1)
    return Mesh(mesh.position[corners], mesh.normal[corners], mesh.uv[corners],
                np.arange(len(corners)).reshape(-1, 3))


def grid_triangles(columns, rows):
    """Triangles of a grid of (columns + 1) * (rows + 1) vertices; row 0 first, counter-clockwise if rows run upwards."""
    x, y = np.meshgrid(np.arange(columns), np.arange(rows))
    a = (y * (columns + 1) + x).reshape(-1)
    b, c, d = a + 1, a + columns + 2, a + columns + 1
    return np.stack([a, b, c, a, c, d], 1).reshape(-1, 3)


def surface(of, columns, rows):
    """The surface p = of(s, t) over the unit square: uv are (s, 1 - t), and the normal is dp/ds x dp/dt, by central
    differences in double."""
    s, t = [x.reshape(-1) for x in np.meshgrid(np.linspace(0, 1, columns + 1), np.linspace(0, 1, rows + 1))]
    step = 1e-5
    along = np.array(of(s + step, t)) - np.array(of(s - step, t))
    across = np.array(of(s, t + step)) - np.array(of(s, t - step))
    normal = np.cross(along.T, across.T)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30)
    return Mesh(np.array(of(s, t)).T, normal, np.stack([s, 1 - t], 1), grid_triangles(columns, rows))


def quad(low, high):
    """A square in the xy plane that looks towards +z."""
    (x0, y0), (x1, y1) = low, high
    return surface(lambda s, t: (x0 + (x1 - x0) * s, y0 + (y1 - y0) * t, 0 * s), 1, 1)


def zone(columns, rows, low=-0.9, high=0.9, turns=1.0):
    """A unit sphere between two latitudes, in radians."""
    def of(s, t):
        angle, up = 2 * np.pi * turns * s, low + (high - low) * t
        return np.sin(angle) * np.cos(up), np.sin(up), np.cos(angle) * np.cos(up)
    return surface(of, columns, rows)


def torus(radius, tube, columns, rows):
    def of(s, t):
        a, b = 2 * np.pi * s, 2 * np.pi * t
        return np.sin(a) * (radius + tube * np.cos(b)), tube * np.sin(b), np.cos(a) * (radius + tube * np.cos(b))
    return surface(of, columns, rows)


def tube(columns, rows, radius=lambda t: 0.3 + 0 * t, length=1.0):
    """A tube along y, closed by points where the radius is zero."""
    def of(s, t):
        a = 2 * np.pi * s
        return radius(t) * np.sin(a), length * (t - 0.5), radius(t) * np.cos(a)
    return surface(of, columns, rows)


def rounded_box(half, rounding, steps, chart=lambda face: ((1, 1), (0, 0))):
    """A box with round edges, of six grids. chart: scale and offset of the uv of each face."""
    faces = []
    half = np.asarray(half, float)
    # Denser where the box is round: an edge has as many cells as the flat part.
    share = (1 - np.cos(np.linspace(0, np.pi, steps + 1))) / 2
    for face in range(6):
        axis, sign = face // 2, 1 - 2 * (face % 2)
        a, b = np.meshgrid(share * 2 - 1, share * 2 - 1)
        p = np.zeros((a.size, 3))
        u, v = (axis + 1) % 3, (axis + 2) % 3
        p[:, axis], p[:, u], p[:, v] = sign, sign * a.reshape(-1), b.reshape(-1)
        p *= half
        core = np.clip(p, -(half - rounding), half - rounding)
        out = p - core
        normal = out / np.linalg.norm(out, axis=1, keepdims=True)
        uv = np.stack([(a.reshape(-1) + 1) / 2, (1 - b.reshape(-1)) / 2], 1)
        faces.append(Mesh(core + rounding * normal, normal, uv, grid_triangles(steps, steps)).charted(*chart(face)))
    return joined(faces)


def cube(half=0.5):
    """A cube with 24 vertices; each side has the whole image."""
    sides = []
    for face in range(6):
        axis, sign = face // 2, 1 - 2 * (face % 2)
        u, v = (axis + 1) % 3, (axis + 2) % 3
        p = np.zeros((4, 3))
        corner = np.array([[-1, -1], [1, -1], [-1, 1], [1, 1]], float)
        p[:, axis], p[:, u], p[:, v] = sign, sign * corner[:, 0], corner[:, 1]
        n = np.zeros((4, 3))
        n[:, axis] = sign
        sides.append(Mesh(half * p, n, np.stack([(corner[:, 0] + 1) / 2, (1 - corner[:, 1]) / 2], 1),
                          grid_triangles(1, 1)))
    return joined(sides)


# ---- reliefs -------------------------------------------------------------------------------------------------------

def domes(count, height=0.35, fill=0.8):
    """A relief of count * count round domes that repeats; returns the slopes along u and along v (down the image).
    height: of a dome, as a fraction of its radius."""
    def slopes(u, v):
        x, y = [2 * ((count * w) % 1) - 1 for w in (u, v)]
        r2 = (x * x + y * y) / fill**2
        inside = np.where(r2 < 1, 1 - r2, 0)
        # h = height * radius * (1 - r2)^2 with radius = fill / (2 count) in units of the image
        common = -4 * height * inside / fill
        return common * x, common * y
    return slopes


def bumps(amplitude, waves=((3, 1), (1, -2), (-2, 3), (4, 3))):
    """A relief of plane waves in several directions, which repeats and has no flat part."""
    def slopes(u, v):
        x = y = 0
        for k, (a, b) in enumerate(waves):
            wave = amplitude * np.cos(2 * np.pi * (a * u + b * v) + k) / len(waves) / np.hypot(a, b)
            x, y = x + a * wave, y + b * wave
        return x, y
    return slopes


def grooves(steepness, across=5, along=3, width=0.15):
    """A relief h = f(u) + g(v) of grooves with flat parts between. No test of the map can tell which way green points:
    f(u) - g(v) is a relief too. width: of a groove, as a fraction of the distance between two."""
    def slope(w, count):
        x = count * w % 1
        return np.where(x < width, -steepness * np.sin(2 * np.pi * x / width), 0)
    return lambda u, v: (slope(u, across), slope(v, along))


def normals_of(slopes, width, height=None):
    """Unit normals at texel centres of a relief of slopes(u, v), for green that points up: (rows, columns, 3)."""
    height = height or width
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    x, y = slopes(u, v)
    normal = np.stack([-x, y, np.ones_like(u)], 2)
    return normal / np.linalg.norm(normal, axis=2, keepdims=True)


def coded(normals, bits=8, green=1):
    """Texels of a normal map whose flat texel is 128 or 32768. green: -1 to point down."""
    zero = 2 ** (bits - 1)
    signed = normals * [1, green, 1]
    return np.clip(np.round(zero + (zero - 1) * signed), 0, 2 * zero - 1).astype(np.uint8 if bits == 8 else np.uint16)


def relief_map(slopes, width, height=None, bits=8, green=1):
    return coded(normals_of(slopes, width, height), bits, green)


def plain(colour, size=4):
    """A small image of one colour, 0 to 255."""
    return np.full((size, size, len(colour)), colour, np.uint8)


def checks(low, high, count, size=64):
    """An image of squares of two colours."""
    x, y = np.meshgrid(np.arange(size), np.arange(size))
    odd = ((x * count // size + y * count // size) % 2)[..., None]
    return np.where(odd, np.array(high, np.uint8), np.array(low, np.uint8))
