# shellcheck shell=bash
# What the scripts of this room share. Sourced after script.sh.

# Calls fail through a preloaded library, which has malloc in place of the C library's.
not_sanitized never
faults=$WEFT_BUILD/tests/libfaults.so

# campaign OPTION..: campaign.py in a folder of its own.
campaign() { python3 "$WEFT_SOURCE/tests/hard/campaign.py" --folder "$(mktemp -d -p "$work")/c" "$@"; }

# failing FAULT COMMAND..: a call of the command fails.
failing()
{
    local fault=$1
    shift
    LD_PRELOAD=$faults WEFT_FAULT=$fault "$@"
}

# every FAULT PATTERN COMMAND..: the fault at the first calls of its kind, one after the other, ends the command with status 1 and
# what matches, at least once, and never with anything else but success.
every()
{
    local fault=$1 pattern=$2 n got met=0
    shift 2
    for n in 1 2 3 4 5 6 7 8; do
        failing "$fault:$n" "$@" >out 2>said
        got=$?
        [ $got != 0 ] || continue
        met=1
        [ $got = 1 ] && grep -qi -- "$pattern" said out || { echo "$fault:$n: status $got"; cat said; return 1; }
    done
    [ $met = 1 ] || { echo "$fault was never met"; return 1; }
}
