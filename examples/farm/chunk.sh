#!/bin/bash
# Makes part I of the N parts of a conversion, or what is missing of it.
#
#   chunk.sh I N OUTPUT INPUT... OPTION...
#
# stands for `weft convert INPUT... OPTION... --chunk I/N -o OUTPUT`. Parts of a picture sequence
# are its frames; parts of Y4M, v210 and uyvy wait in OUTPUT.parts for join.sh.
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[ $# -ge 4 ] || die "usage: chunk.sh I N OUTPUT INPUT... OPTION..." 2
make_part "$@"
