"""Makes WAV files of noise, and compares the tracks of a file with them, sample by sample.

wav FILE RATE BITS CHANNELS SAMPLES [CLAIMED]   noise with extremes; the header claims so many samples
tracks FILE WAV START COUNT BITS [TRACKS]       all tracks of FILE, in order, are the channels of WAV from
                                                sample START on; what WAV does not have is 0
probe FILE TRACKS CHANNELS BITS SECONDS         ffprobe says so of every track
tone FILE TRACKS BITS SAMPLES START             1 kHz whose peak is 18 dB below full scale, from sample START
gap FILE WAV                                    the first track is WAV's, but for a quarter of a second of silence
sine FILE HZ                                    the first track is a sine that begins at time 0
lossy FILE STREAMS CHANNELS SECONDS HZ          so many streams of AAC, the last of so many channels, that ffprobe
                                                says last so long; their first track is about that sine
"""
import json, math, random, struct, subprocess, sys


def write_wav(name, rate, bits, channels, samples, claimed=None):
    width, rng = bits // 8, random.Random(samples * bits + channels)
    most = 1 << (bits - 1)
    body = bytearray()
    for i in range(samples * channels):
        value = (-most, most - 1, 1, -1)[i] if i < 4 else rng.randrange(-most, most)
        body += (value + (128 if bits == 8 else 0)).to_bytes(width, "little", signed=bits > 8)
    size = (claimed or samples) * channels * width
    if bits > 24:  # WAVE_FORMAT_EXTENSIBLE, PCM
        form = struct.pack("<HHIIHHHHI", 0xfffe, channels, rate, rate * channels * width, channels * width, bits, 22,
                           bits, 0) + bytes.fromhex("0100000000001000800000aa00389b71")
    else:
        form = struct.pack("<HHIIHH", 1, channels, rate, rate * channels * width, channels * width, bits)
    with open(name, "wb") as f:
        f.write(b"RIFF" + struct.pack("<I", 20 + len(form) + size) + b"WAVEfmt " + struct.pack("<I", len(form)) + form +
                b"data" + struct.pack("<I", size) + body)


def read_wav(name):
    data = open(name, "rb").read()
    channels, bits = struct.unpack_from("<H", data, 22)[0], struct.unpack_from("<H", data, 34)[0]
    width, body = bits // 8, data[data.index(b"data") + 8:]
    values = [int.from_bytes(body[i:i + width], "little", signed=True) << (32 - bits) for i in range(0, len(body), width)]
    return [values[c::channels] for c in range(channels)]


def streams(name):
    out = subprocess.run(["ffprobe", "-v", "error", "-select_streams", "a", "-show_streams", "-of", "json", name],
                         capture_output=True, check=True).stdout
    return json.loads(out)["streams"]


def read_tracks(name):
    tracks = []
    for i, s in enumerate(streams(name)):
        raw = subprocess.run(["ffmpeg", "-nostdin", "-v", "error", "-i", name, "-map", "0:a:%d" % i, "-f", "s32le", "-"],
                             capture_output=True, check=True).stdout
        values = struct.unpack("<%di" % (len(raw) // 4), raw)
        tracks += [list(values[c::s["channels"]]) for c in range(s["channels"])]
    return tracks


def rounded(value, bits):
    step = 1 << (32 - bits)
    return min((value + step // 2) // step * step, (1 << 31) - step)


def same_tracks(name, wav, start, count, bits, tracks=0):
    channels, got = read_wav(wav), read_tracks(name)
    count, start, bits = int(count), int(start), int(bits)
    if len(got) != (int(tracks) or len(channels)):
        sys.exit("%s: %d tracks" % (name, len(got)))
    for t, track in enumerate(got):
        right = [0] * count
        if t < len(channels):
            for i in range(count):
                if 0 <= start + i < len(channels[t]):
                    right[i] = rounded(channels[t][start + i], bits)
        if len(track) != count:
            sys.exit("%s: track %d has %d samples, not %d" % (name, t + 1, len(track), count))
        if track != right:
            at = next(i for i in range(count) if track[i] != right[i])
            sys.exit("%s: track %d, sample %d is %#x, not %#x" % (name, t + 1, at, track[at], right[at]))


def probe(name, tracks, channels, bits, seconds):
    found, seconds = streams(name), eval(seconds)
    if len(found) != int(tracks):
        sys.exit("%s: %d streams of sound" % (name, len(found)))
    for s in found:
        raw = subprocess.run(["ffprobe", "-v", "error", "-select_streams", str(s["index"]), "-show_entries",
                              "packet=size", "-of", "csv=p=0", name], capture_output=True, check=True).stdout
        length = sum(int(w.rstrip(b",")) for w in raw.split()) * 8 / int(channels) / int(bits) / 48000
        if "d10" in name:
            length = float(s["duration"])
        about = (s["channels"], s["bits_per_sample"], s["sample_rate"], s["codec_name"], s["disposition"]["default"])
        right = (int(channels), int(bits), "48000", "pcm_s%sle" % bits, 0 if name.endswith("mxf") else 1)
        if about != right or abs(length - seconds) > 1 / 48000:
            sys.exit("%s: stream %d: %r and %.6f s, not %r and %.6f s" % (name, s["index"], about, length, right, seconds))
        if "duration" in s and abs(float(s["duration"]) - seconds) > 1 / 48000 + 1e-6:
            sys.exit("%s: stream %d says that it is %s s long" % (name, s["index"], s["duration"]))


def tone(name, tracks, bits, samples, start):
    right = [rounded(round(2**31 * 10**(-18 / 20) * math.sin(2 * math.pi * (n % 48) / 48)), int(bits))
             for n in range(int(start), int(start) + int(samples))]
    got = read_tracks(name)
    if len(got) != int(tracks) or any(t != right for t in got):
        sys.exit("%s: %d tracks of %d samples: it is another tone" % (name, len(got), len(got[0])))


def gap(name, wav):
    track, right = read_tracks(name)[0], read_wav(wav)[0]
    silent = [i for i, value in enumerate(track) if value != right[i]]
    if any(track[i] for i in silent) or not 11000 < len(silent) < 13500 or silent[-1] - silent[0] > len(silent) + 2:
        sys.exit("%s: %d samples are others, from %s on" % (name, len(silent), silent[:1]))


def sine(name, hz):
    """The sine of hz that begins with the file, whatever rate it came from, but for its edges."""
    track, hz = read_tracks(name)[0], eval(hz)
    worst = max(abs(track[n] / 2**31 - .5 * math.sin(2 * math.pi * hz * n / 48000))
                for n in range(200, len(track) - 200))
    if worst > 2e-5:
        sys.exit("%s: it is off by %.2g of full scale" % (name, worst))


def lossy(name, count, channels, seconds, hz):
    """A sample sooner or later is wrong by 2.5 % of full scale."""
    found, seconds, hz = streams(name), eval(seconds), float(hz)
    if len(found) != int(count) or found[-1]["channels"] != int(channels):
        sys.exit("%s: %d streams of sound, the last of %d channels" % (name, len(found), found[-1]["channels"]))
    for s in found:
        about = (s["codec_name"], s["start_pts"], s["sample_rate"], s["disposition"]["default"])
        if about != ("aac", 0, "48000", 1) or abs(float(s["duration"]) - seconds) > .5 / 48000 + 1e-6:
            sys.exit("%s: stream %d: %r, and %s s long, not %.6f" % (name, s["index"], about, s["duration"], seconds))
    track = read_tracks(name)[0]
    off = [track[n] / 2**31 - .5 * math.sin(2 * math.pi * hz * n / 48000) for n in range(2000, int(seconds * 48000) - 2000)]
    rms = math.sqrt(sum(x * x for x in off) / len(off))
    if rms > .005:
        sys.exit("%s: it is off by %.2g of full scale" % (name, rms))


verb, rest = sys.argv[1], sys.argv[2:]
if verb == "wav":
    write_wav(rest[0], *(int(x) for x in rest[1:]))
else:
    {"tracks": same_tracks, "probe": probe, "tone": tone, "sine": sine, "gap": gap, "lossy": lossy}[verb](*rest)
