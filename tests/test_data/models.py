"""Still models, each with the traits of the published model whose place it takes. Tangents, which MikkTSpace makes, and
compression are added by finish.mjs, according to the list that `make` returns."""

import numpy as np

from files import Gltf, png
import shapes
from shapes import Mesh


def surface_maps(gltf, slopes, size, names=None, green=1, colour=((150, 110, 80), (180, 140, 100)), noise=0):
    """Adds textures of base colour, roughness (green) and metal (blue), and normals. names: of files, by these words.
    noise: steps of 8 bits that normals differ by at random, as in a photograph: PNG is larger than JPEG then."""
    names = names or {}
    normals = shapes.relief_map(slopes, size, green=green).astype(int)
    normals[..., :2] += np.random.default_rng(size).integers(-noise, noise + 1, normals[..., :2].shape)
    rough = shapes.checks((255, 120, 0), (255, 150, 0), 4)
    return {"base": gltf.image(shapes.checks(*colour, 4), names.get("base")),
            "rough": gltf.image(rough, names.get("rough")),
            "normal": gltf.image(np.clip(normals, 0, 255).astype(np.uint8), names.get("normal"))}


def material_of(maps, **more):
    return {"pbrMetallicRoughness": {"baseColorTexture": maps["base"], "metallicRoughnessTexture": maps["rough"]},
            "normalTexture": maps["normal"], "occlusionTexture": maps["rough"], **more}


# ---- real domes beside quads whose map shows the same dome ---------------------------------------------------------

SIDE, RADIUS, TALL = 0.3, 0.13, 0.08
ROWS = (-0.8, -0.4, 0, 0.4, 0.8)


def dome_slopes(u, v):
    """Slopes of the relief: the dome fills the left upper quarter of the image, the rest is flat."""
    def of(x, y):
        r2 = (x * x + y * y) / RADIUS**2
        return np.where(r2 < 1, -4 * TALL * np.maximum(1 - r2, 0) / RADIUS**2, 0)
    x, y = (2 * u - 0.5) * SIDE, (2 * v - 0.5) * SIDE
    return of(x, y) * x, of(x, y) * y


def real_dome(x, y):
    def of(s, t):
        a, b = SIDE * (s - 0.5), SIDE * (t - 0.5)
        r2 = (a * a + b * b) / RADIUS**2
        return x + a, y + b, TALL * np.where(r2 < 1, np.maximum(1 - r2, 0)**2, 0)
    return shapes.surface(of, 40, 40).charted((0.3, 0.3), (0.6, 0.6))  # where the map is flat


def mapped_quad(x, y, turns, mirror=(1, 1)):
    mesh = shapes.quad((x - SIDE / 2, y - SIDE / 2), (x + SIDE / 2, y + SIDE / 2))
    uv = (mesh.uv - 0.5) * mirror
    for _ in range(turns):
        uv = np.stack([-uv[:, 1], uv[:, 0]], 1)
    return Mesh(mesh.position, mesh.normal, (uv + 0.5) * 0.5, mesh.triangles)


def normal_tangent(file, columns):
    """columns: x of real domes, and x of the mapped quads beside them with their mirroring."""
    parts = []
    for number, (real, quads) in enumerate(columns):
        for k, y in enumerate(ROWS):
            parts.append(real_dome(real, y))
            parts += [mapped_quad(x, y, (k + number) % 4, mirror) for x, mirror in quads]
    # Two quads above, stretched: their texels are not square.
    for x in (-0.5, 0.5):
        mesh = mapped_quad(x, 1.4, 0)
        parts.append(Mesh(mesh.position * [1, 1, 1] + (mesh.position - [x, 1.4, 0]) * [1.5, 0, 0], mesh.normal, mesh.uv,
                          mesh.triangles))
    gltf = Gltf()
    maps = surface_maps(gltf, dome_slopes, 512)
    gltf.list("materials", material_of(maps, doubleSided=True))
    gltf.mesh(shapes.joined(parts), 0, name="squares")
    gltf.write(file)


# ---- props ---------------------------------------------------------------------------------------------------------

def six_charts(face):
    """Scale and offset of the uv of a box's faces, beside one another in an image."""
    return (0.3, 0.46), (face % 3 / 3 + 0.0167, face // 3 / 2 + 0.02)


def quarter(number):
    """The same for a quarter of an image."""
    return (0.46, 0.46), (number % 2 / 2 + 0.02, number // 2 / 2 + 0.02)


def boom_box(file):
    gltf = Gltf()
    names = {key: f"BoomBox_{word}.png" for key, word in
             (("base", "baseColor"), ("rough", "occlusionRoughnessMetallic"), ("normal", "normal"))}
    maps = surface_maps(gltf, shapes.domes(12), 1024, names)
    emissive = gltf.image(shapes.checks((0, 0, 0), (20, 60, 90), 8), "BoomBox_emissive.png")
    gltf.list("materials", material_of(maps, emissiveTexture=emissive, emissiveFactor=[1, 1, 1]))
    gltf.mesh(shapes.rounded_box((1, 0.7, 0.5), 0.2, 20, six_charts), 0, name="BoomBox")
    gltf.write(file)


def flight_helmet(file):
    gltf = Gltf()
    parts = (("Hose", shapes.torus(0.5, 0.12, 96, 24).moved((0, -0.6, 0)), {"doubleSided": True}),
             ("RubberWood", shapes.rounded_box((0.7, 0.1, 0.5), 0.08, 16, six_charts).moved((0, -0.9, 0)), {}),
             ("GlassPlastic", shapes.zone(48, 24, -0.7, 0.7).moved((0, 0.5, 0), 0.45), {}),
             ("MetalParts", shapes.tube(48, 24, lambda t: 0.2 + 0.1 * np.sin(6 * t), 1.2).moved((0.9, 0, 0)), {}),
             ("Lenses", shapes.zone(32, 16, -0.6, 0.6).moved((-0.9, 0, 0), 0.3), {"alphaMode": "BLEND"}))
    for k, (name, mesh, more) in enumerate(parts):
        names = {key: f"FlightHelmet_Materials_{name}Mat_{word}.png" for key, word in
                 (("base", "BaseColor"), ("rough", "OcclusionRoughMetal"), ("normal", "Normal"))}
        maps = surface_maps(gltf, shapes.bumps(0.3 + 0.05 * k) if k % 2 else shapes.domes(6 + k), 256, names)
        material = material_of(maps, name=name + "Mat", **more)
        if more.get("alphaMode"):
            material["pbrMetallicRoughness"]["baseColorFactor"] = [1, 1, 1, 0.4]
        gltf.mesh(mesh, gltf.list("materials", material), name=name)
    gltf.write(file)


def cat(file):
    """Green points down and w is inverted: together they cancel out. The coat is blended, and opaque nearly everywhere;
    the mirrored halves of the body share their texels."""
    gltf = Gltf()
    materials = []
    for name, blend in (("lambert2", True), ("lambert3", False)):
        names = {key: f"textures/{name}_{word}.png" for key, word in
                 (("base", "baseColor"), ("rough", "metallicRoughness"), ("normal", "normal"))}
        base = np.dstack([shapes.checks((60, 60, 120), (90, 90, 160), 8, 128), np.full((128, 128), 255, np.uint8)])
        if blend:
            base[:3, :, 3] = 0  # a seam
        maps = surface_maps(gltf, shapes.domes(9, 0.3) if blend else shapes.bumps(0.35), 256, names, green=-1)
        gltf.files[names["base"]] = png(base)
        materials.append(gltf.list("materials", material_of(maps, name=name, doubleSided=True, **(
            {"alphaMode": "BLEND"} if blend else {}))))
    half = shapes.zone(32, 24, -1.2, 1.2, 0.5).charted(*quarter(0))
    other = Mesh(half.position * [-1, 1, 1], half.normal * [-1, 1, 1], half.uv, half.triangles[:, ::-1])
    gltf.mesh(half, materials[1], name="body right")
    gltf.mesh(other, materials[1], name="body left")
    coat = shapes.zone(48, 16, -0.9, 0.2).charted(*quarter(0))
    gltf.mesh(coat.moved(scale=1.15), materials[0], name="coat")
    gltf.mesh(shapes.zone(32, 16).charted(*quarter(1)).moved((0, 1.5, 0), 0.6), materials[1], name="head")
    for k, x in enumerate((-0.25, 0.25)):
        eye = shapes.zone(16, 8, -0.8, 0.8, 0.4).charted(*quarter(1 + k))
        gltf.mesh(eye.moved((x, 1.5, 0.5), 0.18), materials[0], name=f"eye {k}")
        leg = shapes.tube(16, 8, lambda t: 0.2 + 0 * t, 0.9).charted(*quarter(2 + k))
        if k:
            leg = leg.charted((-1, 1), (1.5, 0))  # mirrored
        gltf.mesh(leg.moved((2 * x, -1.2, 0)), materials[1], name=f"leg {k}")
    gltf.write(file)


def sofa(file):
    gltf = Gltf()
    gltf.extend("KHR_texture_transform", required=True)
    gltf.extend("KHR_materials_sheen", "KHR_materials_specular", "KHR_lights_punctual")
    occlusion = gltf.image(shapes.plain((250, 250, 250)))
    bumps = gltf.image(shapes.relief_map(shapes.bumps(0.5), 512))
    normal = {**bumps, "scale": 0.75, "extensions": {"KHR_texture_transform": {"rotation": 0.36, "scale": [5, 5]}}}
    gltf.list("materials", {"name": "fabric navy", "normalTexture": normal, "occlusionTexture": occlusion,
                            "pbrMetallicRoughness": {"baseColorFactor": [0.01, 0.01, 0.01, 1], "metallicFactor": 0,
                                                     "roughnessFactor": 0.7},
                            "extensions": {"KHR_materials_sheen": {"sheenColorFactor": [0.05, 0.17, 0.5],
                                                                   "sheenRoughnessFactor": 0.4},
                                           "KHR_materials_specular": {"specularFactor": 0.2}}})
    gltf.list("materials", {"name": "legs", "occlusionTexture": occlusion,
                            "pbrMetallicRoughness": {"baseColorFactor": [0.02, 0.02, 0.02, 1], "metallicFactor": 0,
                                                     "roughnessFactor": 0.4}})
    for k, (half, at) in enumerate((((1, 0.25, 0.45), (0, 0, 0)), ((1, 0.4, 0.15), (0, 0.5, -0.4)),
                                    ((0.18, 0.4, 0.45), (-1.1, 0.2, 0)), ((0.18, 0.4, 0.45), (1.1, 0.2, 0)))):
        gltf.mesh(shapes.rounded_box(half, 0.12, 12, six_charts).moved(at), 0, name=f"cushion {k}")
    for k, x in enumerate((-0.9, 0.9)):
        gltf.mesh(shapes.tube(12, 2, lambda t: 0.06 + 0 * t, 0.3).moved((x, -0.35, 0.3)), 1, name=f"leg {k}")
    gltf.root["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 3}]}}
    gltf.node({"name": "light", "rotation": [-0.4, 0, 0, 0.917], "extensions": {"KHR_lights_punctual": {"light": 0}}})
    gltf.write(file)


def two_sided_plane(file):
    """Two triangles that a camera at the front sees at a small angle."""
    gltf = Gltf()
    maps = surface_maps(gltf, shapes.domes(4, 0.25, 0.5), 256)
    gltf.list("materials", {"name": "TwoSidedPlane", "doubleSided": True, "normalTexture": maps["normal"],
                            "pbrMetallicRoughness": {"baseColorTexture": maps["base"],
                                                     "metallicRoughnessTexture": maps["rough"]}})
    p = np.array([[-1, 0, 1], [1, 0, 1], [-1, 0, -1], [1, 0, -1]], float)
    gltf.mesh(Mesh(p, np.tile([0.0, 1, 0], (4, 1)), np.array([[0, 1], [1, 1], [0, 0], [1, 0]], float),
                   shapes.grid_triangles(1, 1)), 0, name="plane")
    gltf.write(file)


def multi_uv(file):
    gltf = Gltf()
    base, light = [gltf.image(shapes.checks(a, b, 4)) for a, b in (((90, 90, 90), (200, 200, 200)), ((0, 0, 0), (40, 0, 0)))]
    gltf.list("materials", {"name": "Material", "pbrMetallicRoughness": {"baseColorTexture": base},
                            "emissiveTexture": {**light, "texCoord": 1}, "emissiveFactor": [1, 1, 1]})
    cube = shapes.cube(1)
    gltf.mesh(cube, 0, name="cube", TEXCOORD_1=cube.uv * 0.5 + 0.25)
    camera = gltf.list("cameras", {"type": "perspective",
                                   "perspective": {"yfov": 0.7, "znear": 0.1, "zfar": 100, "aspectRatio": 1.5}})
    gltf.node({"camera": camera, "translation": [0, 0, 6]})
    gltf.node({"name": "light", "translation": [4, 1, 5]})
    gltf.write(file)


def vertex_colors(file):
    """Boxes with colours at their vertices; the uv of some sides are mirrored, of others one point."""
    gltf = Gltf()
    for name, a, b in (("Label_Mat", (240, 240, 240), (60, 60, 60)), ("VC_Checks_Mat", (255, 255, 255), (230, 230, 230))):
        gltf.list("materials", {"name": name, "doubleSided": True, "pbrMetallicRoughness": {
            "baseColorTexture": gltf.image(shapes.checks(a, b, 4)), "metallicFactor": 0, "roughnessFactor": 0.9}})
    gltf.mesh(shapes.quad((-1.5, -1), (-0.7, 1)), 0, name="label")
    boxes = shapes.joined([shapes.cube(0.3).moved((x, y, 0)) for x in (0, 0.8) for y in (-0.5, 0.5)])
    side = np.arange(len(boxes.uv)) // 4
    boxes.uv[side % 3 == 1] *= [-1, 1]
    boxes.uv[side % 6 == 2] = 0.5
    colour = np.abs(boxes.normal) * 0.6 + 0.3
    gltf.mesh(boxes, 1, name="boxes", COLOR_0=np.hstack([colour, np.ones((len(colour), 1))]))
    gltf.write(file)


def sunglasses(file):
    """Parts without uv, and 4,000 triangles whose uv are one point beside sound ones; iridescent lenses."""
    gltf = Gltf()
    gltf.extend("KHR_materials_transmission", "KHR_materials_volume", "KHR_materials_ior", "KHR_materials_iridescence")
    base = gltf.image(shapes.checks((30, 30, 30), (60, 50, 50), 8))
    gltf.list("materials", {"name": "earhooks", "pbrMetallicRoughness": {"baseColorTexture": base, "metallicFactor": 0,
                                                                         "roughnessFactor": 0.2}})
    gltf.list("materials", {"name": "temples", "pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.9, 0.9, 1],
                                                                        "roughnessFactor": 0.05}})
    gltf.list("materials", {"name": "lens", "pbrMetallicRoughness": {"baseColorFactor": [0.02, 0.02, 0.02, 1],
                                                                     "metallicFactor": 0, "roughnessFactor": 0},
                            "extensions": {"KHR_materials_iridescence": {"iridescenceFactor": 1, "iridescenceIor": 2},
                                           "KHR_materials_ior": {"ior": 1.7},
                                           "KHR_materials_transmission": {"transmissionFactor": 0.5}}})
    for k, x in enumerate((-0.6, 0.6)):
        lens = shapes.zone(48, 24, -0.7, 0.7, 0.3).moved(scale=0.5).moved((x, 0, 0))
        gltf.mesh(Mesh(lens.position, lens.normal, None, lens.triangles), 2, name=f"lens {k}")
        arm = shapes.tube(16, 24, lambda t: 0.04 + 0 * t, 1.2).moved((1.8 * x, 0, 0))
        gltf.mesh(Mesh(arm.position, arm.normal, None, arm.triangles), 1, name=f"temple {k}")
        hook = shapes.torus(0.2, 0.05, 50, 42).moved((1.8 * x, -0.8, 0))
        point = shapes.split(hook)
        point.uv[:3 * len(hook.triangles) // 2] = 0.25
        gltf.mesh(point, 0, name=f"earhook {k}")
    gltf.write(file)


# ---- materials -----------------------------------------------------------------------------------------------------

def anisotropy_strength(file):
    """Fourteen bands of spheres with mirrored uv: w = -1 everywhere. The labels have no tangents."""
    gltf = Gltf()
    gltf.extend("KHR_materials_anisotropy")
    mesh = shapes.zone(64, 40, -0.9, 0.9).charted((-1, 1), (1, 0)).moved(scale=0.45)
    for k in range(14):
        gltf.list("materials", {"pbrMetallicRoughness": {"roughnessFactor": 0.05 if k < 7 else 0.35},
                                "extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": k % 7 / 6}}})
        gltf.mesh(mesh.moved((k % 7 - 3, 0.5 - k // 7, 0)), k, name=f"sphere {k}")
    label = gltf.image(shapes.checks((255, 255, 255), (40, 40, 40), 8))
    gltf.list("materials", {"pbrMetallicRoughness": {"baseColorTexture": label, "metallicFactor": 0}})
    gltf.mesh(shapes.quad((-3.5, -1.4), (3.5, -1.15)), 14, name="label")
    gltf.write(file)


def anisotropy_disc(file):
    """Discs in a plane, whose direction comes from a texture that runs in circles."""
    gltf = Gltf()
    gltf.extend("KHR_materials_anisotropy")
    x, y = np.meshgrid((np.arange(128) + 0.5) / 64 - 1, 1 - (np.arange(128) + 0.5) / 64)
    length = np.hypot(x, y)
    circle = np.stack([-y / length, x / length, np.ones_like(x)], 2)
    direction = gltf.image(np.round(circle * [127.5, 127.5, 255] + [127.5, 127.5, 0]).astype(np.uint8))
    ring = shapes.surface(lambda s, t: (-(0.08 + 0.37 * t) * np.cos(2 * np.pi * s), (0.08 + 0.37 * t) * np.sin(2 * np.pi * s),
                                        0 * s), 48, 6)
    disc = Mesh(ring.position, ring.normal, ring.position[:, :2] * [1 / 0.9, -1 / 0.9] + 0.5, ring.triangles)
    for k in range(6):
        gltf.list("materials", {"pbrMetallicRoughness": {"metallicFactor": 1, "roughnessFactor": 0.1 + 0.1 * k},
                                "extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 1,
                                                                            "anisotropyTexture": direction}}})
        gltf.mesh(disc.moved((k % 3 - 1, 0.5 - k // 3, 0)), k, name=f"disc {k}")
    base = shapes.rounded_box((1.6, 1.1, 0.05), 0.03, 4).moved((0, 0, -0.2))
    gltf.list("materials", {"pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.2, 0.2, 1], "metallicFactor": 0}})
    gltf.mesh(Mesh(base.position, base.normal, None, base.triangles), 6, name="plate")
    gltf.write(file)


def transmission(file, volumes):
    """Spheres of glass before a striped wall. volumes: with attenuation, which is ignored with a warning."""
    gltf = Gltf()
    gltf.extend("KHR_materials_transmission", "KHR_materials_ior", "KHR_materials_volume")
    wall = gltf.image(shapes.checks((230, 230, 230), (40, 60, 90), 8))
    gltf.list("materials", {"pbrMetallicRoughness": {"baseColorTexture": wall, "metallicFactor": 0,
                                                     "roughnessFactor": 0.8}})
    gltf.mesh(shapes.quad((-2, -1), (2, 1)).moved((0, 0, -0.6)), 0, name="wall")
    ball = shapes.zone(48, 24, -1.5, 1.5).moved(scale=0.4)
    for k in range(4):
        volume = {"thicknessFactor": 0.4 * (k + 1), "attenuationColor": [0.1, 0.5, 0.9], "attenuationDistance": 1}
        gltf.list("materials", {"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.0 if volumes else 0.15 * k,
                                                         "baseColorFactor": [0.9, 0.95, 1, 1]},
                                "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
                                               "KHR_materials_ior": {"ior": 1.5 if volumes else 1 + 0.2 * k},
                                               "KHR_materials_volume": volume if volumes else {"thicknessFactor": 0.005}}})
        gltf.mesh(ball.moved((k - 1.5, 0, 0)), k + 1, name=f"ball {k}")
    gltf.write(file)


# ---- models that finish.mjs compresses -----------------------------------------------------------------------------

def heart(file):
    """180 triangles without uv."""
    gltf = Gltf()
    gltf.list("materials", {"pbrMetallicRoughness": {"baseColorFactor": [0.43, 0.02, 0.02, 1], "metallicFactor": 0.2,
                                                     "roughnessFactor": 0.8}})
    mesh = shapes.torus(0.6, 0.3, 15, 6)
    gltf.mesh(Mesh(mesh.position, mesh.normal, None, mesh.triangles), 0)
    gltf.write(file)


def pirate(file):
    gltf = Gltf()
    gltf.list("materials", {"pbrMetallicRoughness": {"metallicFactor": 0}})
    mesh = shapes.torus(0.6, 0.25, 64, 40)
    gltf.mesh(Mesh(mesh.position, mesh.normal, None, mesh.triangles), 0)
    gltf.write(file)


def chess_board(file):
    """w is inverted, and the map does not show which way green points. finish.mjs makes the images JPEG."""
    gltf = Gltf()
    gltf.extend("KHR_materials_clearcoat")
    for k, colour in enumerate((((30, 30, 30), (60, 60, 60)), ((120, 90, 60), (220, 200, 170)))):
        maps = surface_maps(gltf, shapes.grooves(0.3, 5 + k, 3), 256, colour=colour, noise=3)
        coat = {"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.03}}}
        gltf.list("materials", material_of(maps, name=("piece", "board")[k], doubleSided=True, **(coat if k == 0 else {})))
    gltf.list("materials", {"name": "frame", "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.3}})
    outline = lambda t: 0.1 + 0.12 * np.cos(2.6 * t)**2 + 0.03 * np.sin(9 * t)
    for k in range(4):
        gltf.mesh(shapes.tube(48, 48, outline, 0.9).moved((k - 1.5, 0.5, 0)), 0, name=f"piece {k}")
    gltf.mesh(shapes.rounded_box((2.2, 0.05, 1), 0.03, 8, six_charts), 1, name="board")
    gltf.mesh(shapes.rounded_box((2.3, 0.04, 1.1), 0.03, 4).moved((0, -0.06, 0)), 2, name="frame")
    gltf.write(file)


def jet_fighter(file):
    """w is inverted; the map is flat except for rows of rivets. finish.mjs makes the images KTX2 with BasisU."""
    gltf = Gltf()
    gltf.extend("KHR_materials_emissive_strength")
    maps = surface_maps(gltf, shapes.domes(16, 0.35, 0.25), 256)
    gltf.list("materials", {"name": "airframe", "doubleSided": True, "normalTexture": maps["normal"],
                            "pbrMetallicRoughness": {"baseColorTexture": maps["base"],
                                                     "metallicRoughnessTexture": maps["rough"]}})
    gltf.list("materials", {"name": "glass", "alphaMode": "BLEND", "doubleSided": True, "pbrMetallicRoughness": {
        "baseColorFactor": [1, 1, 1, 0.43], "roughnessFactor": 0}})
    gltf.list("materials", {"name": "lights", "emissiveFactor": [1, 1, 1], "extensions": {
        "KHR_materials_emissive_strength": {"emissiveStrength": 3.2}}})
    wing = lambda y: shapes.surface(lambda s, t: (4 * (s - 0.5), y + 0.3 * np.sin(2 * s), 2 * (0.5 - t)), 24, 12)
    gltf.mesh(wing(0), 0, name="upper wing")
    gltf.mesh(wing(0.8), 0, name="lower wing")
    gltf.mesh(shapes.zone(24, 12).moved((0, 0.5, 0.5), 0.3), 1, name="canopy")
    gltf.mesh(shapes.zone(12, 6).moved((0, 0.2, 1.2), 0.1), 2, name="light")
    gltf.write(file)


def make(folder, unfinished):
    """Writes all models; returns what finish.mjs has to do with those that are not finished."""
    jobs = []

    def place(name, work, *more, file=None, **steps):
        path = f"models/{name}/{file or name + '.glb'}"
        work((unfinished if steps else folder) / path, *more)
        if steps:
            jobs.append({"file": path, **steps})

    place("NormalTangentTest", normal_tangent,
          [(x, [(x + 0.32, (1, 1))]) for x in (-0.96, -0.16, 0.64)])
    place("NormalTangentMirrorTest", normal_tangent,
          [(-1.275, [(-0.955, (1, 1)), (-0.629, (-1, 1)), (-0.291, (1, -1))]),
           (0.3, [(0.62, (-1, 1)), (0.941, (1, -1)), (1.264, (-1, -1))])], tangents="mikktspace")
    place("BoomBox", boom_box, file="BoomBox.gltf")
    place("FlightHelmet", flight_helmet, file="FlightHelmet.gltf", tangents="rotated")
    place("SketchfabCat", cat, file="scene.gltf", tangents="inverted")
    place("GlamVelvetSofa", sofa)
    place("TwoSidedPlane", two_sided_plane, tangents="inverted")
    place("MultiUVTest", multi_uv, tangents="half reversed")
    place("VertexColorTest", vertex_colors, tangents="mikktspace")
    place("SunglassesKhronos", sunglasses)
    place("AnisotropyStrengthTest", anisotropy_strength, tangents="mikktspace", only="sphere")
    materials = folder / "materials"
    anisotropy_disc(unfinished / "materials/AnisotropyDiscTest.glb")
    jobs.append({"file": "materials/AnisotropyDiscTest.glb", "tangents": "mikktspace", "only": "disc [0-3]"})
    transmission(materials / "AttenuationTest.glb", True)
    transmission(materials / "TransmissionRoughnessTest.glb", False)
    for name, work, steps in (("heart_draco", heart, {"compress": "draco"}),
                              ("pirate_meshopt", pirate, {"compress": "meshopt"}),
                              ("chess_board_draco", chess_board, {"tangents": "inverted", "only": "piece|board",
                                                                  "images": "jpeg", "compress": "draco"}),
                              ("jet_fighter_draco_basisu", jet_fighter, {"tangents": "inverted", "only": "wing",
                                                                         "images": "ktx2", "compress": "draco"})):
        work(unfinished / f"compressed/{name}.glb")
        jobs.append({"file": f"compressed/{name}.glb", **steps})
    return jobs
