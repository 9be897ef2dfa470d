# shellcheck shell=bash disable=SC2034
# What campaigns of tests/hard share: where the program lies, a folder that is removed, and campaign.py in it.
set -u
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
export WEFT_BUILD=${WEFT_BUILD:-$source_dir/build} WEFT_SOURCE=$source_dir
export WEFT=$WEFT_BUILD/weft
[ -f "$WEFT_BUILD/tests/libfaults.so" ] || { echo "skipped: no $WEFT_BUILD/tests/libfaults.so"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset OCIO

# campaign NAME OPTION..: campaign.py in a folder of this name.
campaign()
{
    python3 "$source_dir/tests/hard/campaign.py" --folder "$work/$1" "${@:2}"
}
