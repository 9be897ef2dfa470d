# shellcheck shell=bash disable=SC2034
# What the test scripts share. Sourced first, it moves to a directory that is removed at the end;
# `finish` is the last command of a script.
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
export NO_COLOR=1
unset OCIO
passed=0 failed=0 skipped=0

weft() { timeout 250 "$WEFT" "$@"; }

# ---- Which tests run ----

# The full sizes are asked for (`tests/run.sh all`); otherwise a script takes at most 20 seconds.
is_long() { [ -n "${WEFT_LONG:-}" ]; }

# The program is instrumented, which takes ten times as long.
is_sanitized() { [ -n "${WEFT_SANITIZE:-}" ]; }

# skip REASON: ends the script, as one that could not run.
skip() { echo "skipped: $1"; exit 77; }

# skip_part REASON: a part of the script does not run.
skip_part() { skipped=$((skipped + 1)); echo "skipped: $1"; }

# not_sanitized WHY: under the sanitizers the script runs at full length only, or `never`.
not_sanitized()
{
    is_sanitized || return 0
    is_long && [ "$1" != never ] || skip "an ordinary build does this; under sanitizers: $1"
}

# needs PROGRAM..: the script cannot do without.
needs()
{
    local program
    for program; do command -v "$program" >/dev/null || skip "no $program"; done
}

# has PROGRAM: it is there; what needs it is skipped otherwise.
has() { command -v "$1" >/dev/null || { skip_part "no $1"; return 1; }; }

# has_module NAME: it was built; needs_module NAME..: the script cannot do without.
has_module() { [ -n "$(find "$WEFT_BUILD" -maxdepth 4 -name "weft-$1.so" -print -quit)" ]; }
needs_module()
{
    local module
    for module; do has_module "$module" || skip "weft was built without its module $module"; done
}

# has_libav: the module that reads and writes containers was built; needs_libav: the script wants it.
has_libav() { has_module libav; }
needs_libav() { has_libav || skip "weft was built without libav"; }

# is_absent: what was said last is that weft was built without a library.
is_absent() { grep -qs "which this weft was built without" said; }

# has_terminal: pseudo-terminals can be made; a bare root directory has none.
has_terminal()
{
    [ -c /dev/ptmx ] && python3 -c 'import pty; pty.openpty()' 2>/dev/null ||
        { skip_part "no pseudo-terminals (/dev/ptmx, /dev/pts)"; return 1; }
}

# ---- What is checked ----

# check NAME COMMAND..: the command must succeed.
check()
{
    local name=$1
    shift
    if "$@"; then
        passed=$((passed + 1))
    elif is_absent; then
        skip_part "$name: $(grep -m 1 "built without" said)"
    else
        failed=$((failed + 1)) && echo "FAILED: $name"
    fi
}

# exits CODE COMMAND..: the command must end with this status; what it writes goes to `out` and
# `said`.
exits()
{
    local code=$1 got
    shift
    "$@" >out 2>said
    got=$?
    [ $got = "$code" ] || { echo "status $got, not $code: $*"; cat said; return 1; }
}

# says TEXT, prints TEXT: the last `exits` did, on standard error or standard output.
says() { grep -qiF -- "$1" said || { echo "not said: $1"; cat said; return 1; }; }
prints() { grep -qF -- "$1" out || { echo "not printed: $1"; cat out; return 1; }; }

# refuses TEXT ARGUMENT..: weft ends with status 2, says one line with the text and prints nothing.
refuses()
{
    local text=$1
    shift
    exits 2 weft "$@" && says "$text" && [ ! -s out ] && [ "$(wc -l <said)" = 1 ]
}

# fails PATTERN COMMAND..: the command ends with status 1 and says what matches.
fails()
{
    local pattern=$1
    shift
    exits 1 "$@" && { grep -qi -- "$pattern" said || { echo "not said: $pattern"; cat said; return 1; }; }
}

# shows TEXT ARGUMENT..: weft ends with status 0, prints the text and says nothing.
shows()
{
    local text=$1
    shift
    exits 0 weft "$@" && prints "$text" && [ ! -s said ]
}

# value EXPRESSION: true of the JSON in `out`, called d.
value()
{
    python3 -c "import json, math, sys; d = json.load(open('out')); sys.exit(not ($1))" ||
        { echo "not so: $1"; cat out; return 1; }
}

# verdict FILE WORD [OPTION..]: `weft measure` has this word on the order.
verdict()
{
    local file=$1 word=$2
    shift 2
    exits 0 weft measure "$file" --json "$@" && value "d['order']['verdict'] == '$word'"
}

# json: `out` is JSON. png FILE: it is a whole PNG picture.
json() { python3 -m json.tool <out >/dev/null; }
png() { [ "$(head -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] && tail -c 8 "$1" | grep -q IEND; }

# same WORDS WORDS: they are equal.
same() { [ "$1" = "$2" ] || { echo "'$1', not '$2'"; return 1; }; }

# interrupted SIGNAL CODE DELAY COMMAND..: sent the signal after DELAY seconds, the command ends
# within two seconds with this status, and the folder `left`, into which it writes, is empty.
interrupted()
{
    local signal=$1 code=$2 delay=$3 pid began took got
    shift 3
    mkdir -p left
    "$@" <&0 2>said &
    pid=$!
    sleep "$delay"
    kill -0 $pid || { echo "it was done before it could be interrupted"; return 1; }
    began=$(date +%s%N)
    kill -s "$signal" $pid
    wait $pid
    got=$?
    took=$(($(date +%s%N) - began))
    [ $got = "$code" ] || { echo "status $got, not $code"; cat said; return 1; }
    [ $took -lt 2000000000 ] || { echo "it took $took ns"; return 1; }
    [ -z "$(ls -A left)" ] || { ls -A left; return 1; }
}

# ---- What is tried ----

# subframes FOLDER COUNT: the first of the subframes that examples/make_subframes.c makes, as links
# to files that the first script to ask makes for all of them.
subframes()
{
    local made=$WEFT_BUILD/tests/subframes k
    mkdir -p "$made"
    (
        flock 9
        [ "$made/done" -nt "$WEFT_BUILD/make_subframes" ] ||
            { "$WEFT_BUILD/make_subframes" "$made" 96 && touch "$made/done"; }
    ) 9>"$made/lock" || exit 1
    mkdir -p "$1"
    for ((k = 0; k < $2; k++)); do
        printf -v k_name 'subframe.%04d.exr' "$k"
        ln -s "$made/$k_name" "$1/$k_name"
    done
}

# made OUTPUT OPTION..: the moving subframes in the folder `in` become a file, 400 of them a second.
made()
{
    local output=$1
    shift
    exits 0 weft convert in --subframe-rate 400 --aperture box --temporal-width 0 -q -o "$output" "$@"
}

# clip OUTPUT RATE RASTER: the subframes in the folder `in`, RATE a second, as video.
clip()
{
    "$WEFT" convert in --subframe-rate "$2" --raster "$3" --aperture box --temporal-width 0 --fit stretch \
        --overwrite -q -o "$1"
}

# quiet_ffmpeg OPTION..: ffmpeg, which asks nothing and says errors only.
quiet_ffmpeg() { ffmpeg -nostdin -v error -y "$@"; }

# stream FILE KEYS: what ffprobe says of the picture.
stream() { ffprobe -v error -select_streams v -show_entries "$2" -of csv=p=0 "$1"; }

# ---- weft verify ----

# right FILE [OPTION..]: nothing is wrong with it.
right() { exits 0 weft verify "$@"; }

# only CHECK FILE [OPTION..]: it is wrong, this is why, and what demands it is said.
only()
{
    local name=$1
    shift
    exits 1 weft verify --json "$@" || return 1
    python3 - "$name" <<'END'
import json, sys
found = json.load(open("out"))[0]
wrong = [c for c in found["checks"] if c["verdict"] == "wrong"]
if [c["check"] for c in wrong] != [sys.argv[1]] or found["right"] or not wrong[0]["should"] or not wrong[0]["by"]:
    sys.exit(f"not {sys.argv[1]} alone: {wrong}")
END
}

# patched FROM TO KIND NAME OFFSET BYTES
patched() { python3 "$WEFT_SOURCE/tests/verify/patch_delivery.py" "$@"; }

# wrong CHECK FROM KIND NAME OFFSET BYTES [OPTION..]: with bytes written over it fails this check alone.
wrong()
{
    local name=$1 from=$2 to=patched.${2##*.}
    patched "$from" "$to" "$3" "$4" "$5" "$6" || return 1
    shift 6
    only "$name" "$to" "$@"
}

# ---- The end ----

finish()
{
    echo "$passed passed, $failed failed, $skipped skipped"
    [ $failed = 0 ]
}
