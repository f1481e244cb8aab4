"""Operators that run a program: in the background of a window, which shows progress and Esc stops, or until its end."""

import tempfile

import bpy

from .program import Failed, Run, Stopped

INTERVAL = 0.05  # Seconds between looks at a program.


def programs_folder(context):
    addon = context.preferences.addons.get(__package__)
    return bpy.path.abspath(addon.preferences.folder) if addon else ""


class Job:
    """Base of operators. `start` writes files and returns the name and the arguments of a program, `take` reads its
    results, given what it said; until then nothing in Blender has changed."""

    @classmethod
    def poll(cls, context):
        cls.poll_message_set("A mesh object in Object Mode is needed")
        return context.object is not None and context.object.type == "MESH" and context.mode == "OBJECT"

    def execute(self, context):
        return self._begin(context) or self._end(context)

    def invoke(self, context, event):
        ended = self._begin(context)
        if ended:
            return ended
        manager = context.window_manager
        self._timer = manager.event_timer_add(INTERVAL, window=context.window)
        manager.progress_begin(0, 100)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC" and event.value == "PRESS":
            self._run.stop()
        if event.type in {"MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE"}:
            return {"PASS_THROUGH"}  # The view may be turned; nothing else may change.
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        percent = int(100 * self._run.fraction)
        context.window_manager.progress_update(percent)
        context.workspace.status_text_set(f"{self.bl_label}: {self._run.stage}, {percent} % (Esc stops)")
        if not self._run.wait(0):
            return {"RUNNING_MODAL"}
        context.workspace.status_text_set(None)
        context.window_manager.progress_end()
        context.window_manager.event_timer_remove(self._timer)
        return self._end(context)

    def cancel(self, context):
        """Blender ends while the program runs."""
        self._run.stop()
        self._run.wait()
        self._folder.cleanup()

    def _begin(self, context):
        self._folder = tempfile.TemporaryDirectory(prefix="remesh-")
        self.path = self._folder.name
        try:
            program, arguments = self.start(context)
            self._run = Run(program, arguments, self.path, programs_folder(context))
        except (Failed, OSError) as error:
            return self._fail("ERROR", error)
        return None

    def _end(self, context):
        try:
            self.take(context, self._run.result())
        except (Failed, OSError) as error:
            return self._fail("ERROR", error)
        except Stopped as stopped:
            return self._fail("WARNING", stopped)
        self._folder.cleanup()
        return {"FINISHED"}

    def _fail(self, level, text):
        self._folder.cleanup()
        self.report({level}, f"{self.bl_label}: {text}")
        return {"CANCELLED"}
