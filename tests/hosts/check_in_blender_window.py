"""Runs in Blender with a window: the operator shows progress, and Esc stops it.

Blender needs --enable-event-simulate. Behind --: the zip."""

import os
import sys
import traceback

import bpy

sys.path.insert(0, os.path.dirname(__file__))
import check_in_blender

fractions, runs = [], []


def view():
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    return {"window": window, "area": area, "region": next(r for r in area.regions if r.type == "WINDOW")}


def remesh(**fields):
    with bpy.context.temp_override(**view()):
        assert bpy.ops.object.remesh_geodesic("INVOKE_DEFAULT", True, **fields) == {"RUNNING_MODAL"}


def spy_on_progress():
    from remesh_blender import jobs
    inner = jobs.Job.modal

    def modal(self, context, event):
        fractions.append(self._run.fraction)
        runs.append(self._run)
        return inner(self, context, event)
    jobs.Job.modal = modal


def steps():
    """A generator: yields while Blender should go on with its own events."""
    for item in list(bpy.data.objects):
        bpy.data.objects.remove(item)
    item = check_in_blender.make_torus()
    for _ in range(5):
        yield
    spy_on_progress()
    mesh, number = item.data, len(item.data.vertices)
    remesh(size="DISTANCE", distance=0.00005)
    while not fractions or fractions[-1] < 0.05:
        yield
    assert item.data == mesh
    bpy.context.window_manager.windows[0].event_simulate(type="ESC", value="PRESS", x=500, y=500)
    count = 0
    while count < len(fractions):
        count = len(fractions)
        for _ in range(10):
            yield
    assert item.data == mesh and len(item.modifiers) == 1, "the stopped run changed the object"
    assert runs[-1]._process.poll() == 143, "the run was not stopped"
    print("stopped at", fractions[-1])

    fractions.clear()
    with bpy.context.temp_override(**view()):
        bpy.ops.ed.undo_push(message="before")
    remesh(vertices=2000)
    while item.data == mesh:
        yield
    assert len(item.data.vertices) == 2000 and not item.modifiers
    assert fractions == sorted(fractions) and fractions[-1] > 0.5, fractions
    with bpy.context.temp_override(**view()):
        bpy.ops.ed.undo()
    item = bpy.data.objects["torus"]
    assert len(item.data.vertices) == number and item.modifiers.keys() == ["moved"], "one undo was not enough"
    print("progress was seen", len(fractions), "times")


def finish_by(generator):
    """Installs the add-on, goes through the steps, and ends Blender."""
    def tick():
        try:
            next(generator)
            return 0.1
        except StopIteration:
            code = 0
        except BaseException:
            traceback.print_exc()
            code = 1
        sys.stdout.flush()
        os._exit(code)

    check_in_blender.install()
    bpy.app.timers.register(tick, first_interval=1)


if __name__ == "__main__":
    finish_by(steps())
