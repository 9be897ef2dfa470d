"""The Python package against the header, closed forms, NumPy's own arithmetic and the program.
Run by test_python.sh, in a directory of its own."""
import ctypes
import gc
import os
import re
import signal
import subprocess
import threading
import time
import unittest
import warnings
from fractions import Fraction
from pathlib import Path

import numpy as np

import weft
from weft import _library, errors

SOURCE = Path(os.environ["WEFT_SOURCE"])
SMALL = "36x24@30i,tff"


def program(*arguments):
    """Runs weft itself, which has its own sanitizers."""
    plain = {k: v for k, v in os.environ.items() if k != "LD_PRELOAD"}
    return subprocess.run([os.environ["WEFT"], *arguments], env=plain, check=False,
                          capture_output=True, text=True)


class Doors(unittest.TestCase):
    """What libweft would get as something else is refused before it does."""

    def test_nul_bytes(self):
        for make in (lambda: weft.Job("a\0b"), lambda: weft.Job(output="b\0c"), lambda: weft.raster("525i\0zz"),
                     lambda: weft.Job(raster="525i\0zz"), lambda: weft.Job(command="render\0"), lambda: weft.Job(set={"a\0": 1}),
                     lambda: weft.Job(**{"threads\0": 3}), lambda: weft.aperture_response("box\0"),
                     lambda: weft.Job().load("a\0b"), lambda: weft.Job(raster="525i").plan("csv\0"),
                     lambda: weft.filters("box\0")):
            with self.assertRaisesRegex(weft.UsageError, "NUL"):
                make()

    def test_integers_beyond_64_bits(self):
        with weft.Job(raster=SMALL, aperture="box") as job:
            for frames in (2**63, 2**64 + 15, -2**63 - 1):
                with self.assertRaisesRegex(weft.UsageError, "64 bits"):
                    weft.Fields(job, frames=frames)
            with weft.Fields(job, frames=4) as fields:
                one = np.ones(1)
                for bad in (lambda n: fields.push(n, one, one, 0, np.ones((1, 3))), fields.until,
                            lambda n: fields.push_tile(n, np.ones((1, 1, 3)))):
                    for number in (2**63, 2**64, -2**64):
                        with self.assertRaisesRegex(weft.UsageError, "64 bits"):
                            bad(number)


class Header(unittest.TestCase):
    """weft.h, as a compiler sees it, is what the package takes it for."""

    @classmethod
    def setUpClass(cls):
        text = (SOURCE / "convert/weft.h").read_text()
        cls.version = re.search(r'#define WEFT_VERSION "(.*)"', text).group(1)
        cls.header = re.sub(r"/\*.*?\*/", "", text, flags=re.S)

    def members(self, name):
        """The names of a structure's members, in order."""
        body = re.search(r"typedef struct %s \{(.*?)\} %s;" % (name, name), self.header, re.S).group(1)
        return [re.search(r"(\w+)(\[\d+\])?$", part.strip()).group(1)
                for line in body.split(";") if line.strip() for part in line.split(",")]

    def test_version(self):
        self.assertEqual(weft.__version__, self.version)

    def test_functions(self):
        declared = re.findall(r"^WEFT_API [^;]*?\b(weft_\w+)\(([^;]*)\);", self.header, re.M | re.S)
        self.assertGreater(len(declared), 20)
        self.assertEqual(sorted(name for name, _ in declared), sorted(_library.FUNCTIONS))
        for name, arguments in declared:
            count = 0 if arguments.strip() == "void" else arguments.count(",") + 1
            self.assertEqual(len(_library.FUNCTIONS[name]) - 1, count, name)

    def test_structures(self):
        opaque = set(re.findall(r"typedef struct (\w+) \1;", self.header))
        described = set(re.findall(r"typedef struct (\w+) \{", self.header))
        self.assertEqual(opaque, {"weft_job", "weft_fields", "weft_video"})
        self.assertEqual(described, set(_library.STRUCTURES))
        lines, expected = [], []
        for name, structure in _library.STRUCTURES.items():
            fields = [field for field, _ in structure._fields_]
            self.assertEqual(fields, self.members(name), name)
            lines.append(f'printf("{name} %zu\\n", sizeof({name}));')
            expected.append(f"{name} {ctypes.sizeof(structure)}")
            for field in fields:
                lines.append(f'printf("{name}.{field} %zu %zu\\n", offsetof({name}, {field}), '
                             f"sizeof((({name} *)0)->{field}));")
                where = getattr(structure, field)
                expected.append(f"{name}.{field} {where.offset} {where.size}")
        Path("layout.c").write_text("#include <stdio.h>\n#include <weft.h>\nint main(void)\n{\n"
                                    + "\n".join(lines) + "\nreturn 0;\n}\n")
        plain = {k: v for k, v in os.environ.items() if k != "LD_PRELOAD"}
        subprocess.run([os.environ.get("CC", "cc"), "-std=c17", "-I", str(SOURCE / "convert"), "layout.c",
                        "-o", "layout"], env=plain, check=True)
        said = subprocess.run(["./layout"], env=plain, check=True, capture_output=True, text=True).stdout
        self.assertEqual(said.splitlines(), expected)

    def test_status(self):
        body = re.search(r"typedef enum weft_status \{(.*?)\}", self.header, re.S).group(1)
        names = [name.split("=")[0].strip() for name in body.split(",")]
        for value, name in enumerate(names):
            self.assertEqual(getattr(errors, name.replace("WEFT_", "")), value)
        self.assertEqual(len(names), 6)


def f(v):
    """The quadratic of filters/README.md."""
    v = np.abs(v)
    return np.where(v < 1, 0.5 - v * v / 4, np.where(v < 2, v * v / 4 - v + 1, 0))


def mitchell(v, b, c):
    """The family of Mitchell and Netravali."""
    v = np.abs(v)
    near = (12 - 9 * b - 6 * c) * v**3 + (-18 + 12 * b + 6 * c) * v**2 + 6 - 2 * b
    far = (-b - 6 * c) * v**3 + (6 * b + 30 * c) * v**2 + (-12 * b - 48 * c) * v + 8 * b + 24 * c
    return np.where(v < 1, near, np.where(v < 2, far, 0)) / 6


class Apertures(unittest.TestCase):
    """Responses against integrals that NumPy sums, at frequencies of no meaning."""

    FX, FY, FT = np.array([0, 0.13, 0.37]), np.array([0, 0.21, 0.5]), np.array([0, 0.3, 1.1])

    def test_names(self):
        names = weft.apertures()
        self.assertIn("shaped", names)
        self.assertEqual(len(set(names)), len(names))

    def vertical(self, h):
        """The integral over v of h(v) cos(2 pi fy v), for each of FY."""
        v = (np.arange(4 * 4096) + 0.5) / 4096 - 2
        wave = np.cos(2 * np.pi * self.FY[:, None] * v)
        return (h(v) * wave).sum(axis=1) / h(v).sum()

    def test_separable(self):
        for name, h in (("line", lambda v: np.abs(v) < 0.5), ("box", lambda v: np.abs(v) < 1), ("notch", f),
                        ("mitchell:0.25,0.5", lambda v: mitchell(v, 0.25, 0.5))):
            for tau in (0.0, 0.5, 1.7):
                expected = (np.sinc(self.FX)[:, None, None] * self.vertical(h)[None, :, None]
                            * np.sinc(tau * self.FT)[None, None, :])
                got = weft.aperture_response(name, self.FX[:, None, None], self.FY[None, :, None],
                                             self.FT[None, None, :], tau=tau)
                self.assertEqual(got.shape, (3, 3, 3))
                np.testing.assert_allclose(got, expected, atol=1e-6, err_msg=name)

    def test_shaped(self):
        # The region |u| < 2 f(v), summed over both.
        v = (np.arange(4 * 1024) + 0.5) / 1024 - 2
        wide = 4 * f(v)
        for fx in self.FX:
            across = wide * np.sinc(wide * fx)
            expected = (across * np.cos(2 * np.pi * self.FY[:, None] * v)).sum(axis=1) / wide.sum()
            np.testing.assert_allclose(weft.aperture_response("shaped", fx, self.FY), expected, atol=1e-5)

    def test_own_width(self):
        self.assertAlmostEqual(weft.aperture_response("rotated", ft=0.2), np.sinc(0.4), 12)
        self.assertIsInstance(weft.aperture_response("rotated"), float)

    def test_refused(self):
        with self.assertRaisesRegex(weft.UsageError, "shaped"):
            weft.aperture_response("sharp")
        with self.assertRaisesRegex(weft.UsageError, "finite"):
            weft.aperture_response("box", fy=float("nan"))
        with self.assertRaises(ValueError):
            weft.aperture_response("box", tau=-1)


class Tables(unittest.TestCase):
    def test_rasters(self):
        named = {r.name: r for r in weft.rasters()}
        ntsc = weft.raster("525i")
        self.assertEqual(ntsc, named["525i"])
        self.assertEqual((ntsc.width_px, ntsc.lines, ntsc.rate), (720, 486, Fraction(30000, 1001)))
        self.assertTrue(ntsc.interlaced and not ntsc.top_first)
        self.assertEqual((ntsc.line1, ntsc.line2, ntsc.total_lines), (21, 283, 525))
        self.assertEqual(weft.raster("1080p50").fields_per_frame, 1)
        own = weft.raster(SMALL)
        self.assertEqual((own.width_px, own.lines, own.top_first, own.fields_per_frame), (36, 24, True, 2))
        with self.assertRaisesRegex(weft.UsageError, "did you mean 525i"):
            weft.raster("526i")

    def test_options(self):
        told = {o.name: o for o in weft.options()}
        self.assertEqual(told["raster"].preset, "525i")
        self.assertIsNone(told["overwrite"].takes)
        said = program("convert", "--help").stdout
        for name in ("raster", "aperture", "chunk", "on-missing", "dither"):
            self.assertIn(name, told)
            self.assertIn("--" + name, said)
        self.assertTrue(all(o.help and o.group for o in told.values()))


class Jobs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = SOURCE / "examples/scenes/carousel.lua"
        weft.Job(cls.scene, command="trace", output="in.####.exr", raster=SMALL, frames="0-3",
                 oversample="2x2x4", samples=1).run()

    def job(self, *inputs, **more):
        options = {"raster": SMALL, "overwrite": True, **more}
        return weft.Job(*(inputs or ["in.####.exr"]), **options)

    def test_bytes_of_the_program(self):
        for options in ({"aperture": "box", "temporal_width": Fraction(1, 3)},
                        {"temporal_width": 1e-05, "background": 0.30000000000000004},
                        {"bits": 8, "chroma": "121", "from_": "acescg"},
                        {"background": (0.1, 0.2, 0.3), "fit": "pad", "input_par": "2:1", "skip": False}):
            report = self.job(output="py.y4m", **options).run()
            self.assertEqual((report["frames"], report["command"]), (4, "convert"))
            line = ["convert", "in.####.exr", "--raster", SMALL, "-o", "c.y4m", "--overwrite", "-q"]
            for name, value in options.items():
                text = {False: "off", 1e-05: "0.00001"}.get(value) or re.sub(r"[() ]", "", str(value))
                line += ["--" + name.rstrip("_").replace("_", "-"), text]
            done = program(*line)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(Path("py.y4m").read_bytes(), Path("c.y4m").read_bytes(), options)

    def test_load(self):
        Path("job.json").write_text('{"inputs": ["in.####.exr"], "output": "loaded.y4m", "overwrite": true,\n'
                                    f'"raster": "{SMALL}", "bits": 8}}')
        job = weft.Job()
        job.load("job.json")
        self.assertEqual((job.raster.lines, job.output), (24, "loaded.y4m"))
        job.run()
        self.job(output="unloaded.y4m", bits=8).run()
        self.assertEqual(Path("loaded.y4m").read_bytes(), Path("unloaded.y4m").read_bytes())
        Path("bad.json").write_text('{"rastr": "525i"}')
        with self.assertRaisesRegex(weft.UsageError, "bad.json"):
            weft.Job().load("bad.json")

    def test_render_with_params(self):
        scene = Path("scene.lua")
        scene.write_text("camera{eye={0, 2, 6}, look_at={0, 1, 0}}\nlight{point={4, 8, 5}}\n"
                         "add(sphere{center={0, 1, 0}, radius=param.r}:material{color={1, 0, param.b}})\n"
                         "duration(1)\n")
        self.job(scene, command="render", output="a.y4m", frames=0, samples=4, set={"r": 0.7, "b": 0.5}).run()
        program("render", "scene.lua", "--raster", SMALL, "-o", "b.y4m", "--frames", "0", "--samples", "4",
                "--set", "r=0.7", "--set", "b=0.5")
        self.assertEqual(Path("a.y4m").read_bytes(), Path("b.y4m").read_bytes())

    def test_progress(self):
        seen = []
        self.job(output="p.y4m", progress=seen.append).run()
        done = [p.frames_done for p in seen]
        self.assertEqual(done, sorted(done))
        self.assertEqual((seen[-1].frames_done, seen[-1].frames_total), (4, 4))
        self.assertTrue(all(p.stage and p.seconds >= 0 and 0 <= p.frame_part <= 1 for p in seen))

    def test_warnings(self):
        said = []
        for k in range(8):
            os.link(f"in.{k:04d}.exr", f"gap.{k + (k > 0):04d}.exr")  # there is no 1
        job = self.job("gap.####.exr", output="w.y4m", subframe_rate=240, on_missing="hold",
                       warning=said.append)
        report = job.run()
        self.assertTrue(job.degraded and report["degraded"])
        self.assertEqual(report["input"]["missing"], [1])
        self.assertTrue(any("missing" in text for text in said), said)
        with self.assertWarnsRegex(weft.WeftWarning, "missing"):
            self.job("gap.####.exr", output="w.y4m", subframe_rate=240, on_missing="hold").run()
        with self.assertRaisesRegex(weft.Failed, "subframe 1 is missing"):
            self.job("gap.####.exr", output="w.y4m", subframe_rate=240).run()
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(weft.WeftWarning):
                self.job("gap.####.exr", output="w.y4m", subframe_rate=240, on_missing="hold").run()

    def test_errors(self):
        with self.assertRaisesRegex(weft.UsageError, "did you mean"):
            weft.Job(rastr="525i")
        with self.assertRaisesRegex(weft.UsageError, "8|10|12|16"):
            weft.Job(bits=9)
        job = self.job("absent.####.exr", output="x.y4m", subframe_rate=240)
        with self.assertRaisesRegex(weft.Failed, "absent") as caught:
            job.run()
        self.assertEqual(caught.exception.status, 1)
        self.assertIn("absent", job.report["error"])
        self.assertIsInstance(caught.exception, weft.WeftError)
        Path("there.y4m").write_text("mine")
        with self.assertRaisesRegex(weft.Failed, "exists"):
            weft.Job("in.####.exr", output="there.y4m", raster=SMALL, overwrite=False).run()
        self.assertEqual(Path("there.y4m").read_text(), "mine")
        self.assertEqual(weft.Job().report, {})

    def test_callback_that_raises(self):
        class Mine(Exception):
            pass

        def angry(progress):
            raise Mine(progress.frames_total)

        with self.assertRaises(Mine) as caught:
            self.job(output="angry.y4m", progress=angry).run()
        self.assertEqual(caught.exception.args, (4,))
        self.assertFalse(Path("angry.y4m").exists())

    def test_cancel(self):
        job = self.job(output="cancel.y4m", progress=lambda p: job.cancel())
        with self.assertRaises(weft.Canceled):
            job.run()
        self.assertFalse(Path("cancel.y4m").exists())

    def test_changes_while_running(self):
        job = self.job(output="busy.y4m", progress=lambda p: job.set("bits", 8))
        with self.assertRaisesRegex(weft.UsageError, "running"):
            job.run()

    def long(self, **more):
        """A run that takes far longer than anybody waits."""
        return self.job(self.scene, command="render", raster="525i", output="long.y4m", **more)

    def test_interrupt(self):
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        start = time.monotonic()
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            self.long().run()
        self.assertLess(time.monotonic() - start, 10)
        self.assertFalse(Path("long.y4m").exists())
        self.assertEqual(signal.set_wakeup_fd(-1), -1)

    def test_interrupt_of_another_kind(self):
        # Whoever has a handler of their own decides: the run goes on.
        came = []
        before = signal.signal(signal.SIGINT, lambda *_: came.append(True))
        try:
            self.job(output="on.y4m", progress=lambda p: os.kill(os.getpid(), signal.SIGINT)).run()
        finally:
            signal.signal(signal.SIGINT, before)
        self.assertTrue(came and Path("on.y4m").exists())

    def test_cancel_from_another_thread(self):
        job = self.long()
        threading.Timer(0.3, job.cancel).start()
        with self.assertRaises(weft.Canceled):
            job.run()

    def test_threads(self):
        failures = []

        def run(k):
            try:
                self.job(output=f"thread{k}.y4m", threads=1).run()
            except weft.WeftError as error:
                failures.append(error)

        threads = [threading.Thread(target=run, args=(k,)) for k in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertFalse(failures)
        self.assertEqual(len({Path(f"thread{k}.y4m").read_bytes() for k in range(3)}), 1)

    def test_close(self):
        with self.job(output="closed.y4m") as job:
            job.run()
            self.assertEqual((job.output, job.raster.lines), ("closed.y4m", 24))
        job.close()
        for use in (job.run, lambda: job.set("bits", 8), lambda: job.report):
            with self.assertRaisesRegex(weft.UsageError, "closed"):
                use()


class Push(unittest.TestCase):
    """Fields against NumPy's arithmetic."""

    WIDTH, LINES = 36, 24

    def job(self, **more):
        return weft.Job(**{"raster": SMALL, "aperture": "box", "temporal_width": Fraction(1, 2), **more})

    def grid(self, each=2):
        """The places of each x each samples a pixel and line, [y][x], flat."""
        x = (np.arange(self.WIDTH * each) + 0.5) / each
        y = (np.arange(self.LINES * each) + 0.5) / each
        return (a.ravel() for a in np.broadcast_arrays(x[None, :], y[:, None]))

    def test_constant(self):
        color = np.array([0.25, 0.5, 4.0])
        for aperture in ("line", "box", "notch", "shaped", "crisp"):
            with self.job(aperture=aperture) as job, weft.Fields(job, 2) as fields:
                found = []
                for n in range(4):
                    fields.push_tile(n, np.broadcast_to(color, (96, 144, 3)), t=0.2)
                    found += fields.until(n + 1)
                self.assertEqual(fields.finish(), [])
            self.assertEqual([(g.index, g.first_line, g.line_step) for g in found],
                             [(0, 0, 2), (1, 1, 2), (2, 0, 2), (3, 1, 2)])
            for field in found:
                self.assertEqual((field.rgb.shape, field.rgb.dtype), ((12, 36, 3), np.float32))
                np.testing.assert_allclose(field.rgb, np.broadcast_to(color, (12, 36, 3)), rtol=1e-6)

    def boxed(self, picture, parity):
        """What the box makes of 2 x 2 samples: means of two columns and four rows, fewer at the edges."""
        lines = []
        for j in range(parity, self.LINES, 2):
            rows = picture[max(2 * j - 1, 0):2 * j + 3]
            lines.append(rows.mean(axis=0).reshape(self.WIDTH, 2, 3).mean(axis=1))
        return np.array(lines)

    def test_box(self):
        rng = np.random.default_rng(1)
        pictures = rng.random((2, 48, 72, 3))
        x, y = self.grid()
        with self.job() as job, weft.Fields(job, 1) as fields:
            fields.push_tile(0, pictures[0], rect=(0, 0, 36, 24), t=0.1)
            order = rng.permutation(len(x))  # samples come in any order
            fields.push(1, x[order], y[order], np.full(len(x), 0.1), pictures[1].reshape(-1, 3)[order])
            first, second = fields.finish()
        np.testing.assert_allclose(first.rgb, self.boxed(pictures[0], 0), atol=2e-6)
        np.testing.assert_allclose(second.rgb, self.boxed(pictures[1], 1), atol=2e-6)

    def test_alpha(self):
        """Alpha is seen through what color is; without alpha_out color lies over the background."""
        rng = np.random.default_rng(2)
        alpha = rng.random(48 * 72)
        light = rng.random((48 * 72, 3)) * alpha[:, None]
        behind = np.array([0.5, 0.25, 2])
        x, y = self.grid()
        def made(**more):
            with self.job(**more) as job, weft.Fields(job, 1) as fields:
                fields.push(0, x, y, 0.1, light, alpha=alpha)
                fields.push_tile(1, light.reshape(48, 72, 3), t=0.1, alpha=alpha.reshape(48, 72))
                return fields.finish()
        plain, keyed, over = made(), made(alpha_out=True), made(background="0.5,0.25,2")
        repeated = np.repeat(alpha, 3).reshape(48, 72, 3)
        for n in range(2):
            self.assertIsNone(plain[n].alpha)
            self.assertEqual((keyed[n].alpha.shape, keyed[n].alpha.dtype), ((12, 36), np.float32))
            np.testing.assert_array_equal(keyed[n].rgb, plain[n].rgb)
            np.testing.assert_allclose(keyed[n].alpha, self.boxed(repeated, n)[:, :, 0], atol=2e-6)
            np.testing.assert_allclose(over[n].rgb, keyed[n].rgb + (1 - keyed[n].alpha[:, :, None]) * behind, atol=1e-6)
        with self.job() as job, weft.Fields(job, 1) as fields:
            with self.assertRaisesRegex(ValueError, "alpha must have the shape"):
                fields.push(0, x, y, 0.1, light, alpha=alpha[1:])

    def test_weight(self):
        x, y = self.grid()
        rgb = np.zeros((len(x), 3))
        rgb[::2] = 1  # of two samples side by side one is white, and counts three times
        with self.job() as job, weft.Fields(job, 1) as fields:
            for n in range(2):
                fields.push(n, x, y, 0.0, rgb, weight=np.where(rgb[:, 0] > 0, 3, 1))
            for field in fields.finish():
                np.testing.assert_allclose(field.rgb, 0.75, rtol=1e-6)

    def test_arrays_of_other_kinds(self):
        x, y = self.grid()
        rgb = np.random.default_rng(2).random((len(x), 3)).astype(np.float32)
        fortran = np.asfortranarray(rgb)
        strided = np.repeat(x, 2)[::2]
        found = []
        for xs, colors in ((x.astype(np.float32), rgb), (strided, fortran), (x.tolist(), rgb.tolist()),
                           (x.astype(">f8"), rgb.astype(np.float64))):
            with self.job() as job, weft.Fields(job, 1) as fields:
                for n in range(2):
                    fields.push(n, xs, y, 0, colors)
                found.append(np.array([g.rgb for g in fields.finish()]))
        for other in found[1:]:
            np.testing.assert_array_equal(found[0], other)

    def test_refused_arrays(self):
        x, y = self.grid()
        rgb = np.zeros((len(x), 3))
        with self.job() as job, weft.Fields(job, 1) as fields:
            refused = ((TypeError, "x must hold real numbers", (x + 0j, y, 0.0, rgb)),
                       (TypeError, "rgb must hold real numbers", (x, y, 0.0, rgb > 0)),
                       (ValueError, r"x must have the shape \(n,\)", (x[None], y, 0.0, rgb)),
                       (ValueError, rf"y must have the shape \({len(x)},\)", (x, y[1:], 0.0, rgb)),
                       (ValueError, "t must have the shape", (x, y, np.zeros(3), rgb)),
                       (ValueError, "rgb must have the shape", (x, y, 0.0, rgb.T)),
                       (ValueError, "weight must have the shape", (x, y, 0.0, rgb, np.ones(2))),
                       (weft.UsageError, "not finite", (x, y, 0.0, rgb * np.nan)))
            for kind, text, arguments in refused:
                with self.assertRaisesRegex(kind, text):
                    fields.push(0, *arguments)
            with self.assertRaisesRegex(ValueError, r"rgb must have the shape \(n, n, 3\)"):
                fields.push_tile(0, np.zeros((4, 4)))
            with self.assertRaisesRegex(ValueError, "must hold samples"):
                fields.push_tile(0, np.zeros((0, 4, 3)))
            fields.push(0, [], [], [], np.zeros((0, 3)))

    def test_late_and_empty(self):
        tile = np.ones((48, 72, 3))
        with self.job() as job, weft.Fields(job, 1) as fields:
            fields.push_tile(0, tile)
            self.assertEqual(len(fields.until(1)), 1)
            with self.assertRaisesRegex(weft.UsageError, "field 0 is finished"):
                fields.push_tile(0, tile)
            with self.assertRaisesRegex(weft.Failed, "no sample reached it"):
                fields.finish()
        with self.assertRaisesRegex(weft.UsageError, "frames"):
            weft.Fields(self.job(), 0)

    def test_output(self):
        tile = np.random.default_rng(3).random((48, 72, 3))

        def push(finish, **more):
            with self.job(output="pushed.y4m", **more) as job, weft.Fields(job, 2) as fields:
                for n in range(4):
                    fields.push_tile(n, tile)
                    fields.until(n + 1)
                if finish:
                    fields.finish()

        push(finish=False)
        self.assertFalse(Path("pushed.y4m").exists())
        push(finish=True)
        video = Path("pushed.y4m").read_bytes()
        header, _, rest = video.partition(b"\n")
        self.assertTrue(header.startswith(b"YUV4MPEG2 W36 H24 F30:1 It"))
        self.assertEqual(len(rest), 2 * (len(b"FRAME\n") + 36 * 24 * 2 * 2))
        with self.assertRaisesRegex(weft.Failed, "exists"):
            push(finish=True)
        push(finish=True, overwrite=True)
        self.assertEqual(Path("pushed.y4m").read_bytes(), video)

    def test_callback(self):
        seen = []

        def fail(field):
            seen.append(field)
            raise RuntimeError("enough")

        with self.job() as job, weft.Fields(job, 1, on_field=fail) as fields:
            for n in range(2):
                fields.push_tile(n, np.ones((48, 72, 3)))
            with self.assertRaisesRegex(RuntimeError, "enough"):
                fields.finish()
        self.assertEqual(len(seen), 1)

    def test_fields_are_copies(self):
        with self.job() as job, weft.Fields(job, 8) as fields:
            found = []
            for n in range(16):
                fields.push_tile(n, np.full((48, 72, 3), n))
                found += fields.until(n + 1)
        gc.collect()
        self.assertEqual([set(field.rgb.ravel()) for field in found], [{n} for n in range(16)])
        found[0].rgb[:] = 7  # and one's own

    def test_order_of_ends(self):
        job = self.job()
        fields = weft.Fields(job, 1)
        with self.assertRaisesRegex(weft.UsageError, "belongs to Fields"):
            job.set("bits", 8)
        with self.assertRaisesRegex(weft.UsageError, "belongs to Fields"):
            job.close()
        fields.close()
        fields.close()
        with self.assertRaisesRegex(weft.UsageError, "closed"):
            fields.finish()
        job.set("bits", 8)
        # The last reference to the job may go first.
        fields = weft.Fields(job, 1)
        del job
        gc.collect()
        fields.push_tile(0, np.ones((48, 72, 3)))
        del fields
        gc.collect()


if __name__ == "__main__":
    unittest.main()
