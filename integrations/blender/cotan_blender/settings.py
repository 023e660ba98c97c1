"""The settings in the panel."""

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
    ("smooth", "smooth", "Cotan's, without steps between triangles: two vectors per vertex, computed at load"),
    ("cotangent", "cotangent", "Cotan's, computed in the pixel shader without stored data"),
    ("triangle", "triangle", "cotangent from two vectors per triangle: fewest instructions"),
    ("orthonormal", "orthonormal", "The tangent-free frame nearest to MikkTSpace"),
    ("vertex", "vertex", "Tangents per vertex, not orthogonalised"),
]
MAPS = [
    ("normal", "Normal", "Normals of the detail, in the frame; the only map that is put into materials", 1),
    ("object-normal", "Object Normal", "Normals of the detail in Blender's world, z up", 2),
    ("ao", "Occlusion", "Open part of the hemisphere", 4),
    ("height", "Height", "Distance along the normal, from the lowest to the highest", 8),
    ("curvature", "Curvature", "Mean curvature: 0.5 is flat, brighter is convex", 16),
    ("thickness", "Thickness", "Mean length of rays inwards", 32),
    ("bent-normal", "Bent Normal", "Mean open direction, in the frame", 64),
    ("position", "Position", "Position in Blender's world, from 0 to 1 over the box of the detail", 128),
    ("base-color", "Base Color", "Base colour of the detail's materials: numbers and images", 256),
    ("roughness", "Roughness", "That of the detail's materials", 512),
    ("metallic", "Metallic", "That of the detail's materials", 1024),
    ("emissive", "Emission", "Light of the detail's materials, at most 1", 2048),
    ("id", "Ids", "A colour for each material or object of the detail, or its vertex colours", 4096),
]
MEASURED = [
    ("MEASURED", "Measured", "Keeps the maps; each part gets the cheapest frame that looks the same, which the file names"),
]


class CotanSettings(bpy.types.PropertyGroup):
    frame: EnumProperty(
        name="Frame", items=FRAMES, default="mikktspace",
        description="Frame of the shader that will read the map",
    )
    maps: EnumProperty(
        name="Maps", items=MAPS, default={"normal"}, options={"ENUM_FLAG"},
        description="Maps to bake. Shift-click chooses several",
    )
    id_by: EnumProperty(
        name="Ids of",
        items=[
            ("MATERIAL", "Materials", "Each material of the detail has a colour of its own"),
            ("OBJECT", "Objects", "Each object of the detail has a colour of its own"),
            ("VERTEX_COLOR", "Vertex Colors", "The colours that are painted on the detail; white where there are none"),
        ],
        default="MATERIAL",
        description="What has a colour of its own in the map of ids",
    )
    id_colors: StringProperty(
        name="Color Attribute", description="Color attribute of the detailed meshes. Empty: the active one of each"
    )
    width: IntProperty(
        name="Width", default=2048, min=1, max=16384, subtype="PIXEL",
        description="Width of the map in texels",
    )
    height: IntProperty(
        name="Height", default=2048, min=1, max=16384, subtype="PIXEL",
        description="Height of the map in texels",
    )
    bits: EnumProperty(
        name="Bits", items=[("8", "8", ""), ("16", "16", "")], default="8", description="Bits per component"
    )
    samples: EnumProperty(
        name="Samples", items=[("1", "1", ""), ("4", "4", ""), ("16", "16", "")], default="4",
        description="Samples per texel",
    )
    padding: IntProperty(
        name="Padding", default=0, min=-1, max=65536,
        description="Texels around charts that are filled from the nearest chart. 0: all, -1: none",
    )
    uv_map: StringProperty(name="UV Map", description="UV map of the simple mesh. Empty: its active one")
    cage: EnumProperty(
        name="Search",
        items=[
            ("FIRST", "First", "Rays from outside hit the first surface; their start is measured from the detail"),
            ("NEAREST", "Nearest", "Rays run both ways along the normal; the nearer surface counts"),
            ("BLENDER", "As Blender's", "Extrusion, ray distance and cage of Blender's own baker"),
            ("MESH", "Cage", "Rays start at a mesh with the vertices of the simple one; pairs by name: at x_cage"),
        ],
        default="FIRST",
        description="How rays search for the detailed surface",
    )
    directions: EnumProperty(
        name="Rays",
        items=[
            ("AUTO", "Auto", "Along the normals of the simple mesh, and averaged near hard edges"),
            ("AVERAGED", "Averaged", "Along normals averaged over hard edges: no gaps, but details lean"),
            ("STRAIGHT", "Straight", "Along the normals of the simple mesh: with gaps at hard edges"),
            ("VERTEX_COLOR", "Vertex Color", "Straight where the red of the simple mesh's colours is 1, averaged where 0"),
        ],
        default="AUTO",
        description="Which way rays run",
    )
    rays_colors: StringProperty(
        name="Color Attribute", description="Color attribute of the simple mesh. Empty: its active one"
    )
    rays_mask: PointerProperty(
        name="Rays Mask", type=bpy.types.Image,
        description="Image in the uv map of the simple mesh that replaces Rays: they are straight where its red is 1 and "
        "averaged where it is 0",
    )
    distance: FloatProperty(
        name="Distance", default=0, min=0, subtype="DISTANCE",
        description="Maximum distance of detail from the simple mesh. 0: 10 % of the diagonal of the simple mesh, for "
        "Nearest 5 % of that of the detailed one",
    )
    extrusion: FloatProperty(
        name="Extrusion", default=0, min=0, subtype="DISTANCE",
        description="Distance in front of the simple mesh at which rays start. 0: measured",
    )
    cage_object: PointerProperty(name="Cage", type=bpy.types.Object, poll=lambda _, o: o.type == "MESH")
    as_rendered: BoolProperty(
        name="As Rendered", default=True,
        description="Use the modifiers and subdivision levels of renders, not those of the viewport",
    )
    each_material: BoolProperty(
        name="Per Material", default=False,
        description="Bake one map per material, of its faces only; otherwise one for the whole mesh",
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
    folder: StringProperty(name="Folder", default="//", subtype="DIR_PATH", description="Folder for the maps")
    overwrite: BoolProperty(
        name="Replace Files", default=False,
        description="Replace files of the same name that belong to no image of this .blend file",
    )
    degrees: FloatProperty(
        name="Degrees", default=15, min=0.1, max=90,
        description="Report faces on which MikkTSpace and cotangent differ by more than this",
    )
    to_frame: EnumProperty(
        name="Frame", items=MEASURED + [f for f in FRAMES if f[0] not in ("mikktspace", "vertex")], default="MEASURED",
        description="Frame of the exported maps",
    )
    max_degrees: FloatProperty(
        name="Degrees Off", default=0.3, min=0.001, max=180,
        description="What the measured frame of a part may be off on average; ten times as much on 1 % of its area",
    )


class CotanLine(bpy.types.PropertyGroup):
    text: StringProperty()
    kind: StringProperty()  # kind of the faces in question; "": the line is not about faces


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
