# shellcheck shell=bash
# What the farm scripts share: how the parts of an output are called, made, checked and joined.
# Sourced (bash). Beside OUTPUT, in OUTPUT.parts, lie the parts of a stream and, for each part of
# anything, a note that it is done: the exit code of weft and the part's size.

weft=${WEFT:-weft}

die()
{
    echo "${0##*/}: $1" >&2
    exit "${2:-1}"
}

# Numbers with as many digits as COUNT has, so that parts are in order by name: number I COUNT.
number() { printf "%0${#2}d" "$1"; }

# A frame a file: nothing is joined. The name alone tells, not its directory.
is_sequence() { [[ ${1##*/} == *[#@]* || ${1##*/} =~ %[0-9]*d ]]; }

# part OUTPUT I N: where weft writes part I.
part()
{
    if is_sequence "$1"; then echo "$1"; else echo "$1.parts/$(number "$2" "$3")of$3.${1##*.}"; fi
}

# done_note OUTPUT I N: what says that part I is done.
done_note() { echo "$1.parts/$(number "$2" "$3")of$3.done"; }

# size_of OUTPUT PART: of a sequence there is no one size.
size_of() { if is_sequence "$1"; then echo -; else stat -c %s "$2" 2>/dev/null || echo absent; fi; }

# is_done OUTPUT I N: the part is there, as long as it was when weft was done with it.
is_done()
{
    local note code size
    note=$(done_note "$@")
    [ -f "$note" ] && read -r code size <"$note" && [ "$size" = "$(size_of "$1" "$(part "$@")")" ]
}

check_numbers()
{
    local value
    for value in "$@"; do
        [[ $value =~ ^[1-9][0-9]{0,5}$ ]] || die "'$value' is no number of parts from 1 to 999999" 2
    done
}

# Parts of another conversion must not get among these: note_job OUTPUT N ARGUMENT.. keeps what
# was asked for first, whoever comes first, and holds everybody else to it.
note_job()
{
    local job=$1.parts/job own
    own=$job.$(uname -n).$$
    mkdir -p "$1.parts" || die "cannot make $1.parts"
    printf '%q ' "$2" "${@:3}" >"$own" || die "cannot write in $1.parts"
    ln "$own" "$job" 2>/dev/null || mv -n "$own" "$job"
    if cmp -s "$own" "$job" || [ ! -e "$own" ]; then rm -f "$own"; return; fi
    rm -f "$own"
    die "$1.parts holds parts of another job ($(cat "$job")); remove it to begin anew" 2
}

# begin N OUTPUT ARGUMENT..: what is looked at before anything is queued.
begin()
{
    check_numbers "$1"
    is_sequence "$2" || [ ! -e "$2" ] || die "$2 exists; remove it, or write elsewhere"
    note_job "$2" "$1" "${@:3}"
}

# make_part I N OUTPUT ARGUMENT..: makes what is missing of part I.
make_part()
{
    local i=$1 n=$2 output=$3 code note file
    shift 3
    check_numbers "$i" "$n"
    file=$(part "$output" "$i" "$n")
    note=$(done_note "$output" "$i" "$n")
    if [ "$file" != "$output" ] && [ -e "$output" ]; then
        echo "$output is there: nothing to do"
        return 0
    fi
    note_job "$output" "$n" "$@"
    if is_done "$output" "$i" "$n" && ! is_sequence "$output"; then
        echo "part $i of $n is there: nothing to do"
        return 0
    fi
    # What a note says another length of is no part any more.
    [ ! -f "$note" ] || is_sequence "$output" || rm -f "$file" "$note"
    "$weft" convert "$@" --chunk "$i/$n" --resume --threads "${WEFT_THREADS:-all}" \
        --progress "${WEFT_PROGRESS:-plain}" -o "$file"
    code=$?
    # Frames that were held or mended are for the join to tell of: other parts need not wait.
    [ $code = 0 ] || [ $code = 3 ] || return $code
    # The frames of a sequence that are there already keep the code they were made with.
    [ ! -f "$note" ] || [ $code = 3 ] || return 0
    echo "$code $(size_of "$output" "$file")" >"$note.$$" && mv -f "$note.$$" "$note"
}

# join_stream N OUTPUT: the parts one after the other, under the final name once that is whole.
join_stream()
{
    local n=$1 output=$2 i joined parts=() size=0
    joined=$output.parts/joined.$(uname -n).$$
    for ((i = 1; i <= n; i++)); do
        parts+=("$(part "$output" "$i" "$n")")
        size=$((size + $(stat -c %s "${parts[-1]}")))
    done
    if ! cat "${parts[@]}" >"$joined" || ! sync "$joined" ||
        [ "$(stat -c %s "$joined")" != "$size" ]; then
        rm -f "$joined"
        die "cannot write $joined"
    fi
    mv -nT "$joined" "$output"
    # One that is the same is from a join that was ended before it had tidied up.
    if [ -e "$joined" ] && ! cmp -s "$joined" "$output"; then
        rm -f "$joined"
        die "$output exists; remove it, or write elsewhere"
    fi
}

# join_parts N OUTPUT ARGUMENT..: fails, naming them, unless all parts are there and whole.
join_parts()
{
    local n=$1 output=$2 i code missing=() degraded=()
    shift 2
    check_numbers "$n"
    if [ -e "$output" ] && [ ! -d "$output.parts" ]; then
        echo "$output is there: nothing to do"
        return 0
    fi
    note_job "$output" "$n" "$@"
    for ((i = 1; i <= n; i++)); do
        is_done "$output" "$i" "$n" || missing+=("$i")
        code=
        read -r code _ 2>/dev/null <"$(done_note "$output" "$i" "$n")"
        [ "$code" != 3 ] || degraded+=("$i")
    done
    [ ${#missing[@]} = 0 ] || die "of $n parts these are not there or not whole: ${missing[*]}; run them again"
    if is_sequence "$output"; then
        # Finds every frame there, and would make one that somebody took away.
        "$weft" convert "$@" --resume --progress none -o "$output" || return
    else
        join_stream "$n" "$output"
    fi
    rm -rf "$output.parts"
    [ ${#degraded[@]} = 0 ] && return 0
    echo "${0##*/}: $output is whole, but frames were held or mended in parts ${degraded[*]}" >&2
    return 3
}
