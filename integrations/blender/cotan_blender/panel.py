"""The panel in the object's properties."""

import textwrap

import bpy

from . import frames
from .settings import MAPS


class CotanPanel(bpy.types.Panel):
    bl_idname = "OBJECT_PT_cotan"
    bl_label = "Cotan"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "object"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        pass


class _Part:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "object"
    bl_parent_id = "OBJECT_PT_cotan"

    def begun(self):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        return self.layout


class CotanBakePanel(_Part, bpy.types.Panel):
    bl_idname = "OBJECT_PT_cotan_bake"
    bl_label = "Bake"

    def draw(self, context):
        layout, s = self.begun(), context.scene.cotan
        layout.prop(s, "frame")
        if s.frame != "mikktspace":
            layout.label(text="Blender's own Normal Map node reads MikkTSpace", icon="INFO")
            if s.frame in frames.SHOWN:
                layout.label(text="To see this frame: Use Cotan's Frame, below", icon="BLANK1")
        layout.label(text="Maps (Shift-click for several)")
        grid = layout.grid_flow(columns=2, align=True)
        grid.use_property_split = False
        for word, *_ in MAPS:
            grid.prop_enum(s, "maps", word)
        if "id" in s.maps:
            layout.prop(s, "id_by")
            if s.id_by == "VERTEX_COLOR":
                layout.prop(s, "id_colors", icon="GROUP_VCOL")
        column = layout.column(align=True)
        column.prop(s, "width")
        column.prop(s, "height")
        row = layout.row()
        row.prop(s, "bits", expand=True)
        row = layout.row()
        row.prop(s, "samples", expand=True)
        layout.prop(s, "padding")
        thing = context.object
        if thing is not None and thing.type == "MESH":
            layout.prop_search(s, "uv_map", thing.data, "uv_layers", icon="GROUP_UVS")
        layout.prop(s, "cage")
        if s.cage == "FIRST":
            row = layout.row()
            row.active = s.rays_mask is None
            row.prop(s, "directions")
            if s.directions == "VERTEX_COLOR" and s.rays_mask is None and thing is not None and thing.type == "MESH":
                layout.prop_search(s, "rays_colors", thing.data, "color_attributes", icon="GROUP_VCOL")
            layout.prop(s, "rays_mask")
            layout.prop(s, "extrusion")
            layout.operator("object.cotan_cage", icon="MESH_ICOSPHERE")
        if s.cage in ("FIRST", "NEAREST"):
            layout.prop(s, "distance")
        elif s.cage == "MESH":
            layout.prop(s, "cage_object")
        else:
            self._draw_blenders(layout.column(align=True), context.scene.render.bake)
        layout.prop(s, "as_rendered")
        layout.prop(s, "each_material")
        layout.prop(s, "assign")
        row = layout.row()
        row.prop(s, "store", expand=True)
        if s.store == "FILE":
            layout.prop(s, "folder")
            layout.prop(s, "overwrite")
        self._draw_buttons(layout, context.window_manager)

    @staticmethod
    def _draw_blenders(column, bake):
        column.prop(bake, "use_cage")
        if bake.use_cage:
            column.prop(bake, "cage_object")
        column.prop(bake, "cage_extrusion")
        column.prop(bake, "max_ray_distance")

    @staticmethod
    def _draw_buttons(layout, manager):
        if manager.cotan_running:
            if hasattr(layout, "progress"):  # since 4.0
                layout.progress(factor=manager.cotan_progress / 100, text=f"{manager.cotan_progress:.0f} %. Esc stops")
            else:
                layout.prop(manager, "cotan_progress", slider=True, text="Esc stops")
            return
        column = layout.column()
        column.operator("object.cotan_bake", text="Bake Selected to Active", icon="RENDER_STILL").which = "ACTIVE"
        column.operator("object.cotan_bake", text="Bake Pairs by Name", icon="SORTALPHA").which = "NAMES"
        column = layout.column()
        column.operator("object.cotan_frame", icon="SHADING_RENDERED").which = "COTAN"
        column.operator("object.cotan_frame", text="Use Blender's Node", icon="LOOP_BACK").which = "BLENDER"


class CotanCheckPanel(_Part, bpy.types.Panel):
    bl_idname = "OBJECT_PT_cotan_check"
    bl_label = "Check"

    def draw(self, context):
        layout = self.begun()
        layout.prop(context.scene.cotan, "degrees")
        layout.operator("object.cotan_check", icon="VIEWZOOM").kind = "ALL"
        letters = max(20, int(context.region.width / (7.5 * context.preferences.system.ui_scale)))
        for line in context.window_manager.cotan_lines:
            box = layout.box().column(align=True)
            for text in textwrap.wrap(line.text, letters):
                box.label(text=text)
            if line.kind:
                box.operator("object.cotan_check", text="Select These", icon="RESTRICT_SELECT_OFF").kind = line.kind


class CotanExportPanel(_Part, bpy.types.Panel):
    bl_idname = "OBJECT_PT_cotan_export"
    bl_label = "Export"

    def draw(self, context):
        layout = self.begun()
        settings = context.scene.cotan
        layout.prop(settings, "to_frame")
        if settings.to_frame == "MEASURED":
            layout.prop(settings, "max_degrees")
        layout.operator("export_scene.cotan_gltf", text="Export glTF", icon="EXPORT")


CLASSES = [CotanPanel, CotanBakePanel, CotanCheckPanel, CotanExportPanel]
