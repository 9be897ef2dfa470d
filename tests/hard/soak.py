"""Many jobs and pushed fields in one Python, with failures and cancelings among them: memory does not grow. COUNT rounds; the
last half may end at most 2 MB above where it began."""
import os
import sys

import numpy
import weft

RASTER = "48x36@30i,tff"
SCENE = os.path.join(os.environ["WEFT_SOURCE"], "examples/scenes/carousel.lua")
Y, X = numpy.indices((36, 48)).reshape(2, -1) + 0.5


def resident_kb():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") // 1024


def stop(_progress):
    raise ValueError("enough")


def fails(make):
    try:
        make()
    except (weft.WeftError, ValueError):
        return
    raise AssertionError("it should have failed")


def push():
    with weft.Job(raster=RASTER, aperture="box", output="push.y4m", overwrite=True) as job, weft.Fields(job, frames=4) as fields:
        for n in range(8):
            fields.push(n, X, Y, 0.25, numpy.full((len(X), 3), 0.5))
            fields.until(n + 1)
        fields.finish()


def round_of_jobs():
    render = {"command": "render", "raster": RASTER, "samples": 1, "frames": "0-1", "overwrite": True}
    weft.Job(SCENE, output="o.y4m", **render).run()
    weft.Job(SCENE, output="o.####.exr", **(render | {"command": "trace", "oversample": "1x1x2"})).run()
    weft.Job("o.####.exr", output="c.y4m", raster=RASTER, overwrite=True).run()
    weft.Job(raster="525i", frames="0-9", subframe_rate=240).plan()
    push()
    fails(lambda: weft.Job(SCENE, output="/nonexistent/o.y4m", **render).run())
    fails(lambda: weft.Job(SCENE, output="o.y4m", progress=stop, **render).run())
    fails(lambda: weft.Job("none.####.exr", output="c.y4m", raster=RASTER).run())
    fails(lambda: weft.Job(raster="nonsense"))


def main():
    count = int(sys.argv[1])
    curve = []
    for _ in range(count):
        round_of_jobs()
        curve.append(resident_kb())
    middle, end = curve[count // 2], curve[-1]
    print(f"{count} rounds of 9 jobs: {curve[0]} kB after the first, {middle} amid, {end} at the end")
    return end - middle > 2048


if __name__ == "__main__":
    sys.exit(main())
