#!/bin/bash
# weft in a live pipe: a frame is out as soon as the picture after it says how long its last one was shown, whatever the
# aperture; and the guide's line for a live sender gives a stream of fields.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh converts"
live="$WEFT_SOURCE/tests/live/live.py"

# waits_for_nothing PICTURES OPTION..
waits_for_nothing()
{
    python3 "$live" delay "$WEFT" "$@" >out || { cat out; return 1; }
    value "d['late_pictures'] == 0 and d['frames'] == $1 // 2"
}

check "a frame is out when the next begins" waits_for_nothing 12
for aperture in line box shaped calm; do
    check "so it is through $aperture" waits_for_nothing 8 --aperture $aperture
done
check "and with the shutter open for half a field" waits_for_nothing 8 --temporal-width 1/2
check "and where flicker is held" waits_for_nothing 6 --aperture line --flicker-limit .06
# A shutter that is open for two fields sees half a field more: its frames are one picture late.
check "a wide shutter waits for what it sees" \
    eval '! waits_for_nothing 8 --temporal-width 2 && value "d[\"late_pictures\"] >= 2"'

# What a frame takes of the processor is the same on a machine that does other things; when it is out is not.
pictures=100
is_long && pictures=1000
check "pictures at their rate" eval 'python3 "$live" pace "$WEFT" $pictures --threads 1 >out'
check "all become frames" value "d['frames'] == $pictures // 2"
check "which take one core less than 20 ms a field" value "d['cpu_ms'] < 40"
is_long && check "99 % of frames are out within 20 ms a field" value "d['p99_ms'] <= 40"
cat out

# sends: the guide's line, to a file, of a clip that this makes.
sends()
{
    local line
    line=$(sed -n 's/^    \(ffmpeg -re .*\)$/\1/p' "$WEFT_SOURCE/examples/guides/td.md")
    [ -n "$line" ] || { echo "the guide has no line"; return 1; }
    line=$(sed -E "s#-re -i IN#-v error -re -i in.y4m#; s#ffmpeg -i - #ffmpeg -v error -y -i - #; s#udp://[^ ]*#sent.ts#" <<<"$line")
    bash -o pipefail -c "weft() { '$WEFT' \"\$@\"; }; $line" 2>said || { cat said; return 1; }
    stream sent.ts stream=field_order | grep -qx 'tt,*' || { stream sent.ts stream=field_order; return 1; }
    ffprobe -v error -select_streams v -count_frames -show_entries stream=nb_read_frames -of csv=p=0 sent.ts >frames
    grep -qx '25,*' frames || { cat frames; return 1; }
}
if has ffmpeg && has ffprobe; then
    ffmpeg -nostdin -v error -f lavfi -i testsrc2=s=640x360:r=50,format=yuv420p -t 1 in.y4m
    check "the guide's live line sends fields" sends
fi
finish
