#!/bin/bash
# The benchmark in small: counts, and ratios of things that took turns; no seconds.
set -u
[ -z "${WEFT_SANITIZE:-}" ] || { echo "skipped: sanitizers change what takes how long"; exit 77; }
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
export PYTHONDONTWRITEBYTECODE=1
python3 "$WEFT_SOURCE/tests/bench/run.py" "$WEFT_BUILD" --small --out "$out" \
    --only converter,tracer,targets || exit 1
for file in converter.csv tracer.csv table.md converter.svg carousel.svg zoneplate.svg; do
    [ -s "$out/$file" ] || { echo "FAILED: no $file"; exit 1; }
done
