# shellcheck shell=bash
# The lines of README.md and the three guides as a new user types them, with the weft that is installed.
# Sourced by a script of bash in a folder with: examples (the guides' own), out/subframes, and ffmpeg and
# oiiotool. `make_files` makes what the lines read; `try_guides` runs them and fails if one did.
set -u

# ---- What the lines read ----

make_files()
{
    mkdir -p files/DIR files/shot plain
    cd files || return 1
    ln -s ../examples ../out .
    # A shot of 480 subframes a second: color with alpha, and a layer of its own.
    ffmpeg -nostdin -v error -f lavfi -i testsrc2=s=180x122:r=480:d=0.2 -pix_fmt gbrpf32le ../plain/shot.%04d.exr
    oiiotool --frames 1-96 ../plain/shot.%04d.exr --ch R,G,B,A=1.0 --dup --ch R,G,B --chnames diffuse.R,diffuse.G,diffuse.B \
        --chappend -o shot/shot.%04d.exr
    ffmpeg -nostdin -v error -f lavfi -i testsrc2=s=180x122:r=240:d=0.2 shot.%04d.png
    cp shot/shot.00[0-3]?.exr .
    oiiotool shot/shot.0042.exr --resize 1920x1080 -o DIR/shot.0042.exr
    cp examples/scenes/carousel.lua .
    ln -s out/subframes shots
    ffmpeg -nostdin -v error -f lavfi -i testsrc2=s=640x360:r=50:d=1 -f lavfi -i sine=sample_rate=48000:d=1 -c:v mpeg4 capture.mp4
    ln -s capture.mp4 IN
    ffmpeg -nostdin -v error -f lavfi -i sine=sample_rate=8000:d=3640 -c:a pcm_u8 mix.wav
    cat >titles.lua <<'LUA'
background{0, 0, 0, alpha=0}
camera{eye={0, 1, -5}, look_at={0, 0, 0}}
duration(0.04)
add(sphere{radius=1}:material{unlit=true, color=1})
LUA
    ffmpeg -nostdin -v error -i capture.mp4 -c:v mjpeg -c:a pcm_s16le shot.mov
    # What `weft verify` reads has the same name.
    weft convert shot --subframe-rate 480 --raster 525i --legalize r103 --audio silent:2 -q -o ../plain/shot.mov
    weft convert shot --subframe-rate 480 --raster 1080i50 --legalize r103 --audio silent:8 -q -o shot.mxf
    weft convert shot --subframe-rate 480 --raster 1080i50 --aperture shaped --flicker-limit 0.01 -q -o delivery.mov
    weft render examples/scenes/carousel.lua --frames 0-9 --samples 4 -q -o carousel.y4m
    ffmpeg -nostdin -v error -i carousel.y4m -c:v prores_ks -flags +ildct coded.mov
    cd ..
}

# ---- The lines ----

# lines_of FILE: its commands; those that go on are joined. Lines from other programs and through ffmpeg
# have tests of their own, with what these programs write.
lines_of()
{
    sed '/^## From other programs/,/^## /{/^    /d}' "$1" | sed -e ':join' -e '/\\$/{N;s/\\\n *//;b join}' |
        sed -n 's/^    \(weft \|examples\/stamp\)/\1/p' | grep -v '| ffmpeg' | sed 's/  *# .*//'
}

# runs LINE: in a folder of its own, in which what it writes is not there yet.
runs()
{
    local line=$1 made code
    rm -rf here && cp -as "$PWD/files" here
    rm here/DIR/shot.0042.exr && cp files/DIR/shot.0042.exr here/DIR # stamp_exr.py writes to it
    for made in $(grep -oE -- '(-o|--key|--heatmap|--report|--plot) [^ ]+' <<<"$line" | cut -d ' ' -f 2); do rm -f "here/$made"; done
    case $line in "weft verify"*) ln -sf "$PWD/plain/shot.mov" here ;; esac
    (cd here && eval "$line") >output 2>&1 </dev/null
    code=$?
    tried=$((tried + 1))
    [ $code = 0 ] && return
    echo "FAILED ($code): $line"
    tail -n 5 output
    failed=$((failed + 1))
}

# may_run LINE: what it wants besides is there.
may_run()
{
    case $1 in
    *studio.ocio*) [ -e files/studio.ocio ] || { echo "skipped, no OpenColorIO configuration: $1"; return 1; } ;;
    esac
}

# block LANGUAGE FILE: the first code of this language.
block() { sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/p" "$2" | sed '/^```/d'; }

# try_guides README: all of them.
try_guides()
{
    local page line
    tried=0 failed=0
    make_files || return 1
    for page in "$1" examples/guides/{td,artist,scripter}.md; do
        echo "-- $page"
        while IFS= read -r line; do may_run "$line" && runs "$line"; done < <(lines_of "$page")
    done
    block c "$1" >files/shot.c
    runs "$(grep '^ *cc shot.c ' "$1") && ./a.out"
    block c examples/guides/scripter.md >files/ask.c
    # shellcheck disable=SC2016
    runs 'cc ask.c -o ask $(pkg-config --cflags --libs weft) && weft convert out/subframes --raster 36x24@30i,tff -o b.y4m && ./ask b.y4m'
    block python "$1" >files/shot.py
    runs "python3 shot.py"
    block python examples/guides/scripter.md >files/session.txt
    runs "python3 -m doctest -o ELLIPSIS session.txt"
    echo "$tried lines of the guides ran, $failed failed"
    [ $failed = 0 ] && [ $tried -gt 30 ]
}
