#!/bin/bash
# Lists of jobs: the same bytes as single runs, failures, --resume, signals, what is refused, the report,
# and the farm's scripts.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "unit tests of job files, and their fuzz target"
scene=$WEFT_SOURCE/examples/scenes/carousel.lua
weft trace "$scene" --raster 36x24@30i,tff --frames 0-1 --oversample 1x1x4 -o t.####.exr -q || exit 1

# list A B C: a list of three jobs, one of which is of the inputs B.
list()
{
    cat >list.json <<END
{ "raster": "36x24@30i,tff", "subframe-rate": 240,
  "jobs": [
    {"inputs": "t.####.exr", "output": "a.y4m"},
    {"inputs": "$1", "output": "b.mkv",
     "codec": "ffv1"},
    {"inputs": "t.####.exr", "output": "c.####.png", "aperture": "box"}
  ]
}
END
}
one() { weft convert "$1" --raster 36x24@30i,tff --subframe-rate 240 -q "${@:2}"; }

# ---- The same as single runs, one failing ----
mkdir single
list 'none.####.exr'
one t.####.exr -o single/a.y4m && one t.####.exr -o single/c.####.png --aperture box || exit 1
check "a list with a job that fails" exits 3 weft convert --job list.json --report report.json
check "tells which" says 'list.json:4:5: job 2: none.####.exr matches no file'
check "how many are done" says '2 of 3 jobs are done; with --resume the rest is'
check "and nothing else" test "$(wc -l <said)" = 2
check "the first is as alone" cmp a.y4m single/a.y4m
check "the last is as alone" cmp c.0001.png single/c.0001.png
check "of the one that failed there is nothing" test ! -e b.mkv
cp report.json out
check "one report" value "[j['status'] for j in d['jobs']] == ['done', 'failed', 'done'] and d['done'] == 2"
check "with a report each" value "d['jobs'][0]['report']['frames'] == 2 and 'none' in d['jobs'][1]['error']"
check "with their places" value "[j['line'] for j in d['jobs']] == [3, 4, 6] and d['jobs'][2]['job'] == 3"
check "as its schema has it" python3 "$WEFT_SOURCE/tests/library/schema_check.py" \
    "$WEFT_SOURCE/convert/schema/jobs.json" report.json

# ---- The rest ----
check "without --resume outputs are in the way" exits 1 weft convert --job list.json
check "each is told" says 'job 3: c.0000.png exists'
list 't.####.exr'
touch -d '2001-01-01' a.y4m c.0000.png
check "the rest" exits 0 weft convert --job list.json --resume --report report.json
check "the rest is done" weft measure b.mkv --limit order.verdict=tff
check "and nothing else is" test a.y4m -ot single/a.y4m -a c.0000.png -ot single/a.y4m
cp report.json out
check "as the report says" value "[j['report']['frames'] for j in d['jobs']] == [0, 2, 0]"
check "a list on standard input" exits 0 weft convert --job - --resume <list.json
check "one of the list" exits 0 weft convert --job list.json --only 3 --overwrite
check "is made anew" test c.0000.png -nt a.y4m
check "and the others are not" test a.y4m -ot single/a.y4m
python3 -c "import json; d = json.load(open('list.json')); print(json.dumps({'only': '1', 'jobs': d if isinstance(d, list) else d['jobs'],
    **({} if isinstance(d, list) else {k: v for k, v in d.items() if k != 'jobs'})}))" >only.json
touch -d '2001-01-01' a.y4m c.0000.png
check "the list says which" exits 0 weft convert --job only.json --overwrite
check "and it is made" test a.y4m -nt single/a.y4m -a c.0000.png -ot single/a.y4m
check "the command line counts more" exits 0 weft convert --job only.json --only 3 --overwrite
check "and that is made" test c.0000.png -nt single/a.y4m

# ---- A job that makes no sense ----
sed 's/"codec": "ffv1"/"kodec": "ffv1"/' list.json >bad.json
rm -f a.y4m b.mkv c.*.png
check "a job with a key that is not known" exits 3 weft convert --job bad.json
check "is told with its line" says 'bad.json:5:6: job 2: "kodec": unknown key; did you mean "codec"?'
check "and the others are made" test -e a.y4m -a -e c.0001.png
check "no job that can be done" exits 1 weft convert --job bad.json --only 2
check "is a failure" says 'none of 1 jobs is done'

# ---- What is refused before anything is written ----
# refused TEXT JSON: a list that is refused, in one line, with no file made.
refused()
{
    rm -f r.y4m s.y4m
    echo "$2" >refused.json
    refuses "$1" convert --job refused.json "${@:3}" && [ ! -e r.y4m ] && [ ! -e s.y4m ]
}
good='"inputs": "t.####.exr", "raster": "36x24@30i,tff", "subframe-rate": 240'
check "an empty list" refused 'refused.json: its list of jobs is empty' '[]'
check "an empty list beside options" refused 'its list of jobs is empty' '{"raster": "625i", "jobs": []}'
check "no list" refused 'its list of jobs is no list' '{"jobs": {"output": "r.y4m"}}'
check "what is no job" refused 'refused.json:1:27: job 2: each job of a list is an object' '[{"output":    "r.y4m"},  "s.y4m"]'
check "an output twice" refused 'refused.json:2:2: job 2: its output, ./r.y4m, is that of job 1 (line 1) too' \
    "[{$good, \"output\": \"r.y4m\"},
 {$good, \"output\": \"./r.y4m\"}]"
check "standard output twice" refused "is that of job 1" "[{$good, \"output\": \"-\"}, {$good, \"output\": \"-\"}]"
check "no JSON" refused "refused.json:2:1: string or '}' expected" '[{'
check "two lists" refuses 'are both lists of jobs' convert --job list.json --job bad.json
check "a sequence twice, written otherwise" refused 'its output, k.%04d.png, is that of job 1' \
    '[{"output": "k.####.png"}, {"output": "k.%04d.png"}]'
check "sums twice" refused 'its output, hash:./x, is that of job 1' '[{"output": "hash:x"}, {"output": "hash:./x"}]'
check "a key twice" refused 'its key, k.y4m, is that of job 1' '[{"output": "a1.y4m", "key": "k.y4m"}, {"output": "a2.y4m", "key": "k.y4m"}]'
check "a key over an output" refused 'its key, a1.y4m, is that of job 1' '[{"output": "a1.y4m"}, {"output": "a2.y4m", "key": "a1.y4m"}]'
check "a preview twice" refused 'its preview, p.png, is that of job 1' \
    '{"preview": "p.png", "jobs": [{"output": "a1.y4m"}, {"output": "a2.y4m"}]}'
echo '{"inputs": "t.####.exr", "output": "-"}' >refused.json
check "video and a report on one output" refuses 'cannot both be standard output' convert --job refused.json --report -
check "an output for all" refuses 'is a list of jobs, each of which has its own' convert --job list.json -o r.y4m
check "an input for all" refuses 'leave out t.0000.exr' convert --job list.json t.0000.exr
check "--only without a list" refuses '--only is of a list of jobs' convert t.####.exr -o r.y4m --only 1
for only in 0 4 2-1 1-4 x 2x -1 ''; do
    check "--only '$only'" refuses "--only" convert --job list.json --only="$only"
done
echo "[{$good, \"output\": \"r.y4m\", \"report\": \"x\"}, {\"jobs\": []}]" >refused.json
check "what is of the whole list" exits 1 weft convert --job refused.json
check "is told" says '"report" is of the whole list'
check "a list in a list" says 'job 2: a job cannot hold others'
check "parts of one sequence are no duplicates" exits 0 weft convert --job - --resume <<<\
"[{$good, \"output\": \"p.####.png\", \"chunk\": \"1/2\"}, {$good, \"output\": \"p.####.png\", \"chunk\": \"2/2\"}]"
check "both parts are made" test -e p.0000.png -a -e p.0001.png

# ---- An array, options over all, several files ----
echo "[{\"inputs\": \"t.####.exr\", \"output\": \"e.y4m\"}, {\"inputs\": \"t.####.exr\", \"output\": \"f.y4m\", \"aperture\": \"line\"}]" >array.json
echo '{"raster": "36x24@30i,tff", "subframe-rate": 240, "aperture": "box"}' >common.json
check "what a file before it says is of all" exits 0 weft convert --job common.json --job array.json
one t.####.exr --aperture box -o single/e.y4m
one t.####.exr --aperture line -o single/f.y4m
check "but for what a job says" cmp f.y4m single/f.y4m
check "where it says nothing" cmp e.y4m single/e.y4m
check "the command line is over all" exits 0 weft convert --job common.json --job array.json --aperture notch --overwrite
check "jobs" cmp e.y4m f.y4m
check "a plan of all" exits 0 weft convert --job common.json --job array.json --dry-run --overwrite

# ---- A signal ----
echo "[$(for i in 1 2 3; do echo "{\"output\": \"long$i.y4m\", \"inputs\": \"$scene\"},"; done) {\"inputs\": \"$scene\", \"output\": \"long4.y4m\"}]" >long.json
"$WEFT" render --job long.json --samples 300 --raster 36x24@30i --threads 1 --report stopped.json 2>said &
running=$!
sleep 1
kill -INT $running
wait $running
check "Ctrl-C ends all" test $? = 130
check "and says so" says '0 of 4 jobs are done'
check "nothing is left" test -z "$(ls -A | grep long | grep -v json)"
cp stopped.json out
check "in the report too" value "[j['status'] for j in d['jobs']] == ['left'] * 4"

# ---- Farms ----
farm=$WEFT_SOURCE/examples/farm
export WEFT
rm -f a.y4m b.mkv c.*.png
mkdir bin
cat >bin/sbatch <<'END'
#!/bin/bash
# A queue that runs an array's tasks at once.
for argument; do case $argument in --array=*) tasks=${argument#*-}; tasks=${tasks#*=1-} ;; esac; done
while [[ $1 == --* ]]; do shift; done
for task in $(seq "${tasks##*-}"); do SLURM_ARRAY_TASK_ID=$task SLURM_CPUS_ON_NODE=1 bash "$@" >>tasks.log 2>&1 || echo "task $task failed" >>tasks.log; done
echo 17
END
chmod +x bin/sbatch
check "an array of tasks" exits 0 env PATH="$PWD/bin:$PATH" "$farm/jobs.sh" slurm convert list.json --resume
check "prints its number" prints 17
check "runs every job" test -e a.y4m -a -e b.mkv -a -e c.0001.png
check "as alone" cmp a.y4m single/a.y4m
check "no task failed" test -z "$(grep failed tasks.log)"
if has parallel; then
    rm -f a.y4m b.mkv c.*.png
    check "GNU parallel" exits 0 env PARALLEL="--will-cite" "$farm/jobs.sh" parallel convert list.json --resume
    check "makes the same" cmp a.y4m single/a.y4m
fi
check "what is no list" exits 2 "$farm/jobs.sh" here convert common.json
finish
