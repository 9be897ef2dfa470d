"""Video to fields: the processor's seconds of weft beside those of ffmpeg, for run.py."""
import os
import resource
import shutil
import subprocess

TAGS = ["-color_primaries", "bt709", "-color_trc", "bt709", "-colorspace", "bt709"]


def make(bench):
    """Two seconds of 1080p50 as Y4M, and one of 240 pictures as H.264: moving edges, fine detail
    that deepens, and noise."""
    def run(rate, seconds, name, *codec):
        graph = (f"[0]null[a];[1]null[b];[a][b]overlay=x=480:y=270,noise=alls=8:allf=t,"
                 "format=yuv420p")
        command = ["ffmpeg", "-nostdin", "-v", "error", "-y",
                   "-f", "lavfi", "-i", f"mandelbrot=s=1920x1080:r={rate}",
                   "-f", "lavfi", "-i", f"testsrc2=s=960x540:r={rate}",
                   "-filter_complex", graph, "-t", str(seconds), *TAGS, *codec, bench.path(name)]
        subprocess.run(command, check=True)
    run(50, 2, "p50.y4m", "-f", "yuv4mpegpipe")
    run(240, 1, "p240.mp4", "-c:v", "libx264")


def processor_seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def in_turn(rounds, ways):
    """The medians of the processor's seconds of commands that take turns."""
    found = {name: [] for name in ways}
    for _ in range(rounds):
        for name, command in ways.items():
            found[name].append(processor_seconds(command))
    return {name: sorted(times)[rounds // 2] for name, times in found.items()}


def ffmpeg_fields(bench, chroma=""):
    """Fields from pictures in linear light, as ffmpeg's filters make them: BT.1886 by tables, 12
    bits of Y'CbCr of light, which is the most that `interlace` takes, and of which it makes (1/4,
    1/2, 1/4) of three lines, as weft's box is. Light out of gamut is cut off. As zscale is by
    itself, chroma is bilinear both ways; lanczos of ten taps to each side is as many as weft's."""
    resize = f":{chroma}" if chroma else ""
    chain = ("setparams=color_primaries=bt709:color_trc=bt709:colorspace=bt709:range=tv,"
             f"zscale=t=linear{resize},format=yuv444p12,interlace=lowpass=linear:scan=tff,"
             f"zscale=c=left:t=709{resize},format=yuv422p10")
    return ["ffmpeg", "-nostdin", "-v", "error", "-y", "-threads", "1", "-filter_threads", "1",
            "-i", bench.path("p50.y4m"), "-vf", chain, "-strict", "-1", bench.path("f.y4m")]


def weft(bench, name, *arguments):
    return [bench.program("weft"), "convert", bench.path(name), *arguments, "-q", "--overwrite",
            "-o", bench.path("a.y4m")]


def video(bench):
    asked = (("1080p50 Y4M to 1080i50, box, one core", 1, "s a second of video"),
             ("1080p50 Y4M to 1080i50, beside ffmpeg's zscale and interlace", 2, "x faster"),
             ("the same, chroma of zscale through as many taps", 2, "x faster"))
    if not shutil.which("ffmpeg"):
        for what, most, unit in asked:
            bench.target(what, None, most=most, unit=unit, note="no ffmpeg")
        return
    make(bench)
    seconds = in_turn(bench.rounds, {
        "weft": weft(bench, "p50.y4m", "--raster", "1080i50", "--aperture", "box", "--threads",
                     "1"),
        "ffmpeg": ffmpeg_fields(bench),
        "ffmpeg, many taps": ffmpeg_fields(bench, "f=lanczos:param_a=10"),
        "fields": weft(bench, "p240.mp4", "--raster", "1080i59.94"),
        "decode": ["ffmpeg", "-nostdin", "-v", "error", "-i", bench.path("p240.mp4"), "-f", "null",
                   "-"]})
    print("  processor's seconds: " + ", ".join(f"{k} {v:.3f}" for k, v in seconds.items()))
    bench.target(asked[0][0], seconds["weft"] / 2, most=1, unit=asked[0][2])
    bench.target(asked[1][0], seconds["ffmpeg"] / seconds["weft"], least=2, unit=asked[1][2],
                 note="its light has 12 bits, its chroma is bilinear")
    bench.target(asked[2][0], seconds["ffmpeg, many taps"] / seconds["weft"], least=2,
                 unit=asked[2][2], note="its light has 12 bits")
    bench.target("240 pictures of H.264 to 1080i59.94, beside decoding them",
                 seconds["fields"] / seconds["decode"], most=1.8,
                 note=f"{seconds['fields']:.2f} and {seconds['decode']:.2f} s of the processor")
    for how, options in (("", ()), (", aperture rotated", ("--aperture", "rotated")),
                         (", temporal width 4", ("--temporal-width", "4"))):
        report = bench.weft("convert", bench.path("p240.mp4"), "--raster", "1080i59.94", *options,
                            "-o", bench.path("a.y4m"))
        bench.target("memory, the same" + how, report["peak_memory_bytes"] / 2**20, most=256,
                     unit="MB")
    for name in ("p50.y4m", "p240.mp4", "a.y4m", "f.y4m"):
        if os.path.exists(bench.path(name)):
            os.remove(bench.path(name))
