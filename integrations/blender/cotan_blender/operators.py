"""The operators of the panel's buttons."""

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty
from bpy_extras.io_utils import ExportHelper

from . import bake, cages, check, frames, gltf, pairs
from .refused import Refused, packages


def say(operator, outcome):
    """Reports the outcome in Blender. Failures are errors only if no image was made."""
    for note in outcome.notes:
        operator.report({"WARNING"}, note)
    for failure in outcome.failures:
        operator.report({"WARNING"} if outcome.made else {"ERROR"}, failure)
    if outcome.made:
        frames = dict.fromkeys(image["cotan_frame"] for image in outcome.made if "cotan_frame" in image)
        what = f"'{outcome.made[0].name}'" if len(outcome.made) == 1 else f"{len(outcome.made)} maps"
        operator.report({"INFO"}, f"Baked {what}" + "".join(f" for the frame {frame}" for frame in frames))
    return {"FINISHED"} if outcome.made else {"CANCELLED"}


def _require_object_mode(context):
    if context.mode != "OBJECT":
        raise Refused("Go back to Object Mode first")


class CotanBake(bpy.types.Operator):
    """Bake the chosen maps of detailed meshes for a simple one"""

    bl_idname = "object.cotan_bake"
    bl_label = "Bake Maps"
    bl_options = {"UNDO"}

    which: EnumProperty(
        name="Which",
        items=[
            ("ACTIVE", "Selected to Active", "The selected objects onto the active mesh"),
            ("NAMES", "Pairs by Name", "Each selected mesh x_low, or all if none is selected, from the objects x_high"),
        ],
        default="ACTIVE",
    )

    def _begin(self, context):
        _require_object_mode(context)
        found, notes = pairs.by_name(context) if self.which == "NAMES" else pairs.by_selection(context)
        self._outcome = bake.Outcome(notes=notes)
        self._steps = bake.run(context, context.scene.cotan, found, self._outcome)

    def execute(self, context):
        try:
            self._begin(context)
        except Refused as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for _ in self._steps:
            pass
        return say(self, self._outcome)

    def invoke(self, context, event):
        """Bakes as a modal operator, while the window is redrawn. Esc stops; other keys are ignored until the end."""
        if bpy.app.background:
            return self.execute(context)
        try:
            self._begin(context)
        except Refused as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self._timer = context.window_manager.event_timer_add(0.05, window=context.window)
        context.window_manager.cotan_running = True
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self._steps.close()
            self._end(context)
            self._outcome.notes.append("Stopped: unfinished maps are unchanged")
            say(self, self._outcome)
            return {"FINISHED"} if self._outcome.made else {"CANCELLED"}
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        try:
            share = next(self._steps)
        except StopIteration:
            self._end(context)
            return say(self, self._outcome)
        except BaseException:
            self._end(context)
            raise
        context.window_manager.cotan_progress = 100 * share
        context.workspace.status_text_set(f"Cotan is baking: {100 * share:.0f} %. Esc stops")
        _redraw(context)
        return {"RUNNING_MODAL"}

    def cancel(self, context):  # Blender is being closed
        self._steps.close()

    def _end(self, context):
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.cotan_running = False
        context.workspace.status_text_set(None)
        _redraw(context)


class CotanCage(bpy.types.Operator):
    """Show where rays start: make a cage from the active mesh, moved outwards by Extrusion, which can be edited"""

    bl_idname = "object.cotan_cage"
    bl_label = "Make Cage"
    bl_options = {"UNDO"}

    def execute(self, context):
        low, settings = context.view_layer.objects.active, context.scene.cotan
        try:
            _require_object_mode(context)
            if low is None or low.type != "MESH":
                raise Refused("No mesh is active: select the simple mesh")
            cage = cages.made_for(context, low, settings)
        except Refused as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        settings.cage, settings.cage_object = "MESH", cage
        self.report({"INFO"}, f"'{cage.name}' is the cage: edit it where it cuts the detail")
        return {"FINISHED"}


class CotanFrame(bpy.types.Operator):
    """Show the normal maps of the selected meshes, in viewport and renders, with the frame that they were baked for"""

    bl_idname = "object.cotan_frame"
    bl_label = "Use Cotan's Frame"
    bl_options = {"UNDO"}

    which: EnumProperty(
        name="Which",
        items=[
            ("COTAN", "Cotan's", "The frame of each map; for MikkTSpace orthonormal, which needs no tangents"),
            ("BLENDER", "Blender's", "Blender's own Normal Map node again"),
        ],
        default="COTAN",
    )

    def execute(self, context):
        try:
            _require_object_mode(context)
            things = [o for o in context.selected_objects if o.type == "MESH"]
            use = frames.use_cotans if self.which == "COTAN" else frames.use_blenders
            found, notes = use(context, things)
        except Refused as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for note in notes:
            self.report({"WARNING"}, note)
        names = ", ".join(f"'{material.name}'" for material in found)
        what = "the frame of the map" if self.which == "COTAN" else "its Normal Map node"
        self.report({"INFO"}, f"{names}: shown with {what}")
        return {"FINISHED"}


def _redraw(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type in {"PROPERTIES", "IMAGE_EDITOR", "VIEW_3D"}:
                area.tag_redraw()


class CotanCheck(bpy.types.Operator):
    """List problems of the active mesh and its normal maps, and select the faces that have them"""

    bl_idname = "object.cotan_check"
    bl_label = "Check Mesh"
    bl_options = {"UNDO"}

    kind: EnumProperty(name="Select", items=check.KINDS, default="ALL", description="Which faces")

    def execute(self, context):
        thing = context.view_layer.objects.active
        lines = context.window_manager.cotan_lines
        lines.clear()
        try:
            if context.mode != "OBJECT" and thing is not None and thing.type == "MESH":
                bpy.ops.object.mode_set(mode="OBJECT")
            said, asked = check.verdict(context, thing, context.scene.cotan.degrees)
        except (Refused, packages().Error) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for question in asked:
            self._add(lines, f"{len(question.faces)} faces {question.text}", question.kind)
        for text in said:
            self._add(lines, text, "")
        if not asked:
            self._add(lines, "No face has a problem", "")
        chosen = [q.faces for q in asked if self.kind in ("ALL", q.kind)]
        if chosen and thing.data.library is not None:
            self._add(lines, f"The mesh of '{thing.name}' comes from a library file: its faces cannot be selected", "")
        elif chosen:
            check.select(context, thing, np.concatenate(chosen))
        return {"FINISHED"}

    def _add(self, lines, text, kind):
        line = lines.add()
        line.text, line.kind = text, kind
        self.report({"WARNING"} if kind else {"INFO"}, text)


class CotanExport(bpy.types.Operator, ExportHelper):
    """Export the selected objects as glTF without tangents, with the frames that read their normal maps"""

    bl_idname = "export_scene.cotan_gltf"
    bl_label = "Export glTF without Tangents"
    filename_ext = ".glb"

    apply_modifiers: BoolProperty(
        name="Apply Modifiers", default=True, description="Shape keys then keep their current values"
    )

    def execute(self, context):
        settings = context.scene.cotan
        try:
            _require_object_mode(context)
            things = context.selected_objects
            if not any(t.type == "MESH" for t in things):
                raise Refused("No mesh is selected: select the objects to export")
            notes = gltf.warnings(context, things, self.apply_modifiers)
            made_for = gltf.frame_of_all(things)
            model = gltf.exported(context, things, self.apply_modifiers)
            frame, limits = settings.to_frame, {}
            if frame == "MEASURED" and made_for != "mikktspace":  # the maps have a frame: nothing is to be measured
                frame = "orthonormal" if made_for == "vertex" else made_for
            if frame == "MEASURED":
                limits["max_degrees"] = settings.max_degrees
            done = packages().convert(
                model, self.filepath, None if limits else frame, made_for, tangents="generated", **limits
            )
        except (Refused, packages().Error) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        for note in notes:
            self.report({"WARNING"}, note)
        chosen = dict.fromkeys(d["frame"] for d in done.report["decisions"] if d["reason"] != "no_map")
        maps = f"{done.maps_converted} maps converted, {done.maps_kept} kept"
        self.report({"INFO"}, f"Exported for the frame {', '.join(chosen) or frame}: {maps}")
        return {"FINISHED"}
