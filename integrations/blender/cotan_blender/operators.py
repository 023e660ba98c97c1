"""What the buttons do."""

import bpy
from bpy.props import EnumProperty

from . import bake, pairs
from .refused import Refused


def say(operator, outcome):
    """Everything in Blender's report. What was made counts: only where nothing was is it an error."""
    for note in outcome.notes:
        operator.report({"WARNING"}, note)
    for failure in outcome.failures:
        operator.report({"WARNING"} if outcome.made else {"ERROR"}, failure)
    if outcome.made:
        first = outcome.made[0]
        what = f"'{first.name}'" if len(outcome.made) == 1 else f"{len(outcome.made)} maps"
        operator.report({"INFO"}, f"Baked {what} for the frame {first['cotan_frame']}")
    return {"FINISHED"} if outcome.made else {"CANCELLED"}


class CotanBake(bpy.types.Operator):
    """Bake the normals of detailed meshes into a map for a simple one"""

    bl_idname = "object.cotan_bake"
    bl_label = "Bake Normal Map"
    bl_options = {"UNDO"}

    which: EnumProperty(
        name="Which",
        items=[
            ("ACTIVE", "Selected to Active", "The selected objects onto the active mesh"),
            ("NAMES", "Pairs by Name", "Every selected mesh x_low, or each there is, with what is named x_high or x_hi"),
        ],
        default="ACTIVE",
    )

    def _begin(self, context):
        if context.mode != "OBJECT":
            raise Refused("Go back to Object Mode first")
        found = pairs.by_name(context) if self.which == "NAMES" else pairs.by_selection(context)
        self._outcome = bake.Outcome()
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
        """The same while the window goes on being drawn. Esc stops; other keys wait until it is done."""
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
            self._outcome.notes.append("Stopped: what was not finished is as it was")
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
        context.workspace.status_text_set(f"Cotan bakes: {100 * share:.0f} %. Esc stops")
        _redraw(context)
        return {"RUNNING_MODAL"}

    def cancel(self, context):  # Blender is being closed
        self._steps.close()

    def _end(self, context):
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.cotan_running = False
        context.workspace.status_text_set(None)
        _redraw(context)


def _redraw(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type in {"PROPERTIES", "IMAGE_EDITOR", "VIEW_3D"}:
                area.tag_redraw()
