#!/bin/bash
# Joins the N parts that chunk.sh made, once all are there. Takes what chunk.sh took, but I.
#
#   join.sh N OUTPUT INPUT... OPTION...
#
# Ends with 3 if weft did for a part: whole, but frames were held or mended.
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[ $# -ge 3 ] || die "usage: join.sh N OUTPUT INPUT... OPTION..." 2
join_parts "$@"
