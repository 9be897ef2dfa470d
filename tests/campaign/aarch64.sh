#!/bin/bash
# weft for 64-bit Arm: built by Debian's cross compiler in a bare Debian 12, its unit tests run by qemu, and
# what it makes compared, byte for byte, with what the program of $WEFT_BUILD (build/) makes here. The modules
# plot and, of libav, none are among it. Wants root, and a mirror of Debian; $AARCH64_ROOT keeps the root.
set -eu
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
. "$source_dir/tests/campaign/root.bash"
wants_root
native=${WEFT_BUILD:-$source_dir/build}/weft
jobs=${AARCH64_JOBS:-$(nproc)}
libraries=(libopenexr-dev libdeflate-dev libxxhash-dev liblua5.4-dev libjansson-dev libcmocka-dev libcairo2-dev libgomp1)
make_root "${AARCH64_ROOT:-}" --architectures=amd64,arm64 --include="$(IFS=,; echo \
    "gcc-aarch64-linux-gnu,g++-aarch64-linux-gnu,cmake,ninja-build,pkg-config,qemu-user-static,${libraries[*]/%/:arm64}")"
put_source
in_root <<END
set -eu
cd /weft
cmake -S . -B build -G Ninja -DBUILD_TESTING=ON --toolchain tests/campaign/aarch64.cmake
cmake --build build -j $jobs
file=\$(head -c 20 build/weft | od -An -tx1 | tr -d ' \n')
[ "\${file:36:4}" = b700 ] || { echo "build/weft is not for aarch64"; exit 1; }
# A test that looks at time or at how fast the machine is has no meaning under emulation.
TMPDIR=/tmp ctest --test-dir build -L program -j $jobs --output-on-failure
END

# ---- The same numbers ----

# jobs PROGRAM..: runs in a folder and leaves what it makes.
make_outputs()
{
    local scene
    for scene in carousel csg_grid slow_edges zoneplate; do
        "$@" render "scenes/$scene.lua" --raster 90x62@29.97i,bff --frames 0-1 --samples 4 -q -o "$scene.y4m"
    done
    "$@" trace scenes/carousel.lua --raster 48x32@30i,tff --samples 1 --frames 0-3 --oversample 2x2x4 -q -o sub.####.exr
    "$@" convert sub.####.exr --raster 48x32@30i,tff -q -o sub.y4m
    "$@" convert sub.####.exr --raster 48x32@30i,tff --flicker-limit .02 -q -o limit.y4m
    "$@" convert sub.####.exr --raster 48x32@30i,tff --aperture least:4 -q -o least.####.png
    "$@" measure carousel.y4m --json >measure.json
    "$@" filters --json >filters.json
}
mkdir -p "$root/outputs/arm" "$root/outputs/here"
for folder in arm here; do cp -r "$source_dir/examples/scenes" "$root/outputs/$folder"; done
(cd "$root/outputs/here" && make_outputs "$native")
{ declare -f make_outputs; echo 'cd /outputs/arm; set -e; make_outputs qemu-aarch64-static /weft/build/weft'; } | in_root
diff -rq "$root/outputs/here" "$root/outputs/arm"
echo "$(find "$root/outputs/here" -maxdepth 1 -type f | wc -l) files are the same, byte for byte"
