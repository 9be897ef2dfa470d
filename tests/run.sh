#!/bin/bash
# Installs what is missing, builds weft and runs every test: a Release build with GCC, then one
# with clang under AddressSanitizer and UndefinedBehaviorSanitizer, with the fuzz targets, then one
# under ThreadSanitizer for the test programs.
#
#     tests/run.sh            everything
#     tests/run.sh release    only the steps named: release, sanitize, thread
#
# JOBS is how many compilers and tests run at once (default: one a core); WEFT_SHARED a directory
# of sample data, without which some tests say that they were skipped.

set -u
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$source_dir" || exit 1
. tests/packages.sh

jobs=${JOBS:-$(nproc)}
steps=("$@")
[ $# != 0 ] || steps=(release sanitize thread)
results=()
status=0

heading() { printf '\n==== %s\n' "$*"; }

# Records how a step ended.
finish()
{
    local name=$1 code=$2 began=$3
    local verdict=passed
    [ "$code" = 0 ] || verdict=FAILED status=1
    results+=("$(printf '%-28s %s (%d s)' "$name" "$verdict" $((SECONDS - began)))")
}

# Configures and builds into a directory: build DIRECTORY CMAKE-OPTION...
build()
{
    local directory=$1 generator=()
    shift
    [ -f "$directory/CMakeCache.txt" ] || generator=(-G Ninja)
    cmake -S . -B "$directory" "${generator[@]}" -DBUILD_TESTING=ON -DWEFT_WERROR=ON "$@" \
        >"$directory.log" 2>&1 || { cat "$directory.log"; return 1; }
    rm -f "$directory.log"
    cmake --build "$directory" --parallel "$jobs"
}

# Runs the tests of a build: check DIRECTORY CTEST-OPTION...
check()
{
    local directory=$1
    shift
    ctest --test-dir "$directory" --output-on-failure --parallel "$jobs" "$@"
}

step_release()
{
    heading "Release build in build/"
    build build -DCMAKE_BUILD_TYPE=Release || return 1
    heading "Tests of the Release build"
    check build
}

step_sanitize()
{
    heading "AddressSanitizer and UndefinedBehaviorSanitizer build in build-sanitize/"
    CC=clang CXX=clang++ build build-sanitize -DCMAKE_BUILD_TYPE=RelWithDebInfo \
        -DWEFT_SANITIZE=address,undefined -DWEFT_FUZZ=ON || return 1
    heading "Tests and fuzz targets under the sanitizers"
    check build-sanitize
}

step_thread()
{
    heading "ThreadSanitizer build in build-thread/"
    CC=clang CXX=clang++ build build-thread -DCMAKE_BUILD_TYPE=RelWithDebInfo \
        -DWEFT_SANITIZE=thread || return 1
    heading "Test programs under ThreadSanitizer"
    check build-thread --label-regex program
}

for step in "${steps[@]}"; do
    if ! declare -F "step_$step" >/dev/null; then
        echo "run.sh: no step named '$step': release, sanitize, thread" >&2
        exit 2
    fi
done

heading "Debian packages"
began=$SECONDS
install_packages "${build_packages[@]}" "${test_packages[@]}"
finish packages $? "$began"
for step in "${steps[@]}"; do
    began=$SECONDS
    "step_$step"
    finish "$step" $? "$began"
done

heading "Summary"
printf '%s\n' "${results[@]}"
if [ $status = 0 ]; then echo "All passed."; else echo "Something FAILED: see above."; fi
exit $status
