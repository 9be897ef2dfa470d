#!/bin/bash
# The Debian packages in a bare Debian 12: built for /usr with Debian's flags, clean under lintian, installed,
# every line of README.md and of the three guides run with them, and removed: nothing is left. Wants root, and a
# mirror of Debian; $PACKAGES_ROOT and $PACKAGES_BUILD keep the root and the build directory.
set -eu
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
. "$source_dir/tests/campaign/root.bash"
wants_root
version=$(sed -n 's/^#define WEFT_VERSION "\(.*\)"/\1/p' "$source_dir/convert/weft.h")
packages=(weft libweft0 libweft-dev python3-weft weft-plugins)
make_root "${PACKAGES_ROOT:-}" --include=ca-certificates,ffmpeg,openimageio-tools,gcc,libc6-dev,pkg-config
build=${PACKAGES_BUILD:-$root/build}

# ---- Building ----

eval "$(DEB_BUILD_MAINT_OPTIONS=hardening=+all DEB_CFLAGS_MAINT_STRIP="-g -O2" DEB_CXXFLAGS_MAINT_STRIP="-g -O2" \
    dpkg-buildflags --export=sh)"
export CFLAGS="$CFLAGS $CPPFLAGS" CXXFLAGS="$CXXFLAGS $CPPFLAGS"
cmake -S "$source_dir" -B "$build" -G Ninja -DBUILD_TESTING=OFF -DCMAKE_INSTALL_PREFIX=/usr
cmake --build "$build" -j "${PACKAGES_JOBS:-$(nproc)}"
mkdir -p "$root/debs"
rm -f "$root"/debs/*
cpack -G DEB --config "$build/CPackConfig.cmake" -B "$root/debs"
rm -rf "$root/debs/_CPack_Packages"
if command -v lintian >/dev/null; then
    lintian --fail-on error,warning --allow-root "$root"/debs/*.deb
    echo "lintian has nothing to say"
else
    echo "skipped: no lintian"
fi

# ---- Installing, using, removing ----

mkdir -p "$root/try/out"
"$build/make_subframes" "$root/try/out/subframes" 128
config=${WEFT_SHARED:-$source_dir/../shared}/data/ocio/cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio
[ ! -r "$config" ] || { mkdir -p "$root/try/files" && cp "$config" "$root/try/files/studio.ocio"; }
cp "$source_dir/tests/campaign/guides.bash" "$root/try"

# What there is, but for the system's caches, logs and lists, and what is tried.
cat >"$root/debs/list.sh" <<'END'
find / -xdev \( -path /proc -o -path /dev -o -path /sys -o -path /try -o -path /debs -o -path /tmp -o -path /build -o -path /var/cache \
    -o -path /var/log -o -path /run.sh -o -path /var/lib/apt -o -path /var/lib/dpkg/triggers \) -prune -o -print | grep -v '^/var/lib/dpkg/[a-z-]*$' | sort
END
in_root <<END
set -eu
apt-get -qq update
apt-get -qq install -y --no-install-recommends /debs/*.deb
dpkg --purge ${packages[*]}
bash /debs/list.sh >/debs/before
! grep weft /debs/before
apt-get -qq install -y --no-install-recommends /debs/*.deb
test "\$(weft --version)" = "weft $version"
python3 -c 'import weft; assert weft.__version__ == "$version"; print(weft.library_path)'
test -r /usr/share/man/man1/weft.1.gz
ldconfig -p | grep libweft.so.0
cd /try
ln -sfn /usr/share/doc/weft/examples examples
. ./guides.bash
try_guides /usr/share/doc/weft/README.md || exit 1
cd /
dpkg --purge ${packages[*]}
bash /debs/list.sh >/debs/after
END
diff "$root/debs/before" "$root/debs/after"
echo "nothing is left of the packages"
