#!/bin/bash
# The manual page and what shells complete: made of the tables, in good roff and good shell, and tried
# by completing.
. "$WEFT_SOURCE/tests/program/script.sh"

# ---- The manual page ----

check "manual" exits 0 weft manual
cp out weft.1
commands=$("$WEFT" --help | sed -n 's/^  weft \([a-z]*\) .*/\1/p' | sort -u)
check "there are commands" test "$(wc -w <<<"$commands")" -ge 10
# Every command's options, a line each; what the manual says, by words.
for command in $commands; do
    "$WEFT" "$command" --help | grep -o '^  \(-., \|    \)--[a-z0-9-]*' | grep -o -- '--.*' | sort -u >options.$command
done
tr -s ' ,' '\n' <weft.1 | sed 's/\\-/-/g; s/\\f.//g; s/=.*//' | grep '^--' | sort -u >manual.options
for command in $commands; do
    check "$command is in the manual" grep -qx "\.SS weft $command" weft.1
    check "its options are" test -z "$(grep -vx -e --help options.$command | comm -23 - manual.options)"
done
check "manual takes nothing" exits 2 weft manual convert
SOURCE_DATE_EPOCH=86400 "$WEFT" manual >dated.1
check "the manual's date can be told" grep -q '^\.TH WEFT 1 1970-01-02 ' dated.1
if has mandoc; then
    mandoc -T lint weft.1 >lint
    check "mandoc has nothing to say" test ! -s lint
fi
if has groff; then
    groff -man -Tascii -ww weft.1 >page 2>lint
    check "groff has nothing to say" test ! -s lint
    for words in 'weft convert INPUT... -o OUTPUT' 'weft convert shot.####.exr --subframe-rate 480000/1001 -o shot.y4m' \
        'EXIT STATUS' 'NO_COLOR'; do
        check "the page shows $words" grep -qF -- "$words" <(sed 's/.\x08//g;s/\x1b\[[0-9;]*m//g' page)
    done
fi

# ---- bash ----

check "bash script" exits 0 weft completion bash
cp out weft.bash
check "no shell" exits 2 weft completion
check "a shell like no other" exits 2 weft completion tcsh
check "shells are listed" says "bash|zsh|fish"
touch shot.0001.exr scene.lua look.ocio
# A shell takes longer to begin than to complete: it gets all lines at once, and answers each reply
# with the line's number before it.
cat >complete.bash <<'END2'
. ./weft.bash
n=0
while IFS= read -r line; do
    n=$((n + 1))
    IFS=' ' read -ra COMP_WORDS <<<"$line"
    [[ $line == *' ' ]] && COMP_WORDS+=("")
    COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    _weft
    for reply in "${COMPREPLY[@]}"; do printf '%s\t%s\n' $n "$reply"; done
done
END2
cat >complete.fish <<'END2'
source weft.fish
set n 0
while read -l line
    set n (math $n + 1)
    for reply in (complete -C $line)
        printf '%s\t%s\n' $n (string split -f 1 \t -- $reply)
    end
end
END2

# expects NAME WANTED LINE: one of the lines; completed SHELL COMMAND..: all of them.
lines=0
expects()
{
    lines=$((lines + 1))
    name[lines]=$1 wanted[lines]=$2
    printf '%s\n' "$3" >>lines
}
completed()
{
    local shell=$1 n reply got=()
    shift
    while IFS=$'\t' read -r n reply; do got[n]+="$reply "; done < <("$@" <lines | sort -u)
    for ((n = 1; n <= lines; n++)); do
        check "$shell: ${name[n]}: completes to '${got[n]:-}', not '${wanted[n]}'" \
            test "${got[n]:-}" = "${wanted[n]}"
    done
}

expects commands "completion composite convert " "weft co"
for command in $commands; do
    expects "options of $command" "$(tr '\n' ' ' <options.$command)" "weft $command --"
done
expects choices "center end start " "weft convert --shutter-position "
expects "a choice begun" "pad " "weft convert --fit p"
expects rasters "1080i50 1080i59.94 1080i60 " "weft render --raster 1080i"
expects apertures "calm ccd crisp " "weft trace --aperture c"
expects codecs "dnxhd dnxhr dvcpro50 " "weft convert --codec d"
expects "a raster as an operand" "625i 625i-dv " "weft rasters 625"
expects shells "bash fish zsh " "weft completion "
expects "a file" "shot.0001.exr " "weft convert sho"
expects "a scene" "scene.lua " "weft render --overwrite sc"
expects "a file of an option" "look.ocio " "weft convert --ocio loo"
expects nothing "" "weft rasters --json="
cp lines plain
plain=$lines
expects "after =" "crop pad stretch " "weft convert --fit ="
expects "begun after =" "crop " "weft convert --fit = c"
completed bash bash complete.bash
mv plain lines
lines=$plain

# ---- fish, zsh ----

if is_sanitized; then
    finish # the rest is about text
    exit
fi
if has fish; then
    "$WEFT" completion fish >weft.fish
    export HOME=$work
    completed fish fish --no-config complete.fish
fi
if has zsh; then
    "$WEFT" completion zsh >_weft
    check "zsh reads its script" zsh -f -n _weft
fi
if has zsh && has_terminal; then
    cat >complete.zsh <<'END2'
# A shell on a terminal of its own is asked for what it would add; its completion system calls
# compadd, which is made to print.
zmodload zsh/zpty
zpty -b shell zsh -f -i
read_until() { local line; while zpty -r shell line; do [[ $line == *$1* ]] && return; print -r -- "$line" >>seen; done }
zpty -w shell "PS1= PS2= RPS1=; stty -echo; autoload -Uz compinit; compinit -u -D; fpath=(. \$fpath); source ./_weft"
zpty -w shell "compadd() { local -a hits; builtin compadd -O hits \"\$@\"; if (( \$#hits )); then print -rl -- \$hits >>zsh-out; fi; builtin compadd \"\$@\" }"
zpty -w shell "ask() { : >zsh-out; }; bindkey '^I' complete-word; zstyle ':completion:*' insert-tab false; print READY''NOW"
read_until READYNOW
rm -f zsh-out
zpty -w -n shell "$1"$'\t'
for try in {1..200}; do [[ -s zsh-out ]] && break; sleep 0.05; done
sleep 0.1
zpty -d shell
[[ -f zsh-out ]] && sed 's/=$//' zsh-out
true
END2
    # completes WANTED WORD..: a shell on a terminal takes a while to begin, so only two.
    completes()
    {
        local wanted=$1 got
        shift
        got=$(zsh -f complete.zsh "$*" | tr -d '\r' | sort -u | sed '/^$/d' | tr '\n' ' ')
        [ "$got" = "$wanted" ] || { echo "$*: completes to '$got', not '$wanted'"; return 1; }
    }
    check "zsh: options" completes "$(tr '\n' ' ' <options.measure)" weft measure --
    check "zsh: rasters" completes "1080i50 1080i59.94 1080i60 " weft render --raster 1080i
fi
finish
