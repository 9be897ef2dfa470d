#!/bin/bash
# weft plot: where points land in SVG and PNG by the formula of the axes, what is refused and with which
# words, and that a file is whole or not there.
. "$WEFT_SOURCE/tests/program/script.sh"
needs python3

# The axes of a plot of 560x320 reach from 66 to 546 and, upwards, from 274 to 12.
cat >all.json <<'END'
{"description": "all <kinds> & \"more\"",
 "x": {"label": "along", "low": 0, "high": 10}, "y": {"label": "up", "low": 5, "high": -5, "digits": 1},
 "items": [
  {"kind": "map", "box": [0, 5, -5, 0], "values": [[0, 1], [2, 4]]},
  {"kind": "band", "across": [2, 4], "text": "band"},
  {"kind": "boxes", "boxes": [[6, 8, -1, 1]], "series": 2},
  {"kind": "line", "points": [[0, -5], [5, 0], [10, 100]], "series": 1, "name": "line"},
  {"kind": "line", "points": [[0, 0], [10, 0]], "series": 8, "name": "dashed <line>", "dashed": true},
  {"kind": "points", "points": [[2.5, 2.5], [9, 99]], "series": 3, "radius": 6},
  {"kind": "points", "points": [[1, 1]], "shades": [1], "radius": 3},
  {"kind": "points", "points": [[8, 4]], "hollow": true, "dashed": true, "radius": 11},
  {"kind": "rule", "x": 7.5, "text": "rule"},
  {"kind": "ring", "at": [2, -2], "text": "C", "dashed": true},
  {"kind": "word", "at": [5, 3], "text": "word", "anchor": "end", "shift": [-7, 4]},
  {"kind": "label", "at": [6, -3], "text": "label", "series": 4}]}
END
cat >log.json <<'END'
{"title": "Decades", "x": {"log": true, "low": 1, "high": 1000}, "y": {"log": true},
 "items": [{"kind": "points", "points": [[10, 1], [100, 100]], "series": 1}]}
END
cat >bar.json <<'END'
{"x": {"low": 0, "high": 1, "ticks": []}, "y": {"low": 0, "high": 1, "ticks": []},
 "items": [{"kind": "map", "box": [0, 1, 1, 0], "values": [[-45, 0]], "range": [-45, 0],
            "text": "dB below white"}]}
END
check "an SVG" exits 0 weft plot all.json -o all.svg
check "nothing is said" test ! -s said
check "an SVG on standard output" exits 0 weft plot - -o - <all.json
check "it is the same" cmp -s out all.svg
check "a PNG" exits 0 weft plot all.json -o all.png
check "it replaces one that is there" exits 0 weft plot all.json -o all.png
check "a logarithmic one" exits 0 weft plot log.json -o log.svg
check "a map with a bar of its colors" exits 0 weft plot bar.json -o bar.svg
check "places are right" python3 "$WEFT_SOURCE/tests/program/plot_places.py" .

# ---- What is refused ----

# refuses WORDS JSON: ends with 2, says the words, and leaves no file.
refuses()
{
    printf '%s' "$2" >bad.json
    exits 2 weft plot bad.json -o bad.svg && says "$1" && [ ! -e bad.svg ]
}
item() { echo "{\"items\": [{\"kind\": \"points\", \"points\": [[1, 1]]}, $1]}"; }
while IFS='|' read -r words json; do
    check "refused: $json" refuses "$words" "$json"
done <<'END'
bad.json: line 1, column 1|{
bad.json: an object is wanted|[1]
bad.json: the key 'items' is wanted|{"title": "none"}
there is no key 'titel'; did you mean 'title'?|{"titel": "x", "items": []}
it takes title, subtitle, description, width, height, x, y, items|{"zzzzzz": 1}
bad.json: title: text is wanted|{"title": 3, "items": []}
bad.json: width: a number from 200 to 8000 is wanted|{"width": 10, "items": []}
bad.json: width: a whole number is wanted|{"width": 300.5, "items": []}
bad.json: x.low: a number is wanted|{"x": {"low": "a"}, "items": []}
bad.json: x: low and high are one and the same|{"x": {"low": 1, "high": 1}, "items": []}
bad.json: y: low and high are above 0|{"y": {"low": 0, "high": 1, "log": true}, "items": []}
bad.json: y.log: true or false is wanted|{"y": {"log": 1}, "items": []}
bad.json: x.ticks[1]: a number is wanted|{"x": {"ticks": [1, "b"]}, "items": []}
bad.json: items: an array of objects|{"items": 3}
bad.json: items[0]: x is above 0|{"x": {"log": true}, "items": [{"kind": "points", "points": [[0, 1]]}]}
END
while IFS='|' read -r words json; do
    check "refused: $json" refuses "$words" "$(item "$json")"
done <<'END'
items[1]: an object is wanted|3
items[1]: kind: it is one of line, points, label, word|{"points": [[1, 2]]}
items[1]: kind: 'lines' is none; did you mean 'line'?|{"kind": "lines"}
items[1]: 'line' needs the key 'points'|{"kind": "line"}
items[1]: 'word' needs the key 'text'|{"kind": "word", "at": [1, 2]}
items[1]: 'line' has no key 'radius'; it takes points name series dashed|{"kind": "line", "points": [[1, 1]], "radius": 2}
items[1]: there is no key 'serie'; did you mean 'series'?|{"kind": "line", "points": [[1, 1]], "serie": 2}
items[1].series: a number from 0 to 8 is wanted|{"kind": "line", "points": [[1, 1]], "series": 9}
items[1].points[0]: a point is [x, y]|{"kind": "line", "points": [[1, 1, 1]]}
items[1].points[1][0]: a number is wanted|{"kind": "line", "points": [[1, 1], [null, 2]]}
items[1].points: an array of points [x, y] is wanted|{"kind": "line", "points": []}
items[1]: there are not as many shades as points|{"kind": "points", "points": [[1, 1]], "shades": [0, 1]}
items[1]: a rule has either x or y|{"kind": "rule", "x": 1, "y": 1}
items[1]: a rule has either x or y|{"kind": "rule"}
items[1].values[1]: it is not as long as the first row|{"kind": "map", "box": [0, 1, 0, 1], "values": [[1, 2], [3]]}
items[1].range: the first number is below the second|{"kind": "map", "box": [0, 1, 0, 1], "values": [[1]], "range": [1, 1]}
items[1].anchor: it is one of start, middle, end|{"kind": "word", "at": [1, 1], "text": "a", "anchor": "left"}
END
check "no output" exits 2 weft plot all.json
check "no output is told" says "no output; say -o FILE.svg or FILE.png"
check "another kind of file" exits 2 weft plot all.json -o all.gif
check "the kinds are told" says "all.gif: a plot is written as .svg or .png"
check "no file" exits 2 weft plot -o x.svg
check "two files" exits 2 weft plot all.json log.json -o x.svg
check "a file that is not there" exits 1 weft plot absent.json -o x.svg
check "which is told" says "absent.json: No such file"
check "a folder that is not there" exits 1 weft plot all.json -o absent/x.svg
check "a folder is no file" exits 1 weft plot . -o x.svg
check "nothing is left" test ! -e x.svg
cp all.svg kept.svg
echo '{' >bad.json
check "bad data" exits 2 weft plot bad.json -o kept.svg
check "what was there stays" cmp -s all.svg kept.svg
[ ! -c /dev/full ] || check "a full device" exits 1 bash -c 'timeout 250 "$WEFT" plot all.json -o - >/dev/full'
echo '{"x": {"low": 1e17, "high": 100000000000000064}, "items": [{"kind": "line", "points": [[-1e300, 0], [1e300, 1]]}]}' >far.json
check "ends that doubles hardly tell apart" exits 0 weft plot far.json -o far.svg
check "help tells every kind" test -z "$(for kind in line points label word rule band boxes map ring; do
    weft plot --help | grep -q "^  $kind  *" || echo $kind; done)"
finish
