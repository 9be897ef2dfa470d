# shellcheck shell=bash disable=SC2034
# Which Debian packages weft needs, and their installation. Sourced by tests/run.sh and
# examples/quickstart.sh (bash).

build_packages=(build-essential cmake ninja-build pkg-config libopenexr-dev libopenimageio-dev
                libopencolorio-dev libdeflate-dev libxxhash-dev libcairo2-dev
                liblua5.4-dev libjansson-dev libavformat-dev libavcodec-dev
                libswresample-dev libavfilter-dev)
test_packages=(libcmocka-dev clang libclang-rt-14-dev libomp-14-dev ffmpeg mediainfo python3
               openimageio-tools openexr chromium mandoc groff-base zsh fish python3-numpy parallel
               slurmctld slurmd slurm-client iproute2 lintian file mkdocs doxygen hunspell hunspell-en-us)
# What the campaigns of `tests/run.sh all` need besides.
campaign_packages=(blender povray mmdebstrap)

# Prints those of the packages named that are not installed.
missing_packages()
{
    local package
    for package in "$@"; do
        [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] ||
            echo "$package"
    done
}

apt_get()
{
    local root=()
    [ "$(id -u)" = 0 ] || root=(sudo)
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 "$@"
}

# Runs a command during which packages start no services: tests start their own.
without_services()
{
    local root=() policy=/usr/sbin/policy-rc.d
    [ "$(id -u)" = 0 ] || root=(sudo)
    if [ -e $policy ]; then
        "$@"
        return
    fi
    (
        trap '"${root[@]}" rm -f $policy' EXIT
        printf '#!/bin/sh\nexit 101\n' | "${root[@]}" tee $policy >/dev/null
        "${root[@]}" chmod +x $policy
        "$@"
    )
}

# Installs those of the packages named that are missing. Where that is not possible it says which
# are and fails.
install_packages()
{
    if ! command -v dpkg-query >/dev/null; then
        echo "This is not a Debian system: what these packages hold has to be there already:"
        echo "  $*"
        return 0
    fi
    local missing
    mapfile -t missing < <(missing_packages "$@")
    if [ ${#missing[@]} = 0 ]; then
        echo "All packages are installed."
        return 0
    fi
    echo "Installing: ${missing[*]}"
    if [ "$(id -u)" != 0 ] && ! command -v sudo >/dev/null; then
        echo "That needs root or sudo. As root: apt-get install ${missing[*]}" >&2
        return 1
    fi
    local package log
    log=$(mktemp)
    apt_get update >"$log" 2>&1
    if ! without_services apt_get install -y --no-install-recommends "${missing[@]}" >>"$log" 2>&1; then
        cat "$log" >&2
        # One that cannot be had must not keep the others away.
        for package in "${missing[@]}"; do
            without_services apt_get install -y --no-install-recommends "$package" >/dev/null 2>&1
        done
    fi
    rm -f "$log"
    mapfile -t missing < <(missing_packages "$@")
    [ ${#missing[@]} = 0 ] && return 0
    echo "Could not be installed: ${missing[*]}" >&2
    return 1
}
