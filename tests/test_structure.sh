#!/bin/bash
# Holds the shape of the project: symbols, includes, headers, languages, state, text.

set -u
cd "$WEFT_SOURCE" || exit 1
library=$WEFT_BUILD/lib/libweft.so
[ -e "$library" ] || library=$(find "$WEFT_BUILD" -name libweft.so | head -n 1)
objects=$(find "$WEFT_BUILD/CMakeFiles" -path '*weft_*.dir*' -name '*.c.o')
folders=(convert tracer filters color)
failures=0

# Fails with what was found, one a line, if anything was.
none()
{
    local what=$1 found=$2
    if [ -z "$found" ]; then
        echo "ok: $what"
    else
        printf 'FAILED: %s:\n%s\n' "$what" "$found"
        failures=$((failures + 1))
    fi
}

sources() { find "${folders[@]}" "$@" -type f; }

# What the sanitizers and coverage of a test build add is not ours.
ours() { grep -v -E '__(asan|odr_asan|ubsan|sanitizer|sancov|start___|stop___|llvm)|\.module_ctor|_fini'; }

[ -n "$objects" ] || { echo "FAILED: no objects in $WEFT_BUILD"; exit 1; }

if [ -n "$library" ]; then
    none "libweft.so exports weft_ names only" \
        "$(nm -D --defined-only "$library" | awk '{print $NF}' | ours | grep -v '^weft_')"
    declared=$(grep '^WEFT_API' convert/weft.h | grep -o 'weft_[a-z0-9_]*(' | tr -d '(' | sort -u)
    exported=$(nm -D --defined-only "$library" | awk '{print $NF}' | grep '^weft_' | sort -u)
    none "every function that weft.h declares is exported, and no other" \
        "$(comm -3 <(echo "$declared") <(echo "$exported"))"
fi

# shellcheck disable=SC2086
none "symbols that cross files are named weft_ or wf_" \
    "$(nm -g --defined-only $objects | awk 'NF == 3 {print $3}' | ours | grep -v -E '^(weft|wf)_')"

# shellcheck disable=SC2086
none "the library neither exits nor prints" \
    "$(nm -A -u $objects | awk '{print $1, $NF}' |
        grep -E ' (exit|_exit|_Exit|quick_exit|printf|vprintf|__printf_chk|__vprintf_chk|puts|putchar|putc|perror|stdout|stderr|psignal)$')"

# Tables of pointers are in .data.rel.ro, which is not writable once loaded. The names allowed are
# locks and what is found once and never changes.
allowed='^(once|lock|loaded)(\.[0-9]+)?$'
if [ -z "${WEFT_SANITIZE:-}" ]; then
    # shellcheck disable=SC2086
    none "the library has no mutable globals" \
        "$(objdump -t $objects | awk '$4 ~ /^\.(data|bss|tdata|tbss)/ || $3 ~ /^\.(data|bss)/' |
            grep -v -E '\.data\.rel\.ro| \.(data|bss)$' | awk '{print $NF}' | grep -v -E "$allowed")"
fi

none "arithmetic is that of the standard" \
    "$(grep -n -i -E 'fast-math|Ofast|associative-math|reciprocal-math|finite-math|unsafe-math|no-signed-zeros|ftz|denormals-are-zero|_MM_SET_FLUSH' \
        CMakeLists.txt $(sources) "$WEFT_BUILD/compile_commands.json")"

quoted_includes() # FOLDER: file, and the file it includes
{
    find "$1" -name '*.[ch]' -o -name '*.cpp' | xargs -r grep -H -o -E '^ *# *include +"[^"]+"' |
        sed -E 's/: *# *include +"([^"]+)"/ \1/'
}
arrow() # FOLDER, and a pattern of the folders it may include
{
    none "$1 includes only $2" "$(quoted_includes "$1" | grep -v -E " ($2)/")"
}
arrow filters filters
arrow color color
arrow tracer 'tracer|filters'
arrow convert 'convert|tracer|filters|color'
none "weft.h includes system headers only" "$(grep -E '# *include +"' convert/weft.h)"

for language in "c -std=c17 ${CC:-cc}" "c++ -std=c++17 ${CXX:-c++}"; do
    set -- $language
    none "weft.h compiles alone as $1 ($2)" \
        "$(echo '#include "weft.h"' | $3 "$2" -x "$1" -Wall -Wextra -pedantic -Werror -fsyntax-only \
            -I convert - 2>&1)"
done

none "the program in README.md compiles" \
    "$(sed -n '/^```c$/,/^```$/p' README.md | grep -v '^```' |
        ${CC:-cc} -std=c17 -x c -Wall -Wextra -Werror -fsyntax-only -I convert - 2>&1)"

none "C++ is only where a library has no C interface" \
    "$(find "${folders[@]}" tests examples -name '*.cpp' -o -name '*.cc' -o -name '*.hpp' |
        grep -v -x -E 'convert/oiio(_write\.cpp|_guard\.hpp|\.cpp)|color/ocio\.cpp')"

text=$(find CMakeLists.txt README.md LICENSE .clang-format "${folders[@]}" tests examples -type f \
    ! -path 'tests/fuzz/corpus/*' ! -path '*/__pycache__/*' ! -name '*.png' ! -name '*.exr' ! -name test_structure.sh)
# shellcheck disable=SC2086
{
    none "no path of one machine in any file" "$(grep -n -E '(^|[^.A-Za-z])/(work|home|root|Users)/' $text)"
    none "no tabs, no blanks at line ends" "$(grep -n -P '\t|[ \t]+$' $text | grep -v '^tests/.*tsv')"
    none "every file ends in a newline" \
        "$(for file in $text; do [ -z "$(tail -c 1 "$file")" ] || echo "$file"; done)"
    none "C lines have at most 100 columns" \
        "$(awk 'length($0) > 100 {print FILENAME ":" FNR}' $(printf '%s\n' $text | grep -E '\.(c|h|cpp)$'))"
    none "nothing is left to do" "$(grep -n -E '\<(TO[D]O|FIX[M]E|XX[X])\>' $text)"
}

[ $failures = 0 ] || echo "$failures of the checks above FAILED"
exit $((failures != 0))
