. ./weft.bash
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
_weft
printf '%s\n' "${COMPREPLY[@]}"
