"""What the panel asks."""

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

FRAMES = [
    ("mikktspace", "MikkTSpace", "Blender's own Normal Map node and most engines. With stored or generated tangents"),
    ("smooth", "smooth", "Cotan's, without steps between triangles: two vectors a vertex, made at load"),
    ("cotangent", "cotangent", "Cotan's, made in the pixel shader from nothing stored"),
    ("triangle", "triangle", "cotangent from two vectors a triangle: fewest instructions"),
    ("orthonormal", "orthonormal", "The tangent-free reading nearest to MikkTSpace"),
    ("vertex", "vertex", "Tangents at the vertices, not made orthogonal"),
]


class CotanSettings(bpy.types.PropertyGroup):
    frame: EnumProperty(
        name="Frame", items=FRAMES, default="mikktspace",
        description="Frame of the shader that will read the map",
    )
    width: IntProperty(
        name="Width", default=2048, min=1, max=16384, subtype="PIXEL",
        description="Of the map, in texels",
    )
    height: IntProperty(
        name="Height", default=2048, min=1, max=16384, subtype="PIXEL",
        description="Of the map, in texels",
    )
    bits: EnumProperty(name="Bits", items=[("8", "8", ""), ("16", "16", "")], default="8", description="Per component")
    samples: EnumProperty(
        name="Samples", items=[("1", "1", ""), ("4", "4", ""), ("16", "16", "")], default="1", description="Per texel"
    )
    padding: IntProperty(
        name="Padding", default=0, min=-1, max=65536,
        description="Texels around charts that are filled from the nearest chart. 0: all, -1: none",
    )
    uv_map: StringProperty(name="UV Map", description="Of the simple mesh. Empty: its active one")
    cage: EnumProperty(
        name="Rays",
        items=[
            ("FIRST", "Measured", "From outside inwards, the first surface counts; from as far as the detail stands off"),
            ("NEAREST", "Nearest", "Both ways along the normal: the nearer surface counts"),
            ("BLENDER", "As Blender's", "Extrusion, ray distance and cage of Blender's own baker"),
            ("MESH", "Cage", "From a mesh with the vertices of the simple one; pairs by name: from x_cage"),
        ],
        default="FIRST",
        description="Where the detailed surface is looked for",
    )
    distance: FloatProperty(
        name="Distance", default=0, min=0, subtype="DISTANCE",
        description="Detail further from the simple mesh does not count. 0: 10 % of the simple mesh's box, for Nearest "
        "5 % of the detailed one's",
    )
    extrusion: FloatProperty(
        name="Extrusion", default=0, min=0, subtype="DISTANCE",
        description="How far in front of the simple mesh rays start. 0: measured",
    )
    cage_object: PointerProperty(name="Cage", type=bpy.types.Object, poll=lambda _, o: o.type == "MESH")
    as_rendered: BoolProperty(
        name="As Rendered", default=True,
        description="Modifiers and levels of subdivision as in a render, not as in the viewport",
    )
    each_material: BoolProperty(
        name="Per Material", default=False,
        description="A map for each material, of its faces only; else one for the whole mesh",
    )
    assign: BoolProperty(
        name="Assign", default=True,
        description="Put the map into the Normal Map node of the simple mesh's materials",
    )
    store: EnumProperty(
        name="Store",
        items=[("PACK", "Packed", "In the .blend file"), ("FILE", "File", "A PNG file in a folder")],
        default="PACK",
        description="Where the map is kept",
    )
    folder: StringProperty(name="Folder", default="//", subtype="DIR_PATH", description="For the maps")
    overwrite: BoolProperty(
        name="Replace Files", default=False,
        description="Of the same name that no image of this file stands for",
    )
    degrees: FloatProperty(
        name="Degrees", default=15, min=0.1, max=90,
        description="Faces on which MikkTSpace and cotangent differ by more are in question",
    )
    to_frame: EnumProperty(
        name="Frame", items=[f for f in FRAMES if f[0] not in ("mikktspace", "vertex")], default="orthonormal",
        description="Frame that the exported maps are for",
    )


class CotanLine(bpy.types.PropertyGroup):
    text: StringProperty()
    kind: StringProperty()  # of faces in question; "": it is not about faces


def register():
    bpy.utils.register_class(CotanSettings)
    bpy.utils.register_class(CotanLine)
    bpy.types.Scene.cotan = PointerProperty(type=CotanSettings)
    bpy.types.WindowManager.cotan_progress = FloatProperty(name="Baking", subtype="PERCENTAGE", min=0, max=100)
    bpy.types.WindowManager.cotan_running = BoolProperty(default=False)
    bpy.types.WindowManager.cotan_lines = CollectionProperty(type=CotanLine)


def unregister():
    del bpy.types.WindowManager.cotan_lines
    del bpy.types.WindowManager.cotan_running
    del bpy.types.WindowManager.cotan_progress
    del bpy.types.Scene.cotan
    bpy.utils.unregister_class(CotanLine)
    bpy.utils.unregister_class(CotanSettings)
