#!/bin/bash
# The manual page and what shells complete: made of the tables, in good roff and good shell, and tried
# by completing.
. "$WEFT_SOURCE/tests/script.sh"

# ---- The manual page ----

check "manual" exits 0 weft manual
cp out weft.1
commands=$("$WEFT" --help | sed -n 's/^  weft \([a-z]*\) .*/\1/p' | sort -u)
check "there are commands" test "$(wc -w <<<"$commands")" -ge 10
options() { "$WEFT" "$1" --help | grep -o '^  \(-., \|    \)--[a-z0-9-]*' | grep -o -- '--.*'; }
for command in $commands; do
    check "$command is in the manual" grep -qx "\.SS weft $command" weft.1
    for option in $(options "$command"); do
        [ "$option" = --help ] && continue
        check "$option of $command is in the manual" grep -qF "${option//-/\\-}" weft.1
    done
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
cat >complete.bash <<'END2'
. ./weft.bash
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
_weft
printf '%s\n' "${COMPREPLY[@]}"
END2
# completes SHELL WANTED WORD..: the words, of which the last is being typed, complete to WANTED.
completes()
{
    local shell=$1 wanted=$2 got
    shift 2
    case $shell in
        bash) got=$(bash complete.bash "$@") ;;
        fish) got=$(fish --no-config -c "source weft.fish; complete -C '$*'" | cut -f 1) ;;
        zsh) got=$(zsh -f complete.zsh "$*" | tr -d '\r') ;;
    esac
    got=$(sort -u <<<"$got" | sed '/^$/d' | tr '\n' ' ')
    [ "$got" = "$wanted" ] || { echo "$*: completes to '$got', not '$wanted'"; return 1; }
}

# tries SHELL: commands, every option of every command, words, names, files.
tries()
{
    local shell=$1 command option wanted
    check "$shell: commands" completes "$shell" "completion composite convert " weft co
    for command in $commands; do
        wanted=$(for option in $(options "$command"); do echo "$option"; done | sort -u | tr '\n' ' ')
        check "$shell: options of $command" completes "$shell" "$wanted" weft "$command" --
    done
    check "$shell: choices" completes "$shell" "center end start " weft convert --shutter-position ""
    check "$shell: a choice begun" completes "$shell" "pad " weft convert --fit p
    check "$shell: rasters" completes "$shell" "1080i50 1080i59.94 1080i60 " weft render --raster 1080i
    check "$shell: apertures" completes "$shell" "calm ccd crisp " weft trace --aperture c
    check "$shell: raster as an operand" completes "$shell" "625i 625i-dv " weft rasters 625
    check "$shell: shells" completes "$shell" "bash fish zsh " weft completion ""
    check "$shell: a file" completes "$shell" "shot.0001.exr " weft convert sho
    check "$shell: a scene" completes "$shell" "scene.lua " weft render --overwrite sc
    check "$shell: a file of an option" completes "$shell" "look.ocio " weft convert --ocio loo
    check "$shell: nothing" completes "$shell" "" weft rasters --json=
}

tries bash
check "bash: after =" completes bash "crop pad stretch " weft convert --fit =
check "bash: begun after =" completes bash "crop " weft convert --fit = c

# ---- fish, zsh ----

if has fish; then
    "$WEFT" completion fish >weft.fish
    export HOME=$work
    tries fish
fi
if has zsh; then
    "$WEFT" completion zsh >_weft
    check "zsh reads its script" zsh -f -n _weft
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
    # A shell on a terminal takes a while to begin: only these.
    check "zsh: commands" completes zsh "completion composite convert " weft co
    check "zsh: options" completes zsh "$(options measure | sort -u | tr '\n' ' ')" weft measure --
    check "zsh: rasters" completes zsh "1080i50 1080i59.94 1080i60 " weft render --raster 1080i
fi
finish
