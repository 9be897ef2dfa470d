"""Walks an MXF OP1a file by SMPTE ST 377-1 alone and holds its parts against each other; prints
what it says as JSON. A second argument is an expression that must be true of that, called d; a
third a file: the pictures must be its bytes, one after the other."""
import json
import struct
import sys

FILL = bytes.fromhex("060e2b34010101020301021001000000")
SETS = bytes.fromhex("060e2b34025301010d0101010101")
INDEX = bytes.fromhex("060e2b34025301010d01020101100100")
PRIMER = bytes.fromhex("060e2b34020501010d01020101050100")
RANDOM_INDEX = bytes.fromhex("060e2b34020501010d01020101110100")
ELEMENT = bytes.fromhex("060e2b34010201010d010301")
NAMES = {0x2f: "preface", 0x30: "identification", 0x18: "storage", 0x23: "container data",
         0x36: "material package", 0x37: "file package", 0x3b: "track", 0x0f: "sequence",
         0x14: "timecode", 0x11: "clip", 0x44: "multiple", 0x28: "picture", 0x48: "sound"}
STRONG = {0x3b03: 1, 0x4803: 1, 0x4701: 1, 0x3b06: 2, 0x1901: 2, 0x1902: 2, 0x4403: 2,
          0x1001: 2, 0x3f01: 2}


def number(b):
    return int.from_bytes(b, "big")


def elements(b):
    count, size = struct.unpack(">II", b[:8])
    assert len(b) == 8 + count * size, "an array of another size"
    return [b[8 + i * size:8 + (i + 1) * size] for i in range(count)]


def walk(data):
    """Key, where it starts, value: to the last byte of the file."""
    at = 0
    while at < len(data):
        key, first = data[at:at + 16], data[at + 16]
        assert key[:4] == b"\x06\x0e\x2b\x34", f"no key at {at}"
        size = first - 128 if first > 127 else 0
        length = number(data[at + 17:at + 17 + size]) if size else first
        assert 3 <= size <= 8, f"a length of {size} bytes at {at}"
        begin = at + 17 + size
        assert begin + length <= len(data), f"the value at {at} is cut off"
        yield key, at, data[begin:begin + length]
        at = begin + length


def local_set(value, tags):
    items, at = {}, 0
    while at < len(value):
        tag, length = struct.unpack(">HH", value[at:at + 4])
        assert tag in tags, f"tag {tag:04x} is not in the primer"
        assert tag not in items, f"tag {tag:04x} is there twice"
        items[tag] = value[at + 4:at + 4 + length]
        at += 4 + length
    assert at == len(value), "a set is cut off"
    return items


def read_partition(at, value):
    fields = struct.unpack(">HHIQQQQQIQI", value[:64])
    names = ("major", "minor", "grid", "this", "previous", "footer", "header_bytes",
             "index_bytes", "index_sid", "body_offset", "body_sid")
    p = dict(zip(names, fields))
    assert p["this"] == at, "a partition is not where it says"
    p["pattern"], p["containers"] = value[64:80].hex(), [e.hex() for e in elements(value[80:])]
    return p


class Walk:
    def __init__(self, data):
        self.partitions, self.kinds, self.sets, self.klvs = [], [], [], []
        self.tags, self.index, self.random_index = {}, [], None
        for key, at, value in walk(data):
            self.klvs.append((key, at, value))
            self.take(key, at, value)
        assert key == RANDOM_INDEX, "the random index pack does not come last"

    def take(self, key, at, value):
        if key == PRIMER:
            entries = elements(value)
            self.tags = {number(e[:2]): e[2:] for e in entries}
            assert len(self.tags) == len(entries) == len(set(self.tags.values()))
        elif key == RANDOM_INDEX:
            self.random_index = at, value
        elif key[:13] == PRIMER[:13] and 2 <= key[13] <= 4:
            self.kinds.append((key[13], key[14]))
            self.partitions.append(read_partition(at, value))
        elif key == INDEX:
            self.index.append(local_set(value, self.tags))
        elif key[:14] == SETS:
            self.sets.append((NAMES[key[14]], local_set(value, self.tags)))
        else:
            assert key == FILL or key[:12] == ELEMENT, f"key {key.hex()} at {at}"

    def of(self, name):
        return [items for kind, items in self.sets if kind == name]


def check_partitions(w, size):
    assert w.kinds == [(2, 4), (3, 4), (4, 4)], "header, body, footer, closed and complete"
    header, body, footer = w.partitions
    starts = [at for _, at, _ in w.klvs] + [size]
    for i, p in enumerate(w.partitions):
        assert p["previous"] == (w.partitions[i - 1]["this"] if i else 0)
        assert p["footer"] == footer["this"] and p["this"] % p["grid"] == 0
        assert p["containers"] == header["containers"] and p["pattern"] == header["pattern"]
        assert (p["major"], p["minor"], p["body_offset"]) == (1, 3, 0)
    first = next(at for key, at, _ in w.klvs if key == PRIMER)
    assert header["header_bytes"] == body["this"] - first
    index = next(at for key, at, _ in w.klvs if key == INDEX)
    at, value = w.random_index
    assert footer["index_bytes"] == at - index and at in starts
    assert [header["index_bytes"], body["index_bytes"], body["header_bytes"],
            footer["header_bytes"]] == [0] * 4
    assert number(value[-4:]) == size - at, "the random index pack's length"
    pairs = [(number(value[i:i + 4]), number(value[i + 4:i + 12]))
             for i in range(0, len(value) - 4, 12)]
    assert pairs == [(p["body_sid"], p["this"]) for p in w.partitions]


def check_references(w):
    uids = [items[0x3c0a] for _, items in w.sets]
    assert len(set(uids)) == len(uids), "two sets have one InstanceUID"
    wanted = []
    for _, items in w.sets:
        for tag, kind in STRONG.items():
            if tag in items:
                wanted += elements(items[tag]) if kind == 2 else [items[tag]]
    preface = w.of("preface")[0]
    assert sorted(wanted + [preface[0x3c0a]]) == sorted(uids), "sets and references to them"
    assert [e.hex() for e in elements(preface[0x3b0a])] == w.partitions[0]["containers"]
    assert preface[0x3b09].hex() == w.partitions[0]["pattern"]


def check_essence(w, raw):
    """Every edit unit has the same elements at the same places; returns the sizes of values."""
    begin, end = w.partitions[1]["this"], w.partitions[2]["this"]
    body = [k for k in w.klvs if begin <= k[1] < end][1:]
    if body[0][0] == FILL:
        body = body[1:]
    base, grid = body[0][1], w.partitions[1]["grid"]
    assert base % grid == 0
    index = w.index[0]
    unit, frames = number(index[0x3f05]), number(index[0x3f0d])
    deltas = [number(e[2:]) for e in elements(index[0x3f09])]
    assert base + unit * frames == end, "edit units and the body's size"
    found = [k for k in body if k[0] != FILL]
    assert len(found) == frames * len(deltas)
    keys = [k[0] for k in found[:len(deltas)]]
    sizes, put = [], 0
    for i, (key, at, value) in enumerate(found):
        frame, place = divmod(i, len(deltas))
        assert at == base + frame * unit + deltas[place] and at % grid == 0
        assert key == keys[place], "elements in another order"
        if raw is not None and place == 0:
            assert value == raw[put:put + len(value)], f"picture {frame} is another"
            put += len(value)
        sizes.append(len(value))
    assert raw is None or put == len(raw), "pictures and their bytes"
    assert index[0x3f06] == struct.pack(">I", w.partitions[2]["index_sid"])
    numbers = {number(t[0x4804]) for t in w.of("track")} - {0}
    assert numbers == {number(k[12:]) for k in keys}, "tracks and elements"
    return frames, len(deltas), sizes


def check_durations(w, frames):
    for name, tag in (("sequence", 0x0202), ("clip", 0x0202), ("timecode", 0x0202),
                      ("picture", 0x3002), ("sound", 0x3002), ("multiple", 0x3002)):
        assert all(number(items[tag]) == frames for items in w.of(name)), f"durations: {name}"


def ratio(b):
    return "%d/%d" % struct.unpack(">ii", b)


def describe(w, frames, count, sizes):
    picture, timecode = w.of("picture")[0], w.of("timecode")[0]
    own = {"layout": 0x320c, "stored_width": 0x3203, "stored_height": 0x3202,
           "sampled_width": 0x3205, "sampled_height": 0x3204, "display_width": 0x3209,
           "display_height": 0x3208, "dominance": 0x3212, "depth": 0x3301, "across": 0x3302,
           "down": 0x3308, "siting": 0x3303, "black": 0x3304, "white": 0x3305,
           "range": 0x3306, "standard": 0x3215}
    labels = {"coding": 0x3201, "container": 0x3004, "equations": 0x321a,
              "primaries": 0x3219, "transfer": 0x3210}
    d = {name: number(picture[tag]) for name, tag in own.items() if tag in picture}
    d.update({name: picture[tag].hex() for name, tag in labels.items() if tag in picture})
    d.update(frames=frames, rate=ratio(picture[0x3001]), aspect=ratio(picture[0x320e]),
             map=[number(e) for e in elements(picture[0x320d])], picture_bytes=sizes[0],
             start=number(timecode[0x1501]), base=number(timecode[0x1502]),
             drop=number(timecode[0x1503]), sound_tracks=count - 1,
             samples=[s // 3 for s in sizes[1::count]] if count > 1 else [],
             pattern=w.partitions[0]["pattern"], containers=w.partitions[0]["containers"])
    return d


def main():
    data = open(sys.argv[1], "rb").read()
    raw = open(sys.argv[3], "rb").read() if len(sys.argv) > 3 else None
    w = Walk(data)
    check_partitions(w, len(data))
    check_references(w)
    frames, count, sizes = check_essence(w, raw)
    check_durations(w, frames)
    d = describe(w, frames, count, sizes)
    print(json.dumps(d))
    if len(sys.argv) > 2 and not eval(sys.argv[2], {"d": d}):
        sys.exit("not so: " + sys.argv[2])


main()
