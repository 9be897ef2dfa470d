#!/bin/sh
# Runs one test with what every test may count on: WEFT_SHARED (sample data, which may be absent)
# and TMPDIR, a scratch directory of its own that is removed afterwards.
WEFT_SHARED=${WEFT_SHARED:-$WEFT_SOURCE/../shared}
TMPDIR=$(mktemp -d "${TMPDIR:-/tmp}/weft-test.XXXXXX") || exit 1
export WEFT_SHARED TMPDIR
trap 'chmod -R u+w "$TMPDIR"; rm -rf "$TMPDIR"' EXIT
trap 'exit 130' INT TERM
"$@"
