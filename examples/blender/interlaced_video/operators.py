"""Render > Interlaced video: by plan, in steps that can be stopped, and without a window in one go."""
import time

import bpy

from . import program
from .program import Failed
from .settings import program_of
from .shot import Shot

KEYS = ("raster", "aperture", "shutter", "subframes", "error", "oversampling", "divide_samples", "alpha",
        "as_seen", "first", "last", "folder", "output", "codec")


class RENDER_OT_interlaced_video(bpy.types.Operator):
    """Render the subframes that interlaced video needs, and make the video"""

    bl_idname = "render.interlaced_video"
    bl_label = "Interlaced Video"

    convert: bpy.props.BoolProperty(name="Convert", default=True,
                                    description="Make the video when all subframes are there")

    def begin(self, context):
        """Finds out all that can be found out before anything is rendered."""
        self.shot = Shot(context.scene, context.scene.interlaced_video, program.find(program_of(context)))
        self.plan = self.shot.plan()
        self.shot.prepare()
        self.shot.write_job(self.plan)
        self.left = self.shot.wanted(self.plan)
        self.count, self.checked, self.begun = len(self.left), False, time.monotonic()

    def step(self):
        """The next subframe; False when it was stopped."""
        if not self.shot.render(self.left[0]):
            return False
        self.left.pop(0)
        if self.convert and not self.checked:
            self.shot.check(self.plan)  # there is an input now
            self.checked = True
        if not self.left and self.shot.refines():
            self.left = self.shot.wanted(self.plan)
            self.count += len(self.left)
        return True

    def progress(self):
        """Where it is, and how long what is known of takes: "subframe 3 of 200, 12 min left"."""
        done = self.count - len(self.left)
        left = (time.monotonic() - self.begun) / max(done, 1) * len(self.left)
        told = f"{left:.0f} s" if left < 90 else f"{left / 60:.0f} min" if left < 5400 else f"{left / 3600:.1f} h"
        return f"subframe {done} of {self.count}" + (f", {told} left" if done and self.left else "")

    def finish(self):
        if not self.convert:
            return f"{self.count} subframes rendered"
        return f"{self.shot.convert(self.plan)} written, from {self.shot.told(self.plan)}"

    def execute(self, context):
        """Without a window: all in one go."""
        try:
            self.begin(context)
            with self.shot.prepared(self.plan):
                while self.left:
                    if not self.step():
                        raise Failed("rendering was stopped; what was rendered is kept")
                    print(self.progress(), flush=True)
            self.report({"INFO"}, self.finish())
        except Failed as failed:
            self.report({"ERROR"}, str(failed))
            return {"CANCELLED"}
        return {"FINISHED"}

    # ---- With a window: a subframe a tick of the timer, until it is done or escape is pressed ----

    def invoke(self, context, _):
        try:
            self.begin(context)
        except Failed as failed:
            self.report({"ERROR"}, str(failed))
            return {"CANCELLED"}
        self.ready = self.shot.prepared(self.plan)
        self.ready.__enter__()
        manager = context.window_manager
        manager.progress_begin(0, max(self.count, 1))
        self.timer = manager.event_timer_add(0.01, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def end(self, context, kind, told):
        self.ready.__exit__(None, None, None)
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
        self.report({kind}, told)
        return {"FINISHED"} if kind == "INFO" else {"CANCELLED"}

    def modal(self, context, event):
        if event.type == "ESC":
            return self.end(context, "WARNING", f"stopped; {self.count - len(self.left)} of {self.count} subframes are "
                            "kept, and the next run goes on from there")
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        try:
            if self.left and not self.step():
                return self.end(context, "WARNING", "rendering was stopped; what was rendered is kept")
            context.window_manager.progress_update(self.count - len(self.left))
            context.workspace.status_text_set(f"Interlaced video: {self.progress()}; Escape stops")
            return {"RUNNING_MODAL"} if self.left else self.end(context, "INFO", self.finish())
        except Failed as failed:
            return self.end(context, "ERROR", str(failed))


def run(**settings):
    """For scripts and farms: run(raster="625i", output="shot.mov", first=0, last=24). Settings that are not given
    are the scene's. Raises what the operator says if it does not succeed."""
    convert = settings.pop("convert", True)
    unknown = set(settings) - set(KEYS)
    if unknown:
        raise TypeError(f"there is no {', '.join(sorted(unknown))}; settings are {', '.join(KEYS)}, convert")
    for name, value in settings.items():
        setattr(bpy.context.scene.interlaced_video, name, value)
    if bpy.ops.render.interlaced_video("EXEC_DEFAULT", convert=convert) != {"FINISHED"}:
        raise SystemExit(1)
