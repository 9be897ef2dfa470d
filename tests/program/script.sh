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

# check NAME COMMAND..: the command must succeed.
check()
{
    local name=$1
    shift
    if "$@"; then passed=$((passed + 1)); else failed=$((failed + 1)); echo "FAILED: $name"; fi
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

# has PROGRAM: it is there; what needs it is skipped otherwise.
has() { command -v "$1" >/dev/null || { skipped=$((skipped + 1)); echo "skipped: no $1"; return 1; }; }

# value EXPRESSION: true of the JSON in `out`, called d.
value()
{
    python3 -c "import json, math, sys; d = json.load(open('out')); sys.exit(not ($1))" ||
        { echo "not so: $1"; cat out; return 1; }
}

finish()
{
    echo "$passed passed, $failed failed, $skipped skipped"
    [ $failed = 0 ]
}
