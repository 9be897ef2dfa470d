"""Live use: pictures go in one by one, and it is timed when each frame comes out.

live.py delay WEFT PICTURES OPTION..  gives a picture when every frame that the ones before it complete is out,
    and prints by how many pictures the latest frame missed that; none misses it where weft waits for nothing.
live.py pace WEFT PICTURES OPTION..   gives pictures at their rate and prints, of the frames, the milliseconds
    from the picture that completes a frame to the frame's last byte: median, 99 % and most; and what a frame took of
    the processor.
"""
import json
import os
import resource
import subprocess
import sys
import threading
import time

WIDTH, HEIGHT, RATE = 1920, 1080, 50
FRAME_BYTES = 6 + WIDTH * HEIGHT * 4  # 4:2:2, two bytes a sample, behind "FRAME\n"
COMPLETES = 2  # a picture lasts until the next begins: picture 2n + 2 completes frame n of 2n and 2n + 1


class Clip:
    """Noise over bars that move, in few pictures that repeat."""

    def __init__(self):
        self.header = b"YUV4MPEG2 W%d H%d F%d:1 Ip A1:1 C420 XCOLORRANGE=LIMITED\n" % (WIDTH, HEIGHT, RATE)
        noise = os.urandom(WIDTH * HEIGHT + 64)
        luma = [bytes(16 + b % 200 for b in noise[k:k + WIDTH]) for k in range(64)]
        self.pictures = []
        for k in range(8):
            rows = b"".join(luma[(y + 5 * k) % 64] for y in range(HEIGHT))
            self.pictures.append(b"FRAME\n" + rows + b"\x80" * (WIDTH * HEIGHT // 2))

    def picture(self, number):
        return self.pictures[number % len(self.pictures)]


class Converter:
    """weft in a pipe, whose frames are counted, and timed at their last byte, by a thread."""

    def __init__(self, weft, options):
        command = [weft, "convert", "-", "-o", "-", "--raster", "1080i50", "--from", "rec709", "-q", *options]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.out = []  # when each frame was out
        self.more = threading.Condition()
        self.reader = threading.Thread(target=self.count)
        self.reader.start()

    def count(self):
        out = self.process.stdout
        out.readline()
        while len(out.read(FRAME_BYTES)) == FRAME_BYTES:
            with self.more:
                self.out.append(time.monotonic())
                self.more.notify()

    def give(self, data):
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def wait(self, frames, seconds):
        """Until so many frames are out, or the time is; how many are."""
        with self.more:
            self.more.wait_for(lambda: len(self.out) >= frames, seconds)
            return len(self.out)

    def end(self):
        self.process.stdin.close()
        self.reader.join()
        return self.process.wait()


def delay(converter, clip, pictures):
    """By how many pictures the latest frame came later than it could."""
    worst = 0
    for number in range(pictures):
        converter.give(clip.picture(number))
        due = number // COMPLETES
        out = converter.wait(due, .2 if worst else 5)  # one that is late comes late always
        worst = max(worst, COMPLETES * (due - out))
    converter.end()
    return {"late_pictures": worst}


def pace(converter, clip, pictures):
    """The first tenth, in which weft makes its tables, is not counted."""
    begin, given = time.monotonic(), []
    for number in range(pictures):
        time.sleep(max(0, begin + number / RATE - time.monotonic()))
        converter.give(clip.picture(number))
        given.append(time.monotonic())
    converter.end()
    frames = range(pictures // COMPLETES // 10, (pictures - 1) // COMPLETES)
    late = sorted(1000 * (converter.out[n] - given[COMPLETES * (n + 1)]) for n in frames)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu_ms = 1000 * (used.ru_utime + used.ru_stime) / len(converter.out)
    return {"cpu_ms": cpu_ms, "median_ms": late[len(late) // 2], "p99_ms": late[int(.99 * len(late))], "most_ms": late[-1]}


def main():
    way, weft, pictures, *options = sys.argv[1:]
    clip, converter = Clip(), Converter(weft, options)
    converter.give(clip.header)
    found = {"delay": delay, "pace": pace}[way](converter, clip, int(pictures))
    print(json.dumps({"frames": len(converter.out)} | {key: round(value, 2) for key, value in found.items()}))
    sys.exit(converter.process.wait())


main()
