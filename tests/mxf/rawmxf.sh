# shellcheck shell=bash
# What the tests of uncompressed MXF share: files of every kind beside their raw frames, walked by a reader
# of our own (mxf_check.py) and by others. Sourced after script.sh.
python3=$(python3 -c "import sys; print(sys.executable)") # not by way of what picks a version
subframes in 16

# write FILE RASTER OPTION..: two or four frames.
write()
{
    local file=$1 raster=$2 rate=160
    shift 2
    case $raster in *psf*|*p[2-6]*|*p) rate=96 ;; esac
    weft convert in/subframe.####.exr -q --subframe-rate $rate --raster "$raster" --overwrite \
        --temporal-width 1 "$@" -o "$file"
}

# make RASTER CODEC OPTION..: out.mxf, and its frames as they are in out.raw.
make()
{
    local raster=$1 codec=$2
    shift 2
    write "out.$codec" "$raster" && mv "out.$codec" out.raw && write out.mxf "$raster" --codec "$codec" "$@"
}

# walked EXPRESSION FILE: out.mxf is well formed, this is true of it, and its pictures are FILE's.
walked() { "$python3" "$WEFT_SOURCE/tests/mxf/mxf_check.py" out.mxf "$@" >out 2>said || { tail -n 1 said; cat out; return 1; }; }

# probe KEYS VALUES: what ffprobe says of the picture.
probe()
{
    local got
    got=$(ffprobe -v error -select_streams v -show_entries "$1" -of csv=p=0 out.mxf)
    [ "$got" = "$2" ] || { echo "$1 is $got, not $2"; return 1; }
}

# info TEMPLATE VALUES: what MediaInfo says.
info()
{
    local got
    got=$(mediainfo --Inform="$1" out.mxf)
    [ "$got" = "$2" ] || { echo "$1 is $got, not $2"; return 1; }
}

# Bit for bit, by copying packets and by decoding them, without a word.
read_back()
{
    ffmpeg -nostdin -v error -xerror -i out.mxf -map 0:v -c copy -f data -y copied \
        -map 0 -f null - 2>said && cmp copied out.raw && [ ! -s said ] || { cat said; return 1; }
}
