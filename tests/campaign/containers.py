#!/usr/bin/env python3
"""containers.py WEFT FOLDER COUNT SEED: mutations of the containers in FOLDER through `weft verify` and `weft measure`, COUNT
of each together. WEFT is built with the sanitizers, and none of it may say anything or die. What does is kept in
`found`; the exit code says whether there is any."""
import os
import random
import subprocess
import sys

BATCH = 40
weft, folder, count, seed = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
rng = random.Random(seed)
seeds = sorted(os.path.join(folder, name) for name in os.listdir(folder))
ODD = [0, 1, 0x7F, 0x80, 0xFF, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0xFFFFFFFF, 0x7FFFFFFFFFFFFFFF, 0xFFFFFFFFFFFFFFFF]


def place(data):
    """Mostly in headers, which are at either end."""
    n = len(data)
    if rng.random() < 0.4:
        return rng.randrange(n)
    near = int(rng.random() ** 3 * min(n, 8192))
    return min(n - 1, near) if rng.random() < 0.7 else max(0, n - 1 - near)


def mutate(data):
    data = bytearray(data)
    for _ in range(rng.choice([1, 1, 2, 3, 5, 8])):
        at, kind = place(data), rng.randrange(6)
        if kind == 0:
            data[at] = rng.randrange(256)
        elif kind == 1:
            data[at] ^= 1 << rng.randrange(8)
        elif kind == 2:
            size = rng.choice([1, 2, 4, 8])
            value = rng.choice(ODD) & (1 << 8 * size) - 1
            data[at : at + size] = value.to_bytes(size, rng.choice(["big", "little"]))
        elif kind == 3:
            del data[at : at + rng.choice([1, 2, 4, 8, 16, 200])]
        elif kind == 4:
            from_ = place(data)
            data[at:at] = data[from_ : from_ + rng.choice([1, 4, 8, 64])]
        elif rng.random() < 0.3:
            del data[at:]
        if len(data) < 2:
            data += b"\0\0"
    return bytes(data)


def run(command, files):
    limit = "exec timeout 120 \"$@\""
    env = dict(os.environ, ASAN_OPTIONS="detect_leaks=0:abort_on_error=0:exitcode=99:allocator_may_return_null=1",
               UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1:exitcode=98")
    done = subprocess.run(["bash", "-c", limit, "bash", weft, command, "--json", "--progress", "none", *files],
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, env=env)
    text = done.stderr.decode(errors="replace")
    clean = done.returncode in (0, 1) and "runtime error" not in text and "Sanitizer" not in text
    return clean, done.returncode, text


for command in ("verify", "measure"):
    clean, code, text = run(command, seeds)
    if not clean:
        sys.exit(f"the seeds themselves, {command}: status {code}\n{text[-1500:]}")
made, bad, number = 0, 0, 0
os.makedirs("found", exist_ok=True)
while made < count:
    files = []
    for _ in range(min(BATCH, count - made)):
        source = rng.choice(seeds)
        name = f"m{number}{os.path.splitext(source)[1]}"
        number += 1
        with open(name, "wb") as out:
            out.write(mutate(open(source, "rb").read()))
        files.append(name)
    for command in ("verify", "measure"):
        clean, code, _ = run(command, files)
        for name in [] if clean else files:
            alone, code, text = run(command, [name])
            if not alone:
                bad += 1
                os.system(f"cp {name} found/{seed}.{command}.{name}")
                print(f"{command} {name}: status {code}\n{text[-1500:]}", flush=True)
    made += len(files)
    for name in files:
        os.remove(name)
    if made % 1000 < BATCH:
        print(f"{made} mutations, {bad} found", flush=True)
print(f"{made} mutations of {len(seeds)} files, {bad} found")
sys.exit(bad > 0)
