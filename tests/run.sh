#!/bin/bash
# Installs what is missing, builds weft and runs its tests: a Release build with GCC, then one with
# clang under AddressSanitizer and UndefinedBehaviorSanitizer, with the fuzz targets, then one under
# ThreadSanitizer for what has threads. On two cores that takes a quarter of an hour at most.
#
#     tests/run.sh            the steps release, sanitize, thread
#     tests/run.sh release    only the steps named
#     tests/run.sh coverage   how many lines of each room the tests of an ordinary build run
#     tests/run.sh all        every step at full length, and the campaigns: hours
#
# JOBS is how many compilers and tests run at once (default: one a core); WEFT_SHARED a directory
# of sample data, without which some tests say that they were skipped.

set -u
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$source_dir" || exit 1
. tests/packages.sh

jobs=${JOBS:-$(nproc)}
long=OFF fuzz_seconds=5
packages=("${build_packages[@]}" "${test_packages[@]}")
steps=("$@")
[ $# != 0 ] || steps=(release sanitize thread)
if [ "$*" = all ]; then
    long=ON fuzz_seconds=120
    steps=(release sanitize thread coverage campaigns)
    packages+=("${campaign_packages[@]}")
fi
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

# Configures and builds into a directory: build DIRECTORY TARGET CMAKE-OPTION...
build()
{
    local directory=$1 target=$2 generator=()
    shift 2
    [ -f "$directory/CMakeCache.txt" ] || generator=(-G Ninja)
    cmake -S . -B "$directory" "${generator[@]}" -DBUILD_TESTING=ON -DWEFT_WERROR=ON \
        -DWEFT_LONG_TESTS=$long -DWEFT_FUZZ_SECONDS=$fuzz_seconds "$@" >"$directory.log" 2>&1 ||
        { cat "$directory.log"; return 1; }
    rm -f "$directory.log"
    cmake --build "$directory" --parallel "$jobs" --target "$target"
}

# Runs the tests of a build, and tells which took longest: check DIRECTORY CTEST-OPTION...
check()
{
    local directory=$1 code
    shift
    ctest --test-dir "$directory" --output-on-failure --parallel "$jobs" "$@" | tee "$directory/tests.log"
    code=${PIPESTATUS[0]}
    printf '\nThe slowest, in seconds (20 are what a test may take on two quiet cores):\n'
    sed -n 's/^ *[0-9]*\/[0-9]* Test *#[0-9]*: \([^ ]*\) .* \([0-9.]*\) sec.*/\2 \1/p' "$directory/tests.log" |
        sort -rn | head -n 10
    return "$code"
}

step_release()
{
    heading "Release build in build/"
    build build all -DCMAKE_BUILD_TYPE=Release || return 1
    heading "Tests of the Release build"
    check build
}

step_sanitize()
{
    heading "AddressSanitizer and UndefinedBehaviorSanitizer build in build-sanitize/"
    CC=clang CXX=clang++ build build-sanitize all -DCMAKE_BUILD_TYPE=RelWithDebInfo \
        -DWEFT_SANITIZE=address,undefined -DWEFT_FUZZ=ON || return 1
    heading "Tests and fuzz targets under the sanitizers"
    check build-sanitize
}

step_thread()
{
    heading "ThreadSanitizer build in build-thread/"
    CC=clang CXX=clang++ build build-thread threaded-tests -DCMAKE_BUILD_TYPE=RelWithDebInfo \
        -DWEFT_SANITIZE=thread || return 1
    heading "What has threads, under ThreadSanitizer"
    check build-thread --label-regex threads
}

step_coverage()
{
    heading "Build that counts lines in build-coverage/"
    # At -O1 GCC warns of lengths that it knows at -O3; that is no matter of coverage.
    build build-coverage all -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG="-O1 -g" \
        -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g" -DWEFT_COVERAGE=ON -DWEFT_WERROR=OFF || return 1
    find build-coverage -name '*.gcda' -delete
    heading "Its tests"
    # A library that counts lines has symbols and state of its own; no time is like that of others, and
    # what counts dies itself where memory fails.
    check build-coverage --exclude-regex '^(structure|install|bench|live|faults_memory|fuzz-.*)$' || return 1
    heading "Lines that the tests run"
    tests/coverage.sh build-coverage
}

# What takes programs and minutes that a test must not: each script of tests/campaign says what it does.
step_campaigns()
{
    local script failed=0
    for script in tests/campaign/*.sh; do
        heading "$script"
        WEFT_BUILD=$source_dir/build bash "$script" || { [ $? = 77 ] || failed=1; }
    done
    return $failed
}

for step in "${steps[@]}"; do
    if ! declare -F "step_$step" >/dev/null; then
        echo "run.sh: no step named '$step': release, sanitize, thread, coverage, campaigns; or all" >&2
        exit 2
    fi
done

heading "Debian packages"
began=$SECONDS
install_packages "${packages[@]}"
finish packages $? "$began"
for step in "${steps[@]}"; do
    began=$SECONDS
    "step_$step"
    finish "$step" $? "$began"
done

heading "Summary"
printf '%s\n' "${results[@]}"
printf '%-28s %d s\n' "in all" "$SECONDS"
if [ $status = 0 ]; then echo "All passed."; else echo "Something FAILED: see above."; fi
exit $status
