# shellcheck shell=bash
# What campaigns in a bare Debian 12 share: its root directory, made and removed. Sourced.
root=

# wants_root: the script is skipped where no root can be made.
wants_root()
{
    command -v mmdebstrap >/dev/null || { echo "skipped: no mmdebstrap"; exit 77; }
    [ "$(id -u)" = 0 ] || { echo "skipped: not root"; exit 77; }
}

# make_root FOLDER OPTION..: $root is a Debian that mmdebstrap makes; in FOLDER it is kept, and taken
# as it is the next time, else it is removed at the end.
make_root()
{
    root=$1
    shift
    [ -n "$root" ] || { root=$(mktemp -d) && removed=$root; }
    trap 'leave_root' EXIT
    chmod 755 "$root" 2>/dev/null || true
    [ -d "$root/usr" ] || mmdebstrap --variant=minbase "$@" bookworm "$root"
    cp /etc/resolv.conf "$root/etc/resolv.conf"
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    mount --make-rslave "$root/dev"
}

leave_root()
{
    umount -R "$root/proc" "$root/dev" 2>/dev/null || true
    [ -z "${removed:-}" ] || rm -rf --one-file-system "$removed"
}

# put_source: the files of the last commit, in /weft.
put_source()
{
    rm -rf --one-file-system "$root/weft"
    mkdir -p "$root/weft"
    git -C "$source_dir" archive HEAD | tar -x -C "$root/weft"
}

# in_root: runs the script on standard input in the root, by a bash with nothing on its own.
in_root()
{
    cat >"$root/run.sh"
    chroot "$root" env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
        DEBIAN_FRONTEND=noninteractive bash /run.sh </dev/null
}
