#!/bin/bash
# The Debian packages that CPack makes of this build: what is in them, what they depend on, and that
# together they are what `cmake --install` installs.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized never
needs cpack dpkg-deb dpkg-shlibdeps file
version=$(sed -n 's/^#define WEFT_VERSION "\(.*\)"/\1/p' "$WEFT_SOURCE/convert/weft.h")
modules=$(find "$WEFT_BUILD" -maxdepth 4 -path '*/weft/weft-*.so' -printf '%f\n')
packages=(libweft-dev libweft0 python3-weft weft)
[ -z "$modules" ] || packages+=(weft-plugins)

# field PACKAGE NAME, content PACKAGE: a line of its control file; its files.
field() { dpkg-deb --field "$1"_*.deb "$2"; }
content() { dpkg-deb --fsys-tarfile "$1"_*.deb | tar -t | grep -v '/$' | sed 's/^\.//'; }

# needs_package PACKAGE WORD, lacks_package PACKAGE WORD: what it depends on.
needs_package() { field "$1" Depends | grep -qF -- "$2" || { field "$1" Depends; return 1; }; }
lacks_package() { ! needs_package "$1" "$2" >/dev/null || { field "$1" Depends; return 1; }; }

# holds PACKAGE PATH..: these are among its files.
holds()
{
    local package=$1 path
    shift
    for path; do content "$package" | grep -qE "^$path\$" || { echo "$package has no $path"; return 1; }; done
}

# ---- What is made ----

check "cpack -G DEB" exits 0 cpack -G DEB --config "$WEFT_BUILD/CPackConfig.cmake" -B "$work"
check "makes the packages" same "$(ls ./*.deb | sed 's,^\./,,; s/_.*//' | sort | xargs)" "${packages[*]}"
for package in "${packages[@]}"; do
    content "$package" >"$package.files"
    check "$package: its version" same "$(field "$package" Version)" "$version-1"
    check "$package: copyright, changelogs" holds "$package" /usr/share/doc/"$package"/{copyright,changelog.gz,changelog.Debian.gz}
    check "$package: nothing is a configuration file" test -z "$(dpkg-deb --info "$package"_*.deb conffiles 2>/dev/null)"
    check "$package: a summary of its own" test "$(dpkg-deb --field "$package"_*.deb Description | sed -n 1p | wc -c)" -le 80
    check "$package: a folder may be read by all" test -z "$(dpkg-deb -c "$package"_*.deb | grep -E '^d' | grep -v '^drwxr-xr-x root/root')"
done
check "no summary is another's" test -z "$(for package in "${packages[@]}"; do field "$package" Description | head -n 1; done | sort | uniq -d)"
check "no file is in two packages" test -z "$(cat ./*.files | sort | uniq -d)"
check "no file is outside /usr" test -z "$(cat ./*.files | grep -v '^/usr/')"

# ---- Together they are the installation ----

check "the installation" exits 0 env DESTDIR="$work/all" cmake --install "$WEFT_BUILD" --prefix /usr
(cd all && find . -type f -o -type l) | sed -E 's,^\.,,; s,(/man1/.*),\1.gz,' | grep -v '/doc/weft/LICENSE$' | sort >installed
grep -hvE '/(copyright|changelog(\.Debian)?\.gz)$|/lintian/overrides/' ./*.files | sort >packed
check "every file that is installed is in a package, and no other" diff installed packed

# ---- Which has what ----

check "weft" holds weft /usr/bin/weft /usr/share/man/man1/weft.1.gz /usr/share/bash-completion/completions/weft \
    /usr/share/zsh/site-functions/_weft /usr/share/fish/vendor_completions.d/weft.fish /usr/share/doc/weft/examples/guides/td.md
check "libweft0" holds libweft0 '/usr/lib/.*libweft\.so\.0' '/usr/lib/.*libweft\.so\.'"$version"
check "libweft-dev" holds libweft-dev /usr/include/weft.h '/usr/lib/.*libweft\.so' '/usr/lib/.*/weft\.pc' '/usr/lib/.*/weftConfig\.cmake'
check "python3-weft" holds python3-weft /usr/lib/python3/dist-packages/weft/{__init__.py,py.typed}
for module in $modules; do check "weft-plugins" holds weft-plugins "/usr/lib/.*/$module"; done
check "weft is light" lacks_package weft libav
check "and so is the library" lacks_package libweft0 libopenimageio
check "weft reads OpenEXR" needs_package weft libopenexr
check "weft does without the shared library" lacks_package weft libweft0
check "libweft-dev wants its library" needs_package libweft-dev "libweft0 (= $version-1)"
check "python3-weft wants its library" needs_package python3-weft "libweft0 (= $version-1)"
check "and NumPy" needs_package python3-weft python3-numpy
check "python3-weft is for all machines" same "$(field python3-weft Architecture)" all
! has_libav || check "weft-plugins has libav" needs_package weft-plugins libavcodec
! has_module oiio || check "weft-plugins has OpenImageIO" needs_package weft-plugins libopenimageio
if [ -n "$modules" ]; then
    check "modules are of their program's version" needs_package weft-plugins "weft (= $version-1) | libweft0 (= $version-1)"
    check "which brings them along" same "$(field weft Recommends)" "weft-plugins (= $version-1)"
fi

dpkg-deb --control libweft0_*.deb control
sed -n 's/^ \(.*\)@Base .*/\1/p' control/symbols >symbols
check "libweft0 lists its functions" diff symbols <(grep '^WEFT_API' "$WEFT_SOURCE/convert/weft.h" | grep -o 'weft_[a-z0-9_]*(' | tr -d '(' | LC_ALL=C sort)
check "and since when" same "$(cat control/shlibs)" "libweft ${version%%.*} libweft0 (>= $version)"
check "the loader is told" grep -q ldconfig control/triggers

# ---- Versions ----

check "the changelog begins with this version" same "$(sed -n '/^## /{s/^## \([0-9.]*\),.*/\1/p;q}' "$WEFT_SOURCE/examples/site/changelog.md")" "$version"
check "so does Debian's" same "$(sed -n '1s/.*(\(.*\)).*/\1/p' "$WEFT_SOURCE/convert/packages/changelog")" "$version-1"

# ---- Unpacked they work ----

for package in "${packages[@]}"; do dpkg-deb -x "$package"_*.deb root; done

# dead_links PAGE..: links to files that the packages do not have.
dead_links()
{
    local page link
    for page; do
        while read -r link; do
            [ -e "$(dirname "$page")/$link" ] || echo "$page: $link"
        done < <(grep -oE '\]\([^)#:]+' "$page" | cut -c3-)
    done
}
doc=root/usr/share/doc/weft
mapfile -t pages < <(find $doc/README.md $doc/examples/{guides,tutorial,farm,scenes} -name '*.md')
check "pages to read" test ${#pages[@]} -ge 12
check "lead to what is there" same "$(dead_links "${pages[@]}")" ""
check "the program" exits 0 root/usr/bin/weft --version
check "tells its version" prints "weft $version"
if has_module plot; then
    check "it finds its modules" exits 0 root/usr/bin/weft filters shaped --plot shaped.png
    check "a plot" png shaped.png
fi
if python3 -c 'import numpy' 2>/dev/null; then
    check "Python" exits 0 env -u WEFT_LIBRARY PYTHONPATH=root/usr/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1 \
        python3 -c 'import weft; print(weft.__version__, weft.library_path)'
    check "has the library beside it" prints "$version $work/root/usr/lib/"
fi

if has lintian; then
    check "lintian" exits 0 lintian --fail-on error,warning ./*.deb
    check "has nothing to say" same "$(cat out)" ""
fi

finish
