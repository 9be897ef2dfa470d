#!/bin/bash
# Prints how many lines of each room the tests of a build have run, and the files with the most that
# they have not: coverage.sh BUILD, configured with WEFT_COVERAGE. gcov comes with GCC.
set -eu
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$(cd "$1" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# A file that is compiled for several levels counts as the level that ran most of it.
find "$build" -path "$build/tests" -prune -o -name '*.gcda' -print0 |
    xargs -0 gcov --no-output --relative-only --source-prefix "$source_dir" 2>/dev/null |
    awk '
        /^File / { file = $2; gsub("\047", "", file) }
        /^Lines executed:/ && file ~ /^(convert|filters|color|tracer)\/.*\.(c|cpp)$/ {
            split($0, part, /[:% ]+/)
            lines = part[5]; ran = part[3] * lines / 100
            if (!(file in most) || ran > most[file]) most[file] = ran
            count[file] = lines
        }
        /^Lines executed:/ || /^No executable/ { file = "" }
        END {
            for (file in count) {
                room = file; sub("/.*", "", room)
                all[room] += count[file]; done[room] += most[file]
                printf "2 %5.1f %% of %5d  %s\n", 100 * most[file] / count[file], count[file], file
            }
            for (room in all) printf "1 %5.1f %% of %5d  %s\n", 100 * done[room] / all[room], all[room], room
        }' | sort -k1,1 -k2,2n | awk '$1 == 1 || n++ < 12' | cut -c3-
