#!/bin/bash
# Installs the build and uses it from outside: the program, pkg-config and find_package, with the
# shared library and, from a second build, with the static one.

set -eu
if [ -n "${WEFT_SANITIZE:-}" ]; then
    echo "SKIP: an installation is tried with an ordinary build"
    exit 77
fi
version=$(sed -n 's/^#define WEFT_VERSION "\(.*\)"/\1/p' "$WEFT_SOURCE/convert/weft.h")

cat >"$TMPDIR/user.c" <<'END'
#include <stdio.h>
#include <string.h>
#include <weft.h>

int main(void)
{
    weft_error error = {""};
    weft_raster raster;
    weft_job *job = weft_job_new();
    bool ok = job && strcmp(weft_version(), WEFT_VERSION) == 0;
    ok = ok && weft_raster_parse("525i", &raster, &error) == WEFT_OK && raster.lines == 486;
    ok = ok && weft_raster_parse("526i", &raster, &error) == WEFT_USAGE && error.text[0];
    weft_job_free(job);
    printf("%s %s\n", weft_version(), error.text);
    return !ok;
}
END

# Compiles the user's program against PREFIX in both ways and runs it.
use()
{
    local prefix=$1 static=$2 libdir
    libdir=$(dirname "$(find "$prefix" -name pkgconfig)")
    export PKG_CONFIG_PATH=$libdir/pkgconfig LD_LIBRARY_PATH=$libdir
    [ "$(pkg-config --modversion weft)" = "$version" ]
    # shellcheck disable=SC2046
    "$CC" -std=c17 "$TMPDIR/user.c" -o "$TMPDIR/user" $(pkg-config --cflags --libs $static weft)
    "$TMPDIR/user"
    cp "$TMPDIR/user.c" "$TMPDIR/user.cpp"
    # shellcheck disable=SC2046
    "$CXX" -std=c++17 "$TMPDIR/user.cpp" -o "$TMPDIR/user" $(pkg-config --cflags --libs $static weft)
    "$TMPDIR/user"

    rm -rf "$TMPDIR/user-build"
    mkdir -p "$TMPDIR/user-source"
    cp "$TMPDIR/user.c" "$TMPDIR/user-source"
    cat >"$TMPDIR/user-source/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.16)
project(user C)
find_package(weft 0.1 REQUIRED)
add_executable(user user.c)
target_link_libraries(user PRIVATE weft::weft)
END
    cmake -S "$TMPDIR/user-source" -B "$TMPDIR/user-build" -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
    cmake --build "$TMPDIR/user-build" >/dev/null
    env -u LD_LIBRARY_PATH "$TMPDIR/user-build/user"
}

echo "== Shared library"
cmake --install "$WEFT_BUILD" --prefix "$TMPDIR/shared" >/dev/null
use "$TMPDIR/shared" ""
for file in include/weft.h share/weft/weft.ocio share/doc/weft/LICENSE share/doc/weft/README.md \
    share/doc/weft/examples/quickstart.sh share/man/man1/weft.1 \
    share/bash-completion/completions/weft share/zsh/site-functions/_weft \
    share/fish/vendor_completions.d/weft.fish; do
    [ -f "$TMPDIR/shared/$file" ] || { echo "FAILED: $file is not installed"; exit 1; }
done

echo "== Installed program, moved from where it was built for"
mv "$TMPDIR/shared" "$TMPDIR/moved"
program=$TMPDIR/moved/bin/weft
[ "$("$program" --version | grep -c "$version")" = 1 ]
"$program" filters shaped --plot "$TMPDIR/shaped.png"
[ "$(head -c 4 "$TMPDIR/shaped.png" | tail -c 3)" = PNG ]

echo "== Static library"
cmake -S "$WEFT_SOURCE" -B "$TMPDIR/static-build" -G Ninja -DBUILD_SHARED_LIBS=OFF \
    -DBUILD_TESTING=OFF -DCMAKE_C_COMPILER="$CC" -DCMAKE_CXX_COMPILER="$CXX" \
    -DCMAKE_BUILD_TYPE=Debug >/dev/null
cmake --build "$TMPDIR/static-build" >/dev/null
cmake --install "$TMPDIR/static-build" --prefix "$TMPDIR/static" >/dev/null
use "$TMPDIR/static" --static
