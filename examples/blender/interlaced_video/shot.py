"""A shot: what is to be rendered of a scene, and the video that becomes of it."""
import json
import math
import os
import re
from fractions import Fraction

import bpy

from . import program, scene
from .program import Failed
from .stamp_exr import stamp

# Broadcast rates as people write them.
RATES = {"23.976": Fraction(24000, 1001), "23.98": Fraction(24000, 1001), "29.97": Fraction(30000, 1001),
         "59.94": Fraction(60000, 1001)}


def exact(text):
    """A rate of broadcast as a fraction: 29.97 is 30000/1001."""
    return RATES.get(text) or Fraction(text)


def frame_rate(raster):
    """Frames a second of a raster, by its name: 525i, 1080i50 (fields), 1080psf25, 720x576@25i."""
    custom = re.search(r"@([0-9./]+)(i|psf|p)", raster)
    named = re.match(r"\d+(i|psf|p)([0-9.]+)", raster)
    if custom:
        return exact(custom.group(1))
    if raster.startswith(("525", "625")):
        return Fraction(30000, 1001) if raster.startswith("525") else Fraction(25)
    if named:
        return exact(named.group(2)) / (2 if named.group(1) == "i" else 1)
    raise Failed(f"no rate is known of the raster {raster}; write it as WIDTHxLINES@RATEi")


class Shot:
    """A scene's frames as subframes in a folder, each with its number, and a job that makes video of them."""

    def __init__(self, of, settings, weft):
        self.scene, self.settings, self.weft = of, settings, weft
        self.rate = frame_rate(settings.raster)
        self.subframe_rate = 2 * self.rate * settings.subframes
        self.folder, self.output = (self.placed(path) for path in (settings.folder, settings.output))

    @staticmethod
    def placed(path):
        """Where a path leads; // is the folder of the .blend."""
        if path.startswith("//") and not bpy.data.filepath:
            raise Failed(f"{path} lies beside the .blend, which is not saved yet; save it, or give another place")
        return os.path.abspath(bpy.path.abspath(path))

    def told(self, plan):
        """How many subframes there are, and how much of them."""
        there = [self.path(s) for s in plan["subframes"] if os.path.exists(self.path(s))]
        return f"{len(there)} subframes" + (f" of {len(plan['subframes'])}, most of them in part" if self.refines() else "")

    def seconds(self):
        """How long the scene's range of frames lasts."""
        fps = Fraction(self.scene.render.fps) / Fraction(self.scene.render.fps_base).limit_denominator(1001)
        return (self.scene.frame_end - self.scene.frame_start + 1) / fps

    def frames(self):
        """The first and the last frame of video: all of the range, or the part that is asked for."""
        last = math.floor(self.seconds() * self.rate) - 1
        if last < 0:
            raise Failed(f"the scene's range lasts {float(self.seconds()):.3f} s, less than one frame of "
                         f"{self.settings.raster}; set its end in the output properties")
        first = max(self.settings.first, 0)
        end = last if self.settings.last < 0 else self.settings.last
        if first > end or end > last:
            raise Failed(f"frames {first} to {end} of video are asked for, and the scene's range has 0 to {last}")
        return first, end

    def refines(self):
        return self.settings.error > 0

    def asked(self, *more):
        """What `weft plan` answers."""
        first, last = self.frames()
        s = self.settings
        return program.asked(self.weft, "plan", "--raster", s.raster, "--aperture", s.aperture, "--temporal-width",
                             s.shutter, "--subframe-rate", self.subframe_rate, "--frames", f"{first}-{last}",
                             "--samples-a-pixel", max(1, self.finished_samples()), "--format", "json", *more)

    def plan(self):
        """What weft needs: numbers, times, size."""
        found, over = self.asked(), self.settings.oversampling
        if over > 1:
            found = self.asked("--size", "x".join(str(over * n) for n in found["size"]))
        if not found["subframes"]:
            raise Failed("the plan has no subframes")
        return found

    def wanted(self, plan):
        """What is to be rendered now: all of the plan that is not there, or what the error still wants."""
        if not self.refines():
            return self.missing(plan)
        size = "x".join(map(str, plan["size"]))
        return self.asked("--size", size, "--refine", self.folder, "--error", f"{self.settings.error:.6g}")["subframes"]

    def place(self, subframe):
        """The frame of the scene, and the part of one, of a subframe's time."""
        fps = Fraction(self.scene.render.fps) / Fraction(self.scene.render.fps_base).limit_denominator(1001)
        at = self.scene.frame_start + Fraction(subframe["time"]) * fps
        return math.floor(at), float(at - math.floor(at))

    def path(self, subframe):
        return os.path.join(self.folder, f"subframe.{subframe['number']:07d}.exr")

    def missing(self, plan):
        """Subframes that are not there yet: what a farm or an earlier run left is kept."""
        return [s for s in plan["subframes"] if not os.path.exists(self.path(s))]

    def prepare(self):
        """Makes the folder, and finds out before anything is rendered whether files can be written there."""
        try:
            os.makedirs(self.folder, exist_ok=True)
            probe = os.path.join(self.folder, ".written")
            with open(probe, "w", encoding="utf-8"):
                pass
            os.remove(probe)
        except OSError as error:
            raise Failed(f"{self.folder}: {error.strerror}; choose another folder for subframes") from None

    def render(self, subframe):
        """One subframe. It appears under its name when it is whole."""
        frame, part = self.place(subframe)
        path = self.path(subframe)
        self.scene.frame_set(frame, subframe=part)
        self.scene.render.filepath = path + ".part"
        scene.show_only(self.scene, self.plan_size, subframe.get("region"))
        try:
            done = bpy.ops.render.render(write_still=True, scene=self.scene.name)
        except RuntimeError as error:
            raise Failed(f"subframe {subframe['number']}: {str(error).strip()}") from None
        finally:
            whole = os.path.exists(path + ".part")
        if done != {"FINISHED"} or not whole:
            if whole:
                os.remove(path + ".part")
            return False
        if not os.path.getsize(path + ".part"):
            os.remove(path + ".part")
            raise Failed(f"{path}: nothing was written; is the disk full?")
        self.finish(path, subframe)
        return True

    def finish(self, path, subframe):
        """Says in a file what part of it exists, and gives it its name."""
        try:
            if "region" in subframe:
                stamp(path + ".part", subframe["time"], subframe["region"])
            os.replace(path + ".part", path)
        except (OSError, ValueError) as error:
            for name in (path + ".part", path + ".part.part"):
                if os.path.exists(name):
                    os.remove(name)
            raise Failed(f"{path}: {getattr(error, 'strerror', None) or error}; is the disk full?") from None

    def view(self):
        """Options that give light the look that Blender shows. Its plain views need none: weft has its own."""
        view = self.scene.view_settings
        options = {"exposure": f"{view.exposure:.6g}"} if view.exposure else {}
        if view.view_transform in ("Standard", "Raw"):
            return options
        folder = bpy.utils.system_resource("DATAFILES", path="colormanagement") or ""
        options.update({"ocio": os.environ.get("OCIO") or os.path.join(folder, "config.ocio"), "from": "scene_linear",
                        "display": self.scene.display_settings.display_device, "view": view.view_transform})
        if view.look not in ("", "None"):
            options["look"] = view.look
        return options

    def write_job(self, plan):
        """The job, beside the frames: `weft convert --job FOLDER/job.json` makes the video again."""
        s, (first, last) = self.settings, self.frames()
        job = {"command": "convert", "inputs": [self.folder], "output": self.output, "raster": s.raster,
               "aperture": s.aperture, "temporal-width": s.shutter, "subframe-rate": str(self.subframe_rate),
               "frames": f"0-{(last + 1) * 2 * s.subframes - 1}", "output-frames": f"{first}-{last}",
               "input-par": "{}:{}".format(*plan["pixel_aspect"]), "overwrite": True}
        if s.alpha:
            job["alpha-out"] = True
        if s.codec:
            job["codec"] = s.codec
        if s.as_seen:
            job.update(self.view())
        path = os.path.join(self.folder, "job.json")
        try:
            with open(path + ".part", "w", encoding="utf-8") as file:
                json.dump(job, file, indent=2)
            os.replace(path + ".part", path)
        except OSError as error:
            raise Failed(f"{path}: {error.strerror}") from None
        return path

    def check(self, plan):
        """Asks, once there is a subframe, whether the job makes sense, before hours are spent for it."""
        program.make_sense(self.weft, "convert", "--job", self.write_job(plan), "--dry-run", "-q")

    def convert(self, plan):
        """The video, once all subframes are there."""
        left = len(self.wanted(plan))
        if left:
            raise Failed(f"{left} subframes are not there yet; render them first")
        program.run(self.weft, "convert", "--job", self.write_job(plan), "-q")
        return self.output

    def finished_samples(self):
        """What the scene asks for, of a finished frame."""
        cycles = getattr(self.scene, "cycles", None)
        return cycles.samples if self.scene.render.engine == "CYCLES" and cycles else self.scene.eevee.taa_render_samples

    def samples(self, plan):
        """Samples a pixel of each subframe: the scene's, divided so that all that a field sees has the noise of a
        finished frame, and costs what it does. Where it is refined, what stands still is seen by one subframe of a
        field alone, and only pixels share."""
        if not self.settings.divide_samples:
            return 0
        if self.refines():
            return max(1, round(self.finished_samples() / self.settings.oversampling ** 2))
        return plan["samples_a_pixel"]

    def prepared(self, plan):
        """The scene, ready. Noise that moves would be taken for motion where it is refined."""
        self.plan_size = plan["size"]
        return scene.prepared(self.scene, plan, self.settings.alpha, self.samples(plan), not self.refines())
