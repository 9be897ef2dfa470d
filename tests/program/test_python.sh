#!/bin/bash
# The Python package of convert/python: its tests, its example, and installed in two ways.
. "$WEFT_SOURCE/tests/program/script.sh"
python=
for candidate in /usr/bin/python3 python3; do
    "$candidate" -c 'import numpy' 2>/dev/null && python=$candidate && break
done
if [ -z "$python" ]; then
    skip "no Python with NumPy (package python3-numpy)"
fi
[[ ${WEFT_SANITIZE:-} != *thread* ]] || skip "Python is not built for ThreadSanitizer"
export PYTHONDONTWRITEBYTECODE=1 WEFT
unset WEFT_LIBRARY PYTHONPATH
package=$WEFT_BUILD/lib/python3/dist-packages

# run ARGUMENT..: Python, with the runtime that libweft was instrumented for. What Python itself
# keeps to its end is no leak of ours.
run()
{
    local preload=()
    ! is_sanitized || preload=(ASAN_OPTIONS=detect_leaks=0
        LD_PRELOAD="$("$CC" -print-file-name=libclang_rt.asan-x86_64.so) $("$CC" -print-file-name=libstdc++.so.6)")
    timeout 500 env "${preload[@]}" "$python" "$@"
}

PYTHONPATH=$package run "$WEFT_SOURCE/tests/program/python_binding.py" >out 2>&1
check "tests of the package" test $? = 0
[ $failed = 0 ] || cat out
grep -E '^Ran' out

export PYTHONPATH=$package
check "the example" exits 0 run "$WEFT_SOURCE/examples/push_samples.py" ring.y4m 2
check "tells of fields" prints "field 3: mean 0."
check "and writes them" test "$(stat -c %s ring.y4m)" -gt 2799360
check "its failures" exits 1 run "$WEFT_SOURCE/examples/push_samples.py" ring.y4m 2
check "are weft's" says "ring.y4m exists"

if ! is_sanitized; then
    # where: which library a package takes, and that it works.
    where='import weft; weft.raster("525i"); print(weft.library_path)'
    check "the build's library" exits 0 run -c "$where"
    check "is beside the package" prints "$WEFT_BUILD/lib/libweft.so"
    cmake --install "$WEFT_BUILD" --prefix "$work/first" >/dev/null
    mv first moved
    export PYTHONPATH=$work/moved/lib/python3/dist-packages
    check "installed and moved" exits 0 run -c "$where"
    check "it takes its own" prints "$work/moved/lib"
    cp -r "$WEFT_SOURCE/convert/python" source
    if "$python" -m pip --version >/dev/null 2>&1; then
        check "pip" exits 0 "$python" -m pip install -q --no-index --no-build-isolation --no-deps \
            --target "$work/by-pip" ./source
        export PYTHONPATH=$work/by-pip
        check "without libweft" exits 1 run -c "$where"
        check "it says what to do" says "set WEFT_LIBRARY"
        library=$(ls "$work"/moved/lib/libweft.so.? "$work"/moved/lib/*/libweft.so.? 2>/dev/null)
        export WEFT_LIBRARY=$library
        check "with WEFT_LIBRARY" exits 0 run -c "$where"
        unset WEFT_LIBRARY
        check "with the loader's path" exits 0 env LD_LIBRARY_PATH="${library%/*}" "$python" -c "$where"
        export WEFT_LIBRARY=libz.so.1
        check "another library" exits 1 run -c "$where"
        check "is no weft" says "libz.so.1 has no weft_version"
    else
        skip_part "no pip for $python (package python3-pip)"
    fi
fi

finish
