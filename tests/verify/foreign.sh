# shellcheck shell=bash disable=SC2034
# What the tables of foreign files share. Sourced after script.sh.

# found NAME WRONG OPEN [OPTION..]: verify finds exactly the checks of WRONG wrong and at least those of OPEN open;
# _ stands for a blank in the name of a check.
found()
{
    local name=$1 wrong=$2 open=$3
    shift 3
    weft verify --json "$name" "$@" >out 2>said
    python3 - "$wrong" "$open" <<'PY'
import json, sys
found = json.load(open("out"))[0]
named = {c["check"].replace(" ", "_"): c["verdict"] for c in found["checks"]}
wrong = {n for n, v in named.items() if v == "wrong"}
still = {n: named.get(n) for n in sys.argv[2].split() if named.get(n) != "open"}
if wrong != set(sys.argv[1].split()) or still:
    told = [(c["check"], c["is"], c["should"]) for c in found["checks"] if c["verdict"] == "wrong"]
    sys.exit(f"wrong: {told}; not open: {still}")
PY
}

# ff OPTION..: ffmpeg without its remarks.
ff() { ffmpeg -nostdin -v error -y "$@" 2>/dev/null; }
