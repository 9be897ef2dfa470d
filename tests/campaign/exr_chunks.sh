#!/bin/bash
# 100,000 mutations each of PIZ and of DWA chunks of EXR, and of the other compressions that weft decodes itself, through the
# decoders of the build with sanitizers: no fault, none over 10 s, none with 512 MB. COUNT and SEED are its arguments.
set -eu
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
fuzz=${WEFT_FUZZ_EXR_CHUNKS:-$source_dir/build-sanitize/tests/fuzz-exr_chunks}
[ -x "$fuzz" ] || { echo "skipped: no $fuzz; tests/run.sh sanitize builds it"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
faults=0
for kind in piz dwa rle zip pxr24; do
    mkdir "$work/$kind"
    if WEFT_FUZZ_CHUNK=$kind "$fuzz" -runs="${1:-100000}" -seed="${2:-1}" -timeout=10 -rss_limit_mb=512 -max_len=8192 \
        -artifact_prefix="$work/" -print_final_stats=1 "$work/$kind" "$source_dir/tests/fuzz/corpus/exr_chunks" \
        >"$work/log" 2>&1; then
        echo "$kind: $(sed -n 's/^stat::number_of_executed_units: //p' "$work/log") chunks, 0 faults"
    else
        faults=1
        echo "$kind: a fault:"
        tail -n 40 "$work/log"
    fi
done
exit "$faults"
