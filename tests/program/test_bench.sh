#!/bin/bash
# The benchmark in small: counts and errors; at full length also ratios of things that took turns. No
# seconds.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized never
needs python3
export PYTHONDONTWRITEBYTECODE=1
parts=converter files="converter.csv table.md converter.svg"
is_long && parts=converter,tracer,targets files="$files tracer.csv carousel.svg zoneplate.svg"
check "benchmark" python3 "$WEFT_SOURCE/tests/bench/run.py" "$WEFT_BUILD" --small --out made --only $parts
for file in $files; do check "$file" test -s "made/$file"; done
finish
