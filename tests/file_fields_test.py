#!/usr/bin/env python3
"""Every field of a glTF file that a render depends on has an effect, and without it the specification's default
applies.

file_fields_test.py    (with PYTHONPATH and COTAN_LIBRARY: one process draws all images)

The defaults are those of glTF 2.0 and its extensions. In a scene every field has a value other than its default. For
each field it is drawn unchanged, without the field, with the default, and with each component of the value changed
alone. Images without the field and with the default are bitwise equal; any two others differ."""
import copy
import itertools
import json
import math
import pathlib
import sys
import tempfile

import cotan

from output_inputs import make_inputs

CAMERA_0, CAMERA_1 = {"camera": 0}, {"camera": 1}
MATERIAL = "materials/0/"
LIGHTS = "extensions/KHR_lights_punctual/lights/"
ONE, NONE = [1, 1, 1], [0, 0, 0]

# Path of the field, its default, and the options that draw it. ABSENT: no value means the same as leaving the field out.
ABSENT = object()
FIELDS = [
    (MATERIAL + "pbrMetallicRoughness/baseColorFactor", [1, 1, 1, 1], CAMERA_0),
    (MATERIAL + "pbrMetallicRoughness/metallicFactor", 1, CAMERA_0),
    (MATERIAL + "pbrMetallicRoughness/roughnessFactor", 1, CAMERA_0),
    (MATERIAL + "pbrMetallicRoughness/baseColorTexture/texCoord", 0, CAMERA_0),
    (MATERIAL + "pbrMetallicRoughness/baseColorTexture", ABSENT, CAMERA_0),
    (MATERIAL + "pbrMetallicRoughness/metallicRoughnessTexture", ABSENT, CAMERA_0),
    (MATERIAL + "normalTexture", ABSENT, CAMERA_0),
    (MATERIAL + "normalTexture/scale", 1, CAMERA_0),
    (MATERIAL + "normalTexture/extensions/KHR_texture_transform/offset", [0, 0], CAMERA_0),
    (MATERIAL + "normalTexture/extensions/KHR_texture_transform/rotation", 0, CAMERA_0),
    (MATERIAL + "normalTexture/extensions/KHR_texture_transform/scale", [1, 1], CAMERA_0),
    (MATERIAL + "occlusionTexture", ABSENT, CAMERA_0),
    (MATERIAL + "occlusionTexture/texCoord", 0, CAMERA_0),
    (MATERIAL + "occlusionTexture/strength", 1, CAMERA_0),
    (MATERIAL + "emissiveTexture", ABSENT, CAMERA_0),
    (MATERIAL + "emissiveFactor", NONE, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_emissive_strength/emissiveStrength", 1, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_clearcoat/clearcoatFactor", 0, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_clearcoat/clearcoatTexture", ABSENT, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor", 0, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_clearcoat/clearcoatRoughnessTexture", ABSENT, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_clearcoat/clearcoatNormalTexture", ABSENT, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_clearcoat/clearcoatNormalTexture/scale", 1, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_anisotropy/anisotropyStrength", 0, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_anisotropy/anisotropyRotation", 0, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_anisotropy/anisotropyTexture", ABSENT, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_sheen/sheenColorFactor", NONE, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_sheen/sheenColorTexture", ABSENT, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_sheen/sheenRoughnessFactor", 0, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_sheen/sheenRoughnessTexture", ABSENT, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_ior/ior", 1.5, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_specular/specularFactor", 1, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_specular/specularTexture", ABSENT, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_specular/specularColorFactor", ONE, CAMERA_0),
    (MATERIAL + "extensions/KHR_materials_specular/specularColorTexture", ABSENT, CAMERA_0),
    ("materials/1/doubleSided", False, {"camera": (-1, 0.4, -3, 0, 0, 0)}),
    ("materials/1/pbrMetallicRoughness", ABSENT, CAMERA_0),
    ("materials/3/alphaMode", "OPAQUE", CAMERA_0),
    ("materials/3/extensions/KHR_materials_transmission/transmissionFactor", 0, CAMERA_0),
    ("materials/4/alphaMode", "OPAQUE", CAMERA_0),
    ("materials/4/alphaCutoff", 0.5, CAMERA_0),
    ("materials/5/extensions/KHR_materials_unlit", ABSENT, CAMERA_0),
    ("samplers/0/wrapS", 10497, CAMERA_0),
    ("samplers/0/wrapT", 10497, CAMERA_0),
    ("samplers/0/magFilter", 9729, CAMERA_0),
    ("textures/2/sampler", ABSENT, CAMERA_0),
    ("nodes/0/rotation", [0, 0, 0, 1], CAMERA_0),
    ("nodes/1/translation", NONE, CAMERA_0),
    ("nodes/2/scale", ONE, CAMERA_0),
    ("nodes/14/weights", ABSENT, CAMERA_0),
    ("meshes/2/weights", [0], CAMERA_0),
    ("nodes/4/extensions/EXT_mesh_gpu_instancing/attributes/SCALE", ABSENT, CAMERA_0),
    ("nodes/5/matrix", [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], CAMERA_0),
    ("nodes/8/translation", NONE, CAMERA_0),
    ("nodes/10/rotation", [0, 0, 0, 1], CAMERA_0),
    (LIGHTS + "0/color", ONE, CAMERA_0),
    (LIGHTS + "0/intensity", 1, CAMERA_0),
    (LIGHTS + "1/range", ABSENT, CAMERA_0),
    (LIGHTS + "1/spot/innerConeAngle", 0, CAMERA_0),
    (LIGHTS + "1/spot/outerConeAngle", math.pi / 4, CAMERA_0),
    (LIGHTS + "2/color", ONE, CAMERA_0),
    (LIGHTS + "2/intensity", 1, CAMERA_0),
    ("animations/0/samplers/1/interpolation", "LINEAR", {**CAMERA_0, "animation": 0, "time": 0.3}),
    ("animations/0/samplers/0/interpolation", "LINEAR", {**CAMERA_0, "animation": 0, "time": 0.3}),
    ("meshes/0/primitives/0/mode", 4, CAMERA_0),
    ("meshes/0/primitives/0/material", ABSENT, CAMERA_0),
    ("meshes/0/primitives/0/attributes/TEXCOORD_1", ABSENT, CAMERA_0),
    ("scene", 0, CAMERA_0),
]

# Fields without a default, or that may not be left out: each component changes the image.
REQUIRED = [
    ("cameras/0/perspective/yfov", CAMERA_0),
    ("cameras/1/orthographic/ymag", CAMERA_1),
    ("nodes/11/translation", CAMERA_0),
    ("nodes/12/translation", CAMERA_1),
    ("nodes/5/children/0", CAMERA_0),
    ("nodes/3/skin", CAMERA_0),
    ("skins/0/joints/0", CAMERA_0),
    ("skins/0/joints/1", CAMERA_0),
    ("nodes/6/translation", CAMERA_0),
    ("nodes/7/translation", CAMERA_0),
    ("nodes/9/extensions/KHR_lights_punctual/light", CAMERA_0),
    ("textures/0/source", CAMERA_0),
    (LIGHTS + "0/type", CAMERA_0),
    ("animations/0/channels/0/target/node", {**CAMERA_0, "animation": 0, "time": 0.3}),
    ("animations/0/channels/1/target/path", {**CAMERA_0, "animation": 0, "time": 0.7}),
]

# Replacement values for fields whose numbers cannot simply be changed. For an index: the next.
OTHERS = {
    "materials/3/alphaMode": ["MASK"], "materials/4/alphaMode": ["BLEND"],
    "samplers/0/wrapS": [33071], "samplers/0/wrapT": [33648], "samplers/0/magFilter": [],
    "animations/0/samplers/1/interpolation": [], "animations/0/samplers/0/interpolation": ["STEP"],
    "meshes/0/primitives/0/mode": [5], "scene": [1], "nodes/5/children/0": [8], "nodes/3/skin": [ABSENT], "skins/0/joints/0": [8],
    "skins/0/joints/1": [8], LIGHTS + "0/type": ["directional"], "animations/0/channels/1/target/path": ["scale"],
    "nodes/5/matrix": [], "meshes/0/primitives/0/attributes/TEXCOORD_1": [], "textures/2/sampler": [], "meshes/0/primitives/0/material": [],
    "nodes/4/extensions/EXT_mesh_gpu_instancing/attributes/SCALE": [], "animations/0/channels/0/target/node": [2],
}


def scene(folder):
    """The room of the tables plus what it lacks: every texture, a second scene, a child, a matrix."""
    make_inputs(folder)
    root = json.loads((folder / "room.gltf").read_text())
    first = root["materials"][0]
    rough = lambda **more: {"index": 3, **more}
    first["pbrMetallicRoughness"]["baseColorTexture"] |= {"texCoord": 1, "extensions": {"KHR_texture_transform": {"offset": [0.6, 0.55]}}}
    first["pbrMetallicRoughness"]["baseColorFactor"][3] = 0.8
    first["emissiveTexture"] = {"index": 2}
    first["emissiveFactor"] = [0.1, 0.05, 0.08]
    first["extensions"] |= {
        "KHR_materials_anisotropy": {"anisotropyStrength": 0.8, "anisotropyRotation": 0.6, "anisotropyTexture": rough()},
        "KHR_materials_sheen": {"sheenColorFactor": [0.8, 0.6, 0.5], "sheenRoughnessFactor": 0.3, "sheenColorTexture": rough(), "sheenRoughnessTexture": {"index": 2}},
        "KHR_materials_ior": {"ior": 1.8},
        "KHR_materials_specular": {"specularFactor": 0.6, "specularColorFactor": [0.7, 0.9, 0.5], "specularTexture": {"index": 2}, "specularColorTexture": rough()}}
    first["extensions"]["KHR_materials_clearcoat"] |= {"clearcoatTexture": rough(), "clearcoatRoughnessTexture": rough()}
    first["extensions"]["KHR_materials_clearcoat"]["clearcoatNormalTexture"]["scale"] = 0.7
    first["alphaMode"] = "BLEND"
    root["materials"][1]["normalTexture"]["scale"] = 0.6
    root["nodes"][0]["rotation"] = [0.1, 0.05, 0.15, 0.98]
    root["nodes"][2]["translation"][2] = 0.4
    root["nodes"][5] = {"children": [len(root["nodes"])], "matrix": [-0.6, 0.1, 0, 0, 0.05, 0.6, 0.1, 0, 0.1, 0, 0.7, 0, 1.1, 1, 0.2, 1]}
    root["nodes"].append({"mesh": 5, "translation": [0.1, 0, 0]})
    root["nodes"].append({"mesh": 2, "translation": [0.2, 1, 0.4], "weights": [0.9]})
    root["scenes"][0]["nodes"].append(14)
    root["meshes"][2]["weights"] = [0.5]
    root["meshes"][0]["primitives"][0]["mode"] = 4
    glass = root["materials"][3]["pbrMetallicRoughness"]
    glass["metallicFactor"] = 0
    glass["baseColorFactor"][3] = 0.4
    root["scenes"].append({"nodes": [1, 11]})
    (folder / "scene.gltf").write_text(json.dumps(root))
    return root


def owner(root, path):
    """The container of the last name of the path, and that name."""
    *names, last = [int(n) if n.isdigit() else n for n in path.split("/")]
    for name in names:
        root = root[name]
    return root, last


def changed(root, path, value):
    """A copy with another value at the path, or without the field."""
    made = copy.deepcopy(root)
    holder, name = owner(made, path)
    if value is ABSENT:
        if isinstance(holder, list) or name in holder:
            del holder[name]
    else:
        holder[name] = value
    return made


def others(path, value):
    """The value with each of its numbers changed on its own."""
    if path in OTHERS:
        return OTHERS[path]
    if isinstance(value, dict) or isinstance(value, (str, bool)):
        return []
    if isinstance(value, list):
        return [value[:i] + [other] + value[i + 1:] for i, x in enumerate(value) for other in others(path + "/", x)]
    index = isinstance(value, int) and path.rpartition("/")[2] in ("index", "source", "light", "texCoord")
    return [] if index and "texCoord" in path else [value + 1 if index else 0.85 * value + 0.011]


def main():
    wrong, drawn = [], 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        root = scene(folder)

        def render(made, options):
            """The bytes of the image, or the error."""
            nonlocal drawn
            drawn += 1
            (folder / "made.gltf").write_text(json.dumps(made))
            try:
                return cotan.render(folder / "made.gltf", device="reference", size=(48, 30), samples=1, exposure=1, ground="off",
                                    floats=True, **options).tobytes()
            except cotan.Error as error:
                return str(error)

        as_it_is = {}

        def compare(path, options, default):
            holder, name = owner(root, path)
            if not isinstance(holder, list) and name not in holder:
                return [f"{path}: the scene has no such field"]
            shown = json.dumps(options)
            if shown not in as_it_is:
                as_it_is[shown] = render(root, options)
            images = {"as it is": as_it_is[shown]}
            for value in others(path, holder[name]):
                images["without" if value is ABSENT else json.dumps(value)] = render(changed(root, path, value), options)
            if default is not None:
                without = render(changed(root, path, ABSENT), options)
                if default is not ABSENT and render(changed(root, path, default), options) != without:
                    return [f"{path}: without it the image is another than with {default}"]
                if holder[name] != default:
                    images["without"] = without
                elif without != images["as it is"]:
                    return [f"{path}: without it the image is another than with {default}"]
            found = [f"{path}: {how}: {image}" for how, image in images.items() if isinstance(image, str)]
            return found + [f"{path}: the same image with {a} and {b}" for a, b in itertools.combinations(images, 2) if images[a] == images[b]]

        cases = [*FIELDS, *((path, None, options) for path, options in REQUIRED)]
        for path, default, options in cases:
            wrong += compare(path, options, default)
    print(*wrong, sep="\n", end="\n" if wrong else "")
    print(f"{len(cases)} fields in {drawn} images, {len(wrong)} wrong")
    return 1 if wrong or not drawn else 0


if __name__ == "__main__":
    sys.exit(main())
