#!/bin/bash
# The quick start in a Debian 12 that has nothing but its base, then `cmake --install`, and the C and Python
# of README.md as printed. Wants root, and a mirror of Debian.
set -eu
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
command -v mmdebstrap >/dev/null || { echo "skipped: no mmdebstrap"; exit 77; }
[ "$(id -u)" = 0 ] || { echo "skipped: not root"; exit 77; }
root=$(mktemp -d)
trap 'umount -R "$root/proc" "$root/dev" 2>/dev/null; rm -rf --one-file-system "$root"' EXIT
chmod 755 "$root"
mmdebstrap --variant=minbase --include=ca-certificates,git bookworm "$root"
mkdir "$root/weft"
git -C "$source_dir" archive HEAD | tar -x -C "$root/weft"
cp /etc/resolv.conf "$root/etc/resolv.conf"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mount --make-rslave "$root/dev"
cat >"$root/weft/fresh.sh" <<'END'
set -eux
cd /weft
examples/quickstart.sh
cmake --install build
printed() { sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/p" README.md | sed '/^```/d'; }
printed c >shot.c
eval "$(grep '^ *cc shot.c ' README.md)"
./a.out
apt-get -qq install -y --no-install-recommends python3-numpy
printed python >shot.py
python3 shot.py
weft info out/shot_625i.y4m out/shot.y4m
weft --version
END
chroot "$root" env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive \
    bash /weft/fresh.sh
