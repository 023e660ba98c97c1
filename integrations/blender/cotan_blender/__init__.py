"""Cotan for Blender: bakes normal maps for the frame that will read them, checks meshes, exports glTF without tangents.
Needs Blender 3.4 or later."""

import bpy

from . import operators, panel, settings

bl_info = {
    "name": "Cotan: normal maps",
    "author": "The authors of Cotan",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "Properties > Object > Cotan",
    "description": "Bakes normal maps for the frame that will read them, checks meshes, exports glTF without tangents",
    "category": "Render",
}

CLASSES = [
    operators.CotanBake,
    operators.CotanCage,
    operators.CotanCheck,
    operators.CotanExport,
    operators.CotanFrame,
    *panel.CLASSES,
]


def register():
    settings.register()
    for each in CLASSES:
        bpy.utils.register_class(each)


def unregister():
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
    settings.unregister()
