#!/bin/bash
# OpenColorIO configurations that would end the process, never end, or be black without a word: each is refused within seconds.
. "$WEFT_SOURCE/tests/program/script.sh"
[ -n "$(find "$WEFT_BUILD" -maxdepth 4 -name weft-ocio.so -print -quit)" ] || skip "weft was built without OpenColorIO"
check "a picture" exits 0 weft trace "$WEFT_SOURCE/examples/scenes/carousel.lua" --raster 8x8@24p --samples 1 --frames 0 \
    --oversample 1x1x1 -q -o in.####.exr
python3 - <<'END'
HEAD = """ocio_profile_version: 2
roles: {scene_linear: lin, default: lin, data: lin}
file_rules:
  - !<Rule> {name: Default, colorspace: lin}
displays:
  d:
    - !<View> {name: v, colorspace: out}
    - !<View> {name: w, colorspace: lin, looks: round}
looks:
  - !<Look> {name: round, process_space: lin, transform: !<LookTransform> {src: lin, dst: lin, looks: round}}
colorspaces:
  - !<ColorSpace> {name: lin}
"""
SPACE = "  - !<ColorSpace>\n    name: %s\n    from_scene_reference: %s\n"
FINE = "!<MatrixTransform> {matrix: [.5,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}"


def write(name, *spaces):
    with open(name + ".ocio", "w", encoding="ascii") as file:
        file.write(HEAD + "".join(SPACE % space for space in spaces))


def group(*names):
    children = "".join("\n        - !<ColorSpaceTransform> {src: lin, dst: %s}" % name for name in names)
    return "!<GroupTransform>\n      children:" + children


write("fine", ("out", FINE))
write("itself", ("out", "!<ColorSpaceTransform> {src: lin, dst: out}"))
write("circle", ("out", group("a")), ("a", group("b")), ("b", "!<ColorSpaceTransform> {src: out, dst: lin}"))
write("alias", ("out", "!<ColorSpaceTransform> {src: lin, dst: other}\n    aliases: [other]"))
write("display", ("out", "!<DisplayViewTransform> {src: lin, display: d, view: v}"))
write("doubles", ("out", group("s0", "s0")), *((f"s{i}", group(f"s{i + 1}", f"s{i + 1}")) for i in range(40)), ("s40", FINE))
write("fans", ("out", group(*["s0"] * 200)), ("s0", group(*["s1"] * 200)), ("s1", FINE))
write("deep", ("out", group("s0")), *((f"s{i}", group(f"s{i + 1}")) for i in range(3000)), ("s3000", FINE))
write("endless_file", ("out", "!<FileTransform> {src: /dev/zero}"))
write("pipe_file", ("out", "!<FileTransform> {src: fifo.spi1d}"))
write("nan", ("out", "!<MatrixTransform> {matrix: [.nan,0,0,0, 0,.nan,0,0, 0,0,.nan,0, 0,0,0,1]}"))
write("inf", ("out", "!<MatrixTransform> {matrix: [.inf,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}"))
names = "\n        - &a0 " + FINE + "".join(f"\n        - &a{i + 1} !<GroupTransform> {{children: [*a{i}, *a{i}]}}" for i in range(30))
write("yaml", ("out", "!<GroupTransform>\n      children:" + names))
for name, text in (("brackets", "[" * 100000), ("braces", "{a: " * 100000)):
    with open(name + ".ocio", "w", encoding="ascii") as file:
        file.write(HEAD + "more: " + text)
END
mkfifo fifo.spi1d fifo.ocio

# refused NAME TEXT [OPTION..]: within ten seconds, in 4 GB, with the text.
refused()
{
    local name=$1 text=$2
    shift 2
    (is_sanitized || ulimit -v 4000000
     timeout 10 "$WEFT" convert in.####.exr --subframe-rate 24 --raster 8x8@24p -q --ocio "$name" --from lin "$@" -o o.y4m) >out 2>said
    [ $? = 2 ] && says "$text" && [ ! -e o.y4m ] || { echo "$name"; cat said; return 1; }
}

check "a fine one" exits 0 weft convert in.####.exr --subframe-rate 24 --raster 8x8@24p -q --ocio fine.ocio --from lin --to out -o fine.y4m
while read -r name text; do
    check "$name" refused "$name.ocio" "$text" --to out
done <<'END'
itself "out" is made of itself
circle "out" is made of itself
alias "out" is made of itself
display "out" is made of itself
doubles "out" is made of more than 10000 steps
fans "out" is made of more than 10000 steps
deep is made of too many others
endless_file "/dev/zero" is no regular file
pipe_file is no regular file
nan "out" gives no numbers for plain colors
inf "out" gives no numbers for plain colors
yaml it names 60 things of YAML again
brackets brackets.ocio
braces braces.ocio
fifo is no regular file
END
check "a view" refused itself.ocio '"out" is made of itself' --display d --view v
check "a look that is made of itself" refused fine.ocio '"round" is made of itself' --display d --view w
check "a look by itself" refused fine.ocio '"round" is made of itself' --to out --look round
check "a device" refused /dev/zero "no regular file" --to out
check "the configuration of the environment" exits 2 env OCIO=/dev/zero "$WEFT" convert in.####.exr \
    --subframe-rate 24 --raster 8x8@24p -q --from lin --to out -o o.y4m
finish
