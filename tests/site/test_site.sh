#!/bin/bash
# The site is built strictly: its links and anchors, the options of its reference, its spelling, and no page that is wider than a phone.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized never
needs python3 mkdocs doxygen
walk() { python3 -B "$WEFT_SOURCE/tests/site/check_site.py" "$@"; }

exits 0 "$WEFT_SOURCE/examples/site/build.sh" site || { cat said; exit 1; }
check "mkdocs and Doxygen have nothing to say" test ! -s said
check "every link and anchor leads somewhere, and nothing is loaded from the network" walk links site/html
check "every option of every command has its row" walk options site/html "$WEFT"
has hunspell && check "words are spelled as Americans do" walk words site/html "$WEFT_SOURCE/examples/site/words.txt"

# What is broken is found.
cp -r site/html broken
echo '<a href="nowhere.html">x</a> <img src="https://example.org/x.png"> flikker' >>broken/examples/site/questions.html
sed -i 's/<td id="raster">/<td>/' broken/made/commands/convert.html
check "a dead link is found" exits 1 walk links broken
check "by its name" prints "nowhere.html: no such file"
check "and a picture from elsewhere" prints "x.png is loaded from the network"
check "a missing option is found" exits 1 walk options broken "$WEFT"
check "by its name" prints "convert: no row of --raster"
has hunspell && check "a word is found" exits 1 walk words broken "$WEFT_SOURCE/examples/site/words.txt" &&
    check "by its letters" prints ": flikker"

chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
if [ -n "$chromium" ]; then
    check "no page is wider than 390 pixels" python3 -B "$WEFT_SOURCE/tests/site/narrow.py" "$chromium" site/html
else
    skip_part "no chromium"
fi
finish
