#!/bin/bash
# The commands by calls from Python: the examples of the package's documentation, what the program says of
# the same, arrays in and out, errors that are raised in silence.
. "$WEFT_SOURCE/tests/program/script.sh"
python=
for candidate in /usr/bin/python3 python3; do
    "$candidate" -c 'import numpy' 2>/dev/null && python=$candidate && break
done
[ -n "$python" ] || skip "no Python with NumPy (package python3-numpy)"
not_sanitized "test_python.sh"
export PYTHONDONTWRITEBYTECODE=1 WEFT PYTHONPATH=$WEFT_BUILD/lib/python3/dist-packages
unset WEFT_LIBRARY
tests=$WEFT_SOURCE/tests/library

check "examples in the documentation" exits 0 "$python" "$tests/doctests.py" "$WEFT_SOURCE/examples/scenes/carousel.lua"
tail -n 1 out
check "calls" exits 0 "$python" "$tests/calls.py"
grep -E '^Ran' said
finish
