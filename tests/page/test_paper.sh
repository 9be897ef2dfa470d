#!/bin/bash
# The page of examples/paper: some of its experiments built quickly (at full length all), read as text, and looked
# at in headless Chromium.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized never
paper=$WEFT_SOURCE/examples/paper
needs python3
needs_module plot
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || skip "no chromium"

# A program that lacks a command ends the build, says which, and leaves no page.
printf '#!/bin/sh\n[ "$1" != render ] || { echo "no such command" >&2; exit 2; }\nexec "%s" "$@"\n' \
    "$WEFT" >lame
chmod +x lame
WEFT=$work/lame check "a page without renders" fails 'weft render ' "$paper/run.sh" --quick -o none
check "what was wrong is said" says "no such command"
check "no page is left" test ! -e none/index.html

only=() part=part
if is_long; then part=whole; else only=(--only lattice,default); fi
check "page" python3 -B "$paper/build.py" --weft "$WEFT" --out page --quick "${only[@]}"
check "what it shows" python3 -B "$WEFT_SOURCE/tests/page/paper_page.py" page/index.html "$chromium" $part
finish
