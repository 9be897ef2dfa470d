"""Each command of the program by a call of the package: what the program says, with arrays in and out,
and errors that are raised with the program's message, without a word on standard output or error.
Run by test_calls.sh, in a directory of its own."""
import contextlib
import json
import os
import subprocess
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np

import weft

SCENE = str(Path(os.environ["WEFT_SOURCE"], "examples/scenes/carousel.lua"))
SMALL = "36x24@30i,tff"


def program(*arguments):
    plain = {k: v for k, v in os.environ.items() if k != "LD_PRELOAD"}
    return subprocess.run([os.environ["WEFT"], *arguments], env=plain, check=False, capture_output=True,
                          text=True)


@contextlib.contextmanager
def silence(test):
    """Whatever goes to file descriptors 1 and 2 meanwhile is a failure."""
    with tempfile.TemporaryFile() as heard:
        kept = [os.dup(fd) for fd in (1, 2)]
        try:
            for fd in (1, 2):
                os.dup2(heard.fileno(), fd)
            yield
        finally:
            for fd, old in zip((1, 2), kept):
                os.dup2(old, fd)
                os.close(old)
        heard.seek(0)
        test.assertEqual(heard.read(), b"")


class Calls(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        weft.render(SCENE, "a.y4m", raster=SMALL, frames="0-2", samples=4, overwrite=True)
        weft.trace(SCENE, "t.####.exr", raster=SMALL, frames="0-1", oversample="1x1x4", overwrite=True)

    def same(self, told, *arguments):
        self.assertEqual(json.loads(json.dumps(told)), json.loads(program(*arguments).stdout))

    def test_questions_are_the_programs(self):
        with silence(self):
            measured, info = weft.measure("a.y4m", display="crt"), weft.info("a.y4m", "t.####.exr")
            verified, box = weft.verify("a.y4m"), weft.filters("box", input_lines=48, raster=SMALL)
            several = weft.measure("a.y4m", "a.y4m")
            planned = weft.plan(raster=SMALL, frames="0-1", subframe_rate=240)
        self.same(measured, "measure", "a.y4m", "--display", "crt", "--json")
        self.same(several, "measure", "a.y4m", "a.y4m", "--json")
        self.same({"files": info}, "info", "a.y4m", "t.####.exr", "--json")
        self.same(verified, "verify", "a.y4m", "--json")
        self.same(box, "filters", "box", "--input-lines", "48", "--raster", SMALL, "--json")
        self.same(planned, "plan", "--raster", SMALL, "--frames", "0-1", "--subframe-rate", "240",
                  "--format", "json")
        self.same(weft.profiles(), "verify", "--profiles", "--json")

    def test_errors_are_the_programs(self):
        cases = [(lambda: weft.measure("none.y4m"), ["measure", "none.y4m"]),
                 (lambda: weft.measure("a.y4m", display="tube"), ["measure", "a.y4m", "--display", "tube"]),
                 (lambda: weft.measure("a.y4m", limit="flicker=1"), ["measure", "a.y4m", "--limit", "flicker=1"]),
                 (lambda: weft.measure(), ["measure"]),
                 (lambda: weft.verify("a.y4m", profile="none"), ["verify", "a.y4m", "--profile", "none"]),
                 (lambda: weft.info("none.exr"), ["info", "none.exr"]),
                 (lambda: weft.filters("bax"), ["filters", "bax"]),
                 (lambda: weft.filters("box", input_lines=0), ["filters", "box", "--input-lines", "0"]),
                 (lambda: weft.composite("a.y4m", "b.y4m"), ["composite", "a.y4m", "-o", "b.y4m"]),
                 (lambda: weft.composite("a.y4m", "b.y4m", decoder="comb"),
                  ["composite", "a.y4m", "-o", "b.y4m", "--decoder", "comb"]),
                 (lambda: weft.page("none.y4m", output="b.html"), ["page", "none.y4m", "-o", "b.html"]),
                 (lambda: weft.page("a.y4m", output="b.htm", frames="x"),
                  ["page", "a.y4m", "-o", "b.htm", "--frames", "x"]),
                 (lambda: weft.page("a.y4m", output="b.html", labels=["a", "b"]),
                  ["page", "a.y4m", "-o", "b.html", "--label", "a", "--label", "b"]),
                 (lambda: weft.plot("none.json", "b.svg"), ["plot", "none.json", "-o", "b.svg"]),
                 (lambda: weft.plot("none.json", "b.gif"), ["plot", "none.json", "-o", "b.gif"]),
                 (lambda: weft.convert("none.####.exr", output="b.y4m"),
                  ["convert", "none.####.exr", "-o", "b.y4m"]),
                 (lambda: weft.render("none.lua", output="b.y4m"), ["render", "none.lua", "-o", "b.y4m"])]
        for call, arguments in cases:
            with self.subTest(arguments), silence(self), self.assertRaises(weft.Error) as caught:
                call()
            self.assertEqual("weft: " + str(caught.exception), program(*arguments).stderr.strip())

    def test_every_command_has_a_call(self):
        lines = program("--help").stdout.splitlines()
        commands = {line.split()[1] for line in lines if line.startswith("  weft ") and not line.startswith("  weft 0")}
        self.assertGreaterEqual(len(commands), 14)
        self.assertEqual([name for name in sorted(commands) if not callable(getattr(weft, name, None))], [])

    def test_what_the_program_says_of_itself(self):
        self.assertEqual(weft.manual(), program("manual").stdout)
        for shell in ("bash", "zsh", "fish"):
            self.assertEqual(weft.completion(shell), program("completion", shell).stdout)
        with self.assertRaisesRegex(weft.UsageError, "tcsh"):
            weft.completion("tcsh")

    def test_a_comparison_is_the_programs(self):
        weft.compare("t.####.exr", ways=["box", "line+limit=.06"], output="called.html", raster=SMALL, subframe_rate=240)
        program("convert", "t.####.exr", "--compare", "box,line+limit=.06", "-o", "typed.html", "--raster", SMALL,
                "--subframe-rate", "240")
        with open("called.html", "rb") as called, open("typed.html", "rb") as typed:
            self.assertEqual(called.read(), typed.read())
        for ways, said in (("", "nothing to compare|is empty"), ("bax", "bax"), ("box,,line", "empty")):
            with self.subTest(ways), self.assertRaisesRegex(weft.UsageError, said):
                weft.compare("t.####.exr", ways=ways, output="none.html", raster=SMALL, subframe_rate=240)

    def test_limits_have_figures(self):
        with self.assertRaises(weft.Failed) as caught:
            weft.measure("a.y4m", limit={"flicker.rms": 0, "legal.range_share": 1})
        self.assertEqual(caught.exception.report["frames"], 3)
        self.assertIn("flicker.rms", str(caught.exception))

    def test_unknown_names_are_refused(self):
        with self.assertRaises(weft.UsageError):
            weft.measure("a.y4m", dispaly="crt")

    def test_codes_are_no_light(self):
        with self.assertRaisesRegex(weft.UsageError, "uint8 are codes"):
            weft.convert(np.zeros((8, 24, 36, 3), np.uint8), output="codes.y4m", raster="36x24@25i",
                         subframe_rate="200")

    def test_jobs_are_counted_from_1(self):
        with open("numbered.json", "w") as out:
            json.dump([{"inputs": "a.####.exr", "output": "n.y4m"}] * 2, out)
        for number in (-1, 3, 2**64 + 2):
            with self.subTest(number), self.assertRaises(weft.UsageError):
                weft.Job().load("numbered.json", number)
        with self.assertRaises(TypeError):
            weft.Job().load("numbered.json", 1.9)

    def test_arrays_are_files(self):
        """Light that goes in as an array makes the codes that it makes from files."""
        reader = weft.read("t.####.exr", raster="36x24@240p")
        self.assertEqual((reader.layout, len(reader)), ("linear", 16))
        light = np.stack(reader.planes, axis=-1)
        made = weft.convert(light, raster=SMALL, subframe_rate=240)
        weft.convert("t.####.exr", output="files.y4m", raster=SMALL, subframe_rate=240, overwrite=True)
        files = weft.read("files.y4m", raster=SMALL)
        for p in range(3):
            np.testing.assert_array_equal(made.codes(p), files.codes(p))
        self.assertEqual(made.raster, weft.raster(SMALL))
        self.assertEqual(made.fields().shape, (4, 12, 36, 3))

    def test_codes_survive(self):
        """Every code of 8, 10 and 12 bits comes back from float signals, in and out."""
        for bits in (8, 10, 12):
            for full in (False, True):
                one = 2 ** (bits - 8)
                shape = (1, 64, 64)
                codes = (np.arange(64 * 64) % 2 ** bits).reshape(shape)
                luma = (codes - (0 if full else 16 * one)) / (2 ** bits - 1 if full else 219 * one)
                chroma = (codes - 128 * one) / (2 ** bits - 1 if full else 224 * one)
                clip = weft.Clip([luma, chroma, chroma], "64x64@25i", bits=bits, full_range=full)
                clip.write("codes.y4m")
                back = weft.read("codes.y4m")
                self.assertEqual((back.bits, back.full_range), (bits, full))
                for p in range(3):
                    np.testing.assert_array_equal(back.codes(p), codes)

    def test_every_chroma_at_every_depth(self):
        for across, down in ((1, 1), (2, 1), (2, 2), (4, 1)):
            for bits in range(8, 17):
                chroma = np.zeros((1, 64 // down, 64 // across))
                weft.Clip([np.full((1, 64, 64), 0.5), chroma, chroma], "64x64@25i", bits=bits).write("depth.y4m")
                back = weft.read("depth.y4m")
                self.assertEqual((back.bits, back.across, back.down), (bits, across, down))

    def test_composite_of_a_clip(self):
        weft.render(SCENE, "tv.y4m", raster="525i", frames=0, samples=1, overwrite=True)
        shown = weft.composite(weft.read("tv.y4m"), encoder="filtered", decoder="comb3")
        weft.composite("tv.y4m", "seen.y4m", encoder="filtered", decoder="comb3", overwrite=True)
        np.testing.assert_array_equal(shown.codes(1), weft.read("seen.y4m").codes(1))
        self.assertEqual(shown.report["command"], "composite")
        self.assertEqual(shown.report["frames"], 1)

    def test_bars_flicker(self):
        """Lines of white and black: half their difference is 1/2 of white."""
        bars = np.zeros((1, 24, 36, 3))
        bars[:, ::2] = 1
        self.assertAlmostEqual(weft.measure(bars, raster=SMALL)["flicker"]["rms"], 0.5, 6)
        self.assertEqual(weft.measure(bars, raster=SMALL, against=bars)["difference"]["rmse"], 0)

    def test_bad_arrays(self):
        for bad in (np.zeros((2, 24, 36)), np.zeros((0, 24, 36, 3)), np.zeros((1, 24, 36, 3), complex)):
            with self.assertRaises(weft.UsageError):
                weft.convert(bad, raster=SMALL, subframe_rate=240)
        with self.assertRaises(weft.UsageError):
            weft.Clip([np.zeros((1, 24, 36))] * 3)
        for bits in (7, 17):
            with self.assertRaisesRegex(weft.UsageError, "8 to 16 bits"):
                weft.Clip([np.zeros((1, 24, 36))] * 3, "36x24@25i", bits=bits)

    def test_notebooks(self):
        shown = weft.read("a.y4m", raster=SMALL)._repr_html_()
        self.assertIn("data:image/png;base64,", shown)
        self.assertIn("<th", weft.info("a.y4m")._repr_html_())
        self.assertIn("&lt;b&gt;", weft.Report({"<b>": ["<i>"]})._repr_html_())

    def test_progress_and_cancel(self):
        seen = []
        weft.measure("a.y4m", progress=lambda p: seen.append((p.stage, p.frames_done)))
        self.assertEqual({stage for stage, _ in seen}, {"measure"})
        self.assertEqual(sorted({done for _, done in seen})[-3:], [1, 2, 3])
        self.assertEqual(seen[-1][1], 3)

        def stop(_progress):
            raise LookupError("enough")
        for call in (lambda: weft.measure("a.y4m", progress=stop),
                     lambda: weft.verify("a.y4m", progress=stop),
                     lambda: weft.render(SCENE, "stopped.y4m", raster=SMALL, progress=stop)):
            with self.assertRaises(LookupError):
                call()
        self.assertFalse(Path("stopped.y4m").exists())


if __name__ == "__main__":
    warnings.simplefilter("error")
    unittest.main()
