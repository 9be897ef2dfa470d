#!/bin/bash
# Rounds of jobs in one Python, whose memory does not grow; more of them: tests/campaign/soak.sh.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized never
bash "$WEFT_SOURCE/tests/campaign/soak.sh" 24
code=$?
[ $code != 77 ] || skip "no Python with NumPy"
check "memory is flat" test $code = 0
finish
