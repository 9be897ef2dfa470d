#!/bin/bash
# `weft info`, reports, messages of progress, and a reader of standard output that sleeps.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh has reports"

# ---- Info and reports ----

version=$(weft --version | awk '{ print $2 }')
subframes in 32
check "info" shows "1440" info in
check "info as JSON" exits 0 weft info --json in 'in/subframe.####.exr' in/subframe.0003.exr
check "info is JSON" json
check "info counts" value "[f.get('subframes') for f in d['files']] == [32, 32, None] and
    d['files'][2]['rate'] == '480000/1001' and d['files'][0]['missing'] == []"
check "info says the rate and why" value "all(f['input']['rate'] ==
    {'value': '480000/1001', 'reason': 'file'} for f in d['files'])"
rm in/subframe.0005.exr
exits 0 weft info --json in
check "info sees what is missing" value "d['files'][0]['missing'] == [5]"
check "info tells the others too" exits 1 weft info --json in absent.exr
check "info with an error is JSON" json
check "missing subframe" exits 1 weft convert in -o x.y4m --report x.json --temporal-width 1
check "missing subframe is named" says "subframe 5 is missing"
check "missing subframe leaves no video" test ! -e x.y4m
cp x.json out
check "a failure has its report" value "d['input']['missing'] == [5] and 'missing' in d['error']"
check "held" exits 3 weft convert in -o x.y4m --report x.json --on-missing hold --temporal-width 1
cp x.json out
check "held in the report" value "d['degraded'] and d['frames'] == 2 and d['fields'] == 4 and
    d['input']['listed'] == 32 and d['raster']['name'] == '525i' and d['command'] == 'convert' and
    d['version'] == '$version' and d['peak_memory_bytes'] > 1e6 and d['seconds']['wall'] > 0"
check "held video" shows "bottom first" info x.y4m
check "existing output" exits 1 weft convert in -o x.y4m --on-missing hold
check "existing output says --overwrite" says "--overwrite"
check "overwritten" exits 3 weft convert in -o x.y4m --on-missing hold --overwrite --temporal-width 1
check "quiet" bash -c "'$WEFT' convert in -o q.y4m --on-missing hold --temporal-width 1 -q 2>said; [ \$? = 3 ] && [ ! -s said ]"
check "progress for programs" exits 3 weft convert in -o j.y4m --on-missing hold --temporal-width 1 --progress json
grep '^{' said | tail -n 1 >out
check "progress is JSON" value "d['frames_done'] == d['frames_total'] == 2"
check "progress for queues" exits 3 weft convert in -o a.y4m --on-missing hold --temporal-width 1 --progress alf
check "progress ends" says "ALF_PROGRESS 100%"

# ---- A reader that sleeps ----

# asleep SIGNAL CODE: a job whose standard output nobody reads ends within two seconds of the signal.
asleep()
{
    local pid began ended code
    mkfifo pipe
    sleep 20 <pipe &
    local reader=$!
    "$WEFT" convert in --on-missing hold --raster 1080i50 --subframe-rate 400 -o - >pipe 2>said &
    pid=$!
    sleep 1
    began=$(date +%s%N)
    kill -s "$1" $pid
    wait $pid
    code=$?
    ended=$(date +%s%N)
    kill $reader 2>/dev/null
    wait $reader 2>/dev/null
    rm pipe
    [ $code = "$2" ] && [ $((ended - began)) -lt 2000000000 ] ||
        { echo "status $code after $((ended - began)) ns"; return 1; }
}
check "SIGINT" asleep INT 130
check "SIGTERM" asleep TERM 143

finish
