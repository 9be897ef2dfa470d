# shellcheck shell=bash disable=SC2034
# What the tests of whole and of cut files share. Sourced after tests/program/script.sh.

# found CHECK FILE VERDICT: what verify says of this file by this check.
found()
{
    weft verify --json "$2" >out 2>said
    value "[c['verdict'] for c in d[0]['checks'] if c['check'] == '$1'] == ['$3']"
}

# no_cut_passes FILE CUTS PLACE..: what is left of the file, cut at so many places and at these, is not called whole.
no_cut_passes() { python3 "$WEFT_SOURCE/tests/verify/cuts.py" "$WEFT" "$@"; }

small=(--raster 180x122@25i,tff)
input=(-f lavfi -i testsrc2=s=64x48:r=25:d=0.4 -f lavfi -i sine=r=48000:d=0.4)
