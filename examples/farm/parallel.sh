#!/bin/bash
# Converts with GNU parallel, on this machine or several: N parts, then joined.
#
#   parallel.sh N OUTPUT INPUT... OPTION...
#
# A part that fails is tried three times. Run again after a failure it does only what is missing.
# On this machine alone weft uses all processors by itself; this is for machines that share a
# directory: PARALLEL='--sshlogin a,b,c --workdir .' (the scripts and weft at the same place on all).
farm=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$farm/common.sh"
[ $# -ge 3 ] || die "usage: parallel.sh N OUTPUT INPUT... OPTION..." 2
[[ $* != *[{}]* ]] || die "GNU parallel takes braces for its own: rename what has them" 2
begin "$@"
export WEFT=${WEFT:-weft} WEFT_THREADS=${WEFT_THREADS:-1}

mapfile -t numbers < <(seq "$1")
parallel --quote --retries 3 --line-buffer --tagstring "part {}" --env WEFT --env WEFT_THREADS \
    "$farm/chunk.sh" {} "$@" ::: "${numbers[@]}" || die "parts failed, as told above; mend that and run this again" 1
"$farm/join.sh" "$@"
