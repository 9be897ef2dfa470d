#!/bin/bash
# Installs the build and uses it from outside: the program, pkg-config and find_package, with the
# shared library and, from a second build, with the static one; and the lines of README.md as printed,
# under /usr/local.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized never
version=$(sed -n 's/^#define WEFT_VERSION "\(.*\)"/\1/p' "$WEFT_SOURCE/convert/weft.h")

cat >user.c <<'END'
#include <stdio.h>
#include <string.h>
#include <weft.h>

int main(void)
{
    weft_error error = {""};
    weft_raster raster;
    weft_job *job = weft_job_new();
    char numbers[32];
    snprintf(numbers, sizeof numbers, "%d.%d.%d", WEFT_VERSION_MAJOR, WEFT_VERSION_MINOR, WEFT_VERSION_PATCH);
    bool ok = job && strcmp(weft_version(), WEFT_VERSION) == 0 && strcmp(numbers, WEFT_VERSION) == 0;
    ok = ok && weft_raster_parse("525i", &raster, &error) == WEFT_OK && raster.lines == 486;
    ok = ok && weft_raster_parse("526i", &raster, &error) == WEFT_USAGE && error.text[0];
    weft_job_free(job);
    printf("%s %s\n", weft_version(), error.text);
    return !ok;
}
END
cp user.c user.cpp
mkdir user
cp user.c user
cat >user/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.16)
project(user C)
find_package(weft 0.2 REQUIRED)
add_executable(user user.c)
target_link_libraries(user PRIVATE weft::weft)
END

# installed BUILD PREFIX
installed() { exits 0 cmake --install "$1" --prefix "$2"; }

# compiled COMPILER FILE STANDARD: against what pkg-config says; it runs.
# shellcheck disable=SC2046,SC2086
compiled() { exits 0 $1 -std=$3 "$2" -o by-pkg-config $(pkg-config --cflags --libs $static weft) && exits 0 ./by-pkg-config; }

by_cmake()
{
    rm -rf user-build
    cmake -S user -B user-build -DCMAKE_PREFIX_PATH="$1" >/dev/null && cmake --build user-build >/dev/null &&
        exits 0 env -u LD_LIBRARY_PATH user-build/user
}

# use PREFIX [--static]: the user's program in three ways.
use()
{
    static=${2:-}
    local libdir
    libdir=$(dirname "$(find "$1" -name pkgconfig)")
    export PKG_CONFIG_PATH=$libdir/pkgconfig LD_LIBRARY_PATH=$libdir
    check "pkg-config $static" same "$(pkg-config --modversion weft)" "$version"
    check "C by pkg-config $static" compiled "$CC" user.c c17
    check "C++ by pkg-config $static" compiled "$CXX" user.cpp c++17
    check "C by find_package $static" by_cmake "$1"
    unset PKG_CONFIG_PATH LD_LIBRARY_PATH
}

# ---- The shared library ----

check "install" installed "$WEFT_BUILD" "$work/shared"
use "$work/shared"
for file in include/weft.h share/weft/weft.ocio share/doc/weft/LICENSE share/doc/weft/README.md \
    share/doc/weft/examples/quickstart.sh share/man/man1/weft.1 lib/python3/dist-packages/weft/__init__.py \
    share/bash-completion/completions/weft share/zsh/site-functions/_weft \
    share/fish/vendor_completions.d/weft.fish; do
    check "$file" test -f "shared/$file"
done
mv shared moved
check "the program, moved from where it was built for" exits 0 moved/bin/weft --version
check "tells its version" prints "$version"
check "and finds its modules" exits 0 moved/bin/weft filters shaped --plot shaped.png
check "to plot" png shaped.png

# ---- What the quick start builds can be installed ----

check "the quick start builds all" test -z "$(grep -e '--target' "$WEFT_SOURCE/examples/quickstart.sh")"

# ---- README.md, as printed ----

# In namespaces of its own, where /etc and /usr/local are others: nothing is left on this machine.
cat >private.sh <<'END'
set -e
mkdir -p local aux && cp -a /etc etc
mount --bind etc /etc && mount --bind local /usr/local
[ ! -d /var/cache/ldconfig ] || mount --bind aux /var/cache/ldconfig
cmake --install "$WEFT_BUILD" --prefix /usr/local >/dev/null
cd readme
eval "$(grep '^    weft .* out/' "$WEFT_SOURCE/README.md" | sed 's/$/ || exit 1/')"
sed -n '/^```c$/,/^```$/p' "$WEFT_SOURCE/README.md" | sed '/^```/d' >shot.c
eval "$(grep '^ *cc shot.c ' "$WEFT_SOURCE/README.md")"
./a.out
sed -n '/^```python$/,/^```$/p' "$WEFT_SOURCE/README.md" | sed '/^```/d' >shot.py
PATH=/usr/bin:/bin python3 shot.py
PATH=/usr/bin:/bin python3 -c 'import weft; print(weft.library_path)'
man -w weft 2>/dev/null || ls /usr/local/share/man/man1/weft.1
END
# Of what the quick start makes as much as the order of fields can be seen in.
subframes readme/out/subframes 64
namespace=(unshare --mount)
[ "$(id -u)" = 0 ] || namespace+=(--user --map-root-user)
case $(command -v cmake cc pkg-config) in */usr/local/*) namespace=(false) ;; esac
if ! "${namespace[@]}" bash -c 'mkdir -p try && mount --bind try /usr/local' 2>/dev/null; then
    skip_part "README.md under /usr/local: mount namespaces cannot be made, or the compiler lies there"
elif ! /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
    skip_part "README.md under /usr/local: no python3-numpy"
elif ! has_libav; then
    skip_part "README.md under /usr/local: weft was built without libav"
else
    check "the lines of README.md run" exits 0 "${namespace[@]}" env -u PKG_CONFIG_PATH -u LD_LIBRARY_PATH \
        -u PYTHONPATH -u WEFT_LIBRARY bash private.sh
    for video in shot.y4m shot.mxf shot_625i.y4m; do check "and made $video" test -s readme/out/$video; done
    check "Python has the library that was installed" prints /usr/local/lib
fi

# ---- The static library ----

cmake -S "$WEFT_SOURCE" -B static-build -G Ninja -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF \
    -DCMAKE_C_COMPILER="$CC" -DCMAKE_CXX_COMPILER="$CXX" -DCMAKE_BUILD_TYPE=Debug >/dev/null
check "a static build" exits 0 cmake --build static-build
check "is installed" installed static-build "$work/static"
use "$work/static" --static

finish
