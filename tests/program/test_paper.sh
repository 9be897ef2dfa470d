#!/bin/bash
# The page of examples/paper: built quickly, read as text, and looked at in headless Chromium.
set -u
paper=$WEFT_SOURCE/examples/paper
tests=$WEFT_SOURCE/tests

[ -z "${WEFT_SANITIZE:-}" ] || { echo "skipped: renders too much for the sanitizers"; exit 77; }
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
    { echo "skipped: no chromium"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# A program that lacks a command ends the build, says which, and leaves no page.
printf '#!/bin/sh\n[ "$1" != render ] || { echo "no such command" >&2; exit 2; }\nexec "%s" "$@"\n' \
    "$WEFT" >"$work/lame"
chmod +x "$work/lame"
if WEFT=$work/lame "$paper/run.sh" --quick -o "$work/none" 2>"$work/said"; then
    echo "FAILED: a page without renders"
    exit 1
fi
if ! grep -q 'weft render .*' "$work/said" || ! grep -q 'no such command' "$work/said" ||
    [ -e "$work/none/index.html" ]; then
    echo "FAILED: what was wrong is not said:"
    cat "$work/said"
    exit 1
fi

WEFT=$WEFT "$paper/run.sh" --quick -o "$work/page" || { echo "FAILED: no page"; exit 1; }
python3 -B "$tests/program/paper_page.py" "$work/page/index.html" "$chromium"
