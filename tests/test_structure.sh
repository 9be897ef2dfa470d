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

# ---- Rooms ----

# Which folder may include which, one row a folder; what is not said is not allowed. A folder may
# always include its own. Rows name rows before them only, so there is no circle.
imports='
filters/base        :
filters/aperture    : filters/base
filters/raster      : filters/base filters/aperture
filters/resample    : filters/base filters/aperture filters/raster
filters/gather      : filters/base filters/aperture filters/raster
filters/seen        : filters/base
filters/least       : filters/base
color/line          : filters/base
color/space         : filters/base color/line
color/space/ocio    : color/line color/space
color/codes         : filters/base color/line color/space
color/composite     : filters/base color/line
tracer/scene        : filters/base
tracer/rays         : filters/base tracer/scene
tracer/trace        : filters/base tracer/scene tracer/rays
tracer/sample       : filters/base filters/aperture filters/raster filters/gather tracer/scene tracer/trace
convert/base        : filters/base
convert/job         : filters/* color/* tracer/sample convert/base
convert/media       : filters/* color/* convert/base convert/job
convert/media/oiio  : filters/* convert/base convert/job convert/media
convert/media/libav : filters/* color/* convert/base convert/job convert/media
convert/media/deinterlace : filters/* convert/base convert/job convert/media
convert/media/structure : convert/base convert/media
convert/read/choice :
convert/read/exr    : filters/base convert/base convert/read/choice
convert/read        : filters/* color/* tracer/scene convert/base convert/job convert/media convert/media/* convert/read/choice convert/read/exr
convert/video       : filters/* color/* convert/base convert/job convert/media convert/read
convert/sound       : filters/* convert/base convert/job convert/media convert/read
convert/write       : filters/* color/* convert/base convert/job convert/media convert/media/*
convert/finish      : filters/* color/* convert/base convert/job convert/read convert/sound convert/write
convert/run/time    : filters/* color/* convert/base convert/job convert/media convert/read convert/finish convert/video
convert/run/sum     : filters/* tracer/* convert/base convert/job convert/media convert/read convert/finish
convert/run/source  : filters/* color/* tracer/* convert/base convert/job convert/media convert/read convert/video convert/finish convert/run/time convert/run/sum
convert/run         : filters/* color/* tracer/* convert/base convert/job convert/media convert/read convert/write convert/video convert/finish convert/run/time convert/run/sum convert/run/source
convert/plan        : filters/* convert/base convert/job convert/media convert/read convert/run convert/run/source convert/run/time
convert/check       : filters/* color/* convert/base convert/job convert/media convert/media/deinterlace convert/read convert/finish
convert/check/verify : filters/* color/* convert/base convert/job convert/media convert/media/* convert/read convert/check
convert/plot        : convert/base
convert/page        : filters/* color/* convert/base convert/job convert/media convert/read convert/write convert/check
convert/ask         : filters/* color/* convert/base convert/job convert/media convert/read convert/sound convert/video convert/run convert/check convert/check/verify convert/plot convert/page convert/finish
convert/program     : filters/* color/* tracer/* convert/base convert/job convert/media convert/read convert/sound convert/write convert/video convert/run convert/check convert/check/verify convert/ask convert/page
convert/program/plan : convert/base convert/job convert/plan convert/program
convert/program/page : filters/* convert/base convert/job convert/page convert/program
convert             : filters/* color/* tracer/* convert/base convert/job convert/run convert/check
'
# The public header belongs to no room, and what the build makes of color/weft.ocio and of the page's sources are strings.
everywhere='convert/weft\.h|color/weft_ocio\.inc|convert/page_assets\.inc'

# FILE INCLUDED, for every include of ours.
quoted_includes()
{
    find "${folders[@]}" -name '*.[ch]' -o -name '*.[ch]pp' |
        xargs grep -H -o -E '^ *# *include +"[^"]+"' | sed -E 's/: *# *include +"([^"]+)"/ \1/' |
        grep -v -E " ($everywhere)\$"
}

# Of FILE INCLUDED lines those that the table does not allow, and rows that name later ones.
against_the_table()
{
    awk -v table="$imports" '
        function folder(path) { sub("/[^/]*$", "", path); return path }
        function may(from, to,    i) {
            for (i = 1; i <= count[from]; i++) {
                if (allowed[from, i] == to) return 1
                if (allowed[from, i] ~ /\*$/ && index(to, substr(allowed[from, i], 1, length(allowed[from, i]) - 1)) == 1) return 1
            }
            return from == to
        }
        BEGIN {
            rows = split(table, row, "\n")
            for (r = 1; r <= rows; r++) {
                words = split(row[r], word, " ")
                if (!words) continue
                for (w = 3; w <= words; w++) {
                    allowed[word[1], w - 2] = word[w]
                    if (word[w] !~ /\*$/ && !(word[w] in known)) print "the row of " word[1] " names " word[w] " before its own row"
                }
                count[word[1]] = words - 2
                known[word[1]] = 1
            }
        }
        !(folder($1) in known) { print $1 ": its folder has no row in the table" }
        !may(folder($1), folder($2)) { print $1 " includes " $2 }'
}
includes=$(quoted_includes)
none "every import is one that the table allows" "$(echo "$includes" | against_the_table)"
none "an import that goes up is found" \
    "$(echo 'filters/base/isa.c convert/run/sum/flow.h' | against_the_table | grep -q 'isa.c includes' || echo 'it is not')"
none "hot loops begin alike, and are found by WF_ISA_DISPATCH alone" \
    "$(find "${folders[@]}" -name '*_isa.c' | xargs grep -L '^#include "filters/base/isa_file.h"$'
        grep -rn -E '# *define WF_ISA\>|_v[134]\>|__builtin_cpu_' "${folders[@]}" --include='*.[ch]' |
            grep -v -E '^filters/base/isa(_file)?\.[ch]:')"
# Files that somebody tried something with are not committed beside them.
top='\.clang-format|\.gitignore|CMakeLists\.txt|LICENSE|README\.md|\.ci|convert|tracer|filters|color|tests|examples'
none "the top level holds nothing but what README tells of" \
    "$(git ls-files 2>/dev/null | cut -d/ -f1 | sort -u | grep -vxE "$top")"

none "no folder has more than 40 files" \
    "$(find "${folders[@]}" tests examples -type f ! -path '*/__pycache__/*' ! -path 'examples/*/pictures/*' |
        sed 's#/[^/]*$##' | sort | uniq -c | awk '$1 > 40 {print $2, $1}')"
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
        grep -v -x -E 'convert/media/oiio/[a-z_]*\.[ch]pp|color/space/ocio/[a-z_]*\.[ch]pp')"

text=$(find CMakeLists.txt README.md LICENSE .clang-format "${folders[@]}" tests examples -type f \
    ! -path 'tests/fuzz/corpus/*' ! -path '*/__pycache__/*' ! -name '*.png' ! -name '*.exr' ! -name test_structure.sh)

# ---- Words and sizes ----

# What is wrong with the files named, one a line: FILE:LINE.
without_opener() { awk 'FNR == 1 && !/^\/[*\/]/ { print FILENAME ":1" }' "$@"; }
cited_pages()
{
    grep -n -E '\<(cli|colour|flicker|house|input|key|measure|performance|plan|rasters|resampling|samples|shutter|speed2|style|tracer)\.md\>' \
        /dev/null "$@"
}
british_words()
{
    grep -n -i -E 'colour|centre|\<grey|neighbour|behaviour|favour|honour|licence|labell(ed[^b]|ing)|(normal|quant|organ|initial|optim|recogn)is(e|ing|ation)' \
        /dev/null "$@"
}
words_of_before()
{
    grep -n -E '\<(wf_)?(foresee|collide|unshelf|shelve)[a-z_]*\>|\<wf_(near|spread|mend|strips|shelf|claims|turns|twice)(_[a-z_]*)?\>|"[a-z/]*/(near|spread|mend|strips|shelf|foresee|collide|claims|turns|twice)\.h"' \
        /dev/null "$@"
}
# Functions over 45 lines. A definition begins in the first column, and so does the brace that ends it.
long_functions()
{
    awk 'FNR == 1 { within = 0 }
        !within && /^[A-Za-z]/ { head = FNR }
        !within && /\) (noexcept )?\{$/ { within = 1 }
        /^\}/ { if (within && FNR - head >= 45) print FILENAME ":" head ": " FNR - head + 1 " lines"; within = 0 }' "$@"
}

c_files=$(sources -name '*.c' -o -name '*.cpp' | sort)
c_tests=$(find tests examples -name '*.c')
# shellcheck disable=SC2086
{
    none "every source file opens with what it is for" "$(without_opener $c_files $c_tests)"
    none "no page is cited that is not in the repository" "$(cited_pages $text)"
    none "spelling is American" "$(british_words $text)"
    none "no words of before" "$(words_of_before $text)"
    none "no function is over 45 lines" "$(long_functions $c_files)"
}
for room in convert convert/run convert/finish convert/read convert/write filters color tracer tests; do
    none "$room has its page" "$([ -s $room/README.md ] || echo "$room/README.md")"
done

# Each of these finds what it is for.
sin=$(mktemp --suffix .c)
{
    echo 'static void wf_spread_all(void) { }'
    echo '// As resampling.md has it, in Colour.'
    printf '%s\n' 'int long_one(void) {' "$(yes '    f();' | head -n 44)" '}'
} >"$sin"
for finder in without_opener cited_pages british_words words_of_before long_functions; do
    none "$finder finds one" "$([ "$($finder "$sin" | wc -l)" = 1 ] || { echo "not so:"; $finder "$sin"; })"
done
rm -f "$sin"

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
