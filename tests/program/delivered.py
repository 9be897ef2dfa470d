#!/usr/bin/env python3
"""delivered.py FILE CODEC RASTER [TIMECODE [TRACKS]]: whether a delivered file says what its raster demands, by
ffprobe, MediaInfo, ffmpeg's idet and a reader of QuickTime's atoms and MXF's sets that is written here. What is
wrong is printed, a line each; exit code 1."""
import json
import re
import subprocess
import sys
from fractions import Fraction as F

NTSC = F(30000, 1001)
# name: width, lines, rate, order, pixel aspect, H.273 colors, line map
SD = {
    "525i": (720, 486, NTSC, "bff", F(10, 11), (6, 1, 6), (21, 283)),
    "525i-imx": (720, 486, NTSC, "tff", F(10, 11), (6, 1, 6), (20, 283)),
    "525i-dv": (720, 480, NTSC, "bff", F(10, 11), (6, 1, 6), (23, 285)),
    "525i-rp202": (720, 480, NTSC, "tff", F(10, 11), (6, 1, 6), (23, 286)),
    "625i": (720, 576, F(25), "tff", F(12, 11), (5, 1, 6), (23, 336)),
    "625i-dv": (720, 576, F(25), "bff", F(12, 11), (5, 1, 6), (23, 335)),
}
RATES = {"23.976": F(24000, 1001), "29.97": NTSC, "59.94": F(60000, 1001)}
WORDS = {1: "bt709", 5: "bt470bg", 6: "smpte170m"}


def raster_of(name):
    wide = name.endswith("-wide")
    base = name[:-5] if wide else name
    if base in SD:
        row = list(SD[base])
        if wide:
            row[4] *= F(4, 3)
        return row
    lines, scan, rate = re.fullmatch(r"(\d+)(i|psf|p)([\d.]+)", base).groups()
    rate = RATES.get(rate) or F(rate)
    lines = int(lines)
    if scan == "i":  # named by fields
        return [1920, lines, rate / 2, "tff", F(1), (1, 1, 1), (21, 584)]
    return [lines * 16 // 9, lines, rate, "", F(1), (1, 1, 1), (42, 0) if lines == 1080 else (26, 0)]


def frame_of(timecode, base):
    """Frames since midnight: drop frame leaves out two labels of 30 in every minute but each tenth."""
    hours, minutes, seconds, frames = map(int, re.split("[:;]", timecode))
    minutes += 60 * hours
    dropped = (minutes - minutes // 10) * base // 15 if ";" in timecode else 0
    return (minutes * 60 + seconds) * base + frames - dropped


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.stdout, done.stderr


def mov_atoms(data):
    """The sample description's extensions of the first video track, by type."""
    found = {}

    def walk(at, end):
        while at + 8 <= end:
            size, kind, head = int.from_bytes(data[at : at + 4], "big"), data[at + 4 : at + 8], 8
            if size == 1:
                size, head = int.from_bytes(data[at + 8 : at + 16], "big"), 16
            if size < head or at + size > end:
                break
            if kind in (b"moov", b"trak", b"mdia", b"minf", b"stbl"):
                walk(at + head, at + size)
            elif kind == b"stsd" and b"vide" in data[at - 400 : at] and not found:
                entry = at + 16
                stop = entry + int.from_bytes(data[entry : entry + 4], "big")
                found["tag"] = data[entry + 4 : entry + 8].decode()
                inner = entry + 86
                while inner + 8 <= stop:
                    length = int.from_bytes(data[inner : inner + 4], "big")
                    if length < 8:
                        break
                    found.setdefault(data[inner + 4 : inner + 8].decode("latin1"), []).append(data[inner + 8 : inner + length])
                    inner += length
            at += size

    walk(0, len(data))
    return found


def mxf_sets(data):
    """Header sets: (kind, {tag: value}); and the bytes of each element, by the last four of its key."""
    sets, elements, at = [], {}, 0
    while at + 17 < len(data):
        key, first = data[at : at + 16], data[at + 16]
        if key[:4] != b"\x06\x0e\x2b\x34":
            return sets, elements, f"no key at {at}"
        more = first & 0x7F if first & 0x80 else 0
        length = int.from_bytes(data[at + 17 : at + 17 + more], "big") if more else first
        value = at + 17 + more
        if key[4:6] == b"\x02\x53" and key[8] == 0x0D:
            items, inner = {}, value
            while inner < value + length:
                tag, size = int.from_bytes(data[inner : inner + 2], "big"), int.from_bytes(data[inner + 2 : inner + 4], "big")
                items[tag] = data[inner + 4 : inner + 4 + size]
                inner += 4 + size
            if inner != value + length:
                return sets, elements, f"set at {at} is not whole"
            sets.append((key[14], items))
        elif key[4:8] == b"\x01\x02\x01\x01":
            elements.setdefault(key[12], []).append(length)
        at = value + length
    return sets, elements, "" if at == len(data) else "the last item is cut"


def number(value):
    return int.from_bytes(value, "big")


def main():
    path, codec, name = sys.argv[1:4]
    timecode = sys.argv[4] if len(sys.argv) > 4 else "00:00:00:00"
    tracks = int(sys.argv[5]) if len(sys.argv) > 5 else 0
    ending = path.rsplit(".", 1)[1]
    width, lines, rate, order, par, colors, line_map = raster_of(name)
    if codec == "dvcpro50" and lines == 486:
        lines, order, line_map = 480, "bff", (23, 285)
    coded = {576: 608, 486: 512}[lines] if codec == "imx50" else lines
    if codec == "imx50":
        line_map = (7, 320) if coded == 608 else (7, 270)
    troubles = []

    def same(what, got, *right):
        if got not in right:
            troubles.append(f"{path} ({name}): {what} is {got!r}, not {' or '.join(map(repr, right))}")

    # ---- ffprobe ----
    out, said = run("ffprobe", "-v", "error", "-count_packets", "-show_streams", "-show_format", "-of", "json", path)
    probed = json.loads(out)
    same("ffprobe's complaint", said.strip(), "")
    video = [s for s in probed["streams"] if s["codec_type"] == "video"][0]
    sound = [s for s in probed["streams"] if s["codec_type"] == "audio"]
    names = {"prores-hq": "prores", "prores-4444": "prores", "dnxhr": "dnxhd", "xdcamhd422": "mpeg2video", "imx50": "mpeg2video",
             "dvcpro50": "dvvideo", "avci100": "h264"}
    same("codec", video["codec_name"], names.get(codec, codec))
    same("size", (video["width"], video["height"]), (width, coded))
    same("rate", F(video["r_frame_rate"]), rate)
    labels = {"tff": ("tt",), "bff": ("bb",), "": ("progressive",)} if ending == "mxf" else {
        "tff": ("tb",), "bff": ("bt",), "": ("progressive",)}
    same("field order", video.get("field_order"), *labels[order])
    aspect = F(video["sample_aspect_ratio"].replace(":", "/"))
    shape = F(16, 9) if par > F(115, 100) or width > 720 else F(4, 3)
    same("pixel aspect", aspect, shape * coded / width if ending == "mxf" else par,
         shape * lines / width if ending == "mxf" else par)
    for key, code in zip(("color_primaries", "color_transfer", "color_space"), colors):
        same(key, video.get(key), WORDS[code], *(["bt470bg"] if code == 6 and key == "color_space" else []))
    if ending != "mov":
        same("color range", video.get("color_range"), "tv")
    tags = {**probed["format"].get("tags", {}), **video.get("tags", {})}
    same("timecode", tags.get("timecode") or tags.get("TIMECODE"), timecode)
    frames = int(video["nb_read_packets"])
    if frames < 3:
        troubles.append(f"{path}: {frames} frames")
    if ending != "mkv":
        same("duration", round(float(video["duration"]) * rate), frames)
    groups = 1 if codec == "imx50" and tracks else tracks
    same("sound", [s["channels"] for s in sound], [tracks // groups] * groups if groups else [])
    for s in sound:
        same("rate of sound", s["sample_rate"], "48000")
        same("length of sound", abs(float(s["duration"]) - frames / rate) < 1 / 48000, True)

    # ---- Every frame of it ----
    out, _ = run("ffprobe", "-v", "error", "-select_streams", "v", "-show_entries", "frame=interlaced_frame,top_field_first",
                 "-of", "csv=p=0", path)
    flags = set(line.rstrip(",") for line in out.split())
    if codec != "v210":
        same("flags of frames", flags, {{"tff": "1,1", "bff": "1,0", "": "0,0"}[order]})
    _, said = run("ffmpeg", "-nostdin", "-hide_banner", "-i", path, "-vf", "idet", "-f", "null", "-")
    counts = re.search(r"Multi frame detection: TFF: *(\d+) BFF: *(\d+) Progressive: *(\d+)", said)
    counts = dict(zip(("tff", "bff", ""), map(int, counts.groups())))
    same("idet's order", max(counts, key=counts.get), order)

    # ---- MediaInfo ----
    told = json.loads(run("mediainfo", "--Output=JSON", path)[0])["media"]["track"]
    seen = [t for t in told if t["@type"] == "Video"][0]
    scan = "Interlaced" if order else "Progressive"
    same("MediaInfo's scan", seen.get("ScanType", "Progressive"), scan, *(["MBAFF"] if codec == "avci100" and order else []))
    if order and not (codec == "avci100" and "ScanOrder" not in seen):
        same("MediaInfo's order", seen.get("ScanOrder"), order.upper())
    if codec == "v210" and width == 720:
        same("standard", seen.get("Standard"), "PAL" if lines == 576 else "NTSC")
    if ending == "mov" and codec in ("avci100", "xdcamhd422"):
        same("commercial name", seen.get("Format_Commercial_IfAny"), {"avci100": "AVC-Intra 100", "xdcamhd422": "XDCAM HD422"}[codec])
    if codec == "dnxhd":
        same("commercial name", (seen.get("Format_Commercial_IfAny") or "")[:5], "DNxHD")
    if codec.startswith("prores"):
        same("profile", seen.get("Format_Profile"), {"prores": "422", "prores-hq": "422 HQ", "prores-4444": "4444"}[codec])
    if codec in ("xdcamhd422", "imx50"):
        same("profile", seen.get("Format_Profile"), "4:2:2")
        same("level", seen.get("Format_Level"), "High" if codec == "xdcamhd422" else "Main")
        same("mode of the bit rate", seen.get("BitRate_Mode"), "CBR")

    # ---- Byte by byte ----
    with open(path, "rb") as file:
        data = file.read()
    if ending == "mov":
        atoms = mov_atoms(data)
        tag = {"v210": ("v210",), "prores": ("apcn",), "prores-hq": ("apch",), "prores-4444": ("ap4h",), "dnxhd": ("AVdn",), "dnxhr": ("AVdh",),
               "dvcpro50": ("dv5p" if lines == 576 else "dv5n",)}.get(codec)
        if tag:
            same("tag", atoms.get("tag"), *tag)
        if codec == "xdcamhd422":
            same("tag", atoms.get("tag"), {"1080i50": "xd5c", "1080i59.94": "xd5b", "1080p25": "xd5e", "1080p29.97": "xd5f",
                                           "1080p23.976": "xd5d", "720p50": "xd5a", "720p59.94": "xd59"}[name])
        if codec == "avci100":
            same("tag", atoms.get("tag"), {"1080i50": "ai15", "1080i59.94": "ai16", "1080p25": "ai12", "1080p29.97": "ai13",
                                           "1080p23.976": "ai13", "720p50": "ai1q", "720p59.94": "ai1p"}[name])
        same("fiel", atoms.get("fiel"), [{"tff": b"\2\x09", "bff": b"\2\x0e", "": b"\1\0"}[order]])
        same("colr", atoms.get("colr"), [b"nclc" + b"".join(c.to_bytes(2, "big") for c in colors)])
        same("pasp", atoms.get("pasp"), [par.numerator.to_bytes(4, "big") + par.denominator.to_bytes(4, "big")])
        clean = (704, 480 if lines == 486 else lines) if width == 720 else (width, lines)
        same("clap", atoms.get("clap"), [b"".join(v.to_bytes(4, "big") for v in (clean[0], 1, clean[1], 1, 0, 1, 0, 1))])
    if ending == "mxf":
        sets, elements, trouble = mxf_sets(data)
        same("structure", trouble, "")
        pictures = [items for kind, items in sets if kind in (0x27, 0x28, 0x29, 0x51)]
        same("number of picture descriptors", len(pictures), 1)
        items = pictures[0]
        fields = 2 if order else 1
        same("frame layout", number(items[0x320C]), 1 if order else 0)
        same("line map", items[0x320D], b"".join(v.to_bytes(4, "big") for v in (2, 4) + line_map))
        same("first field", items.get(0x3212, b""), b"\1" if order else b"")
        same("siting of chroma", items[0x3303], b"\0")
        same("aspect", F(number(items[0x320E][:4]), number(items[0x320E][4:])), shape)
        same("lines shown", number(items[0x3208]) * fields, lines)
        same("lines stored", number(items[0x3202]) * fields, coded, (coded + 15) // 16 * 16)
        for kind, clock in sets:
            if kind == 0x14:
                same("timecode base", number(clock[0x1502]), -int(-rate // 1))
                same("drop frame", number(clock[0x1503]), int(";" in timecode))
                same("timecode's frame", number(clock[0x1501]), frame_of(timecode, -int(-rate // 1)))
        if codec == "imx50":
            same("bytes of pictures", set(elements[0x05]), {250000 if coded == 608 else 208540})
        if groups and codec != "imx50":
            cadence = [n // 3 for n in elements[0x16]]
            if rate == NTSC:
                same("samples a frame", cadence[::tracks][:5], [1602, 1601, 1602, 1601, 1602][: len(cadence[::tracks][:5])])
    print("\n".join(troubles))
    sys.exit(bool(troubles))


main()
