#!/usr/bin/env bash
# Builds carom in a Debian 13 of its own and checks there what was made on this machine: the golden
# pictures, and the motion of every scene against that of a program from here.
#   scripts/check_debian13.sh [PROGRAM]
# PROGRAM: whose motions are the reference; default build/release/carom, none if it is not there.
# DEBIAN13: the folder of that system, kept between calls; default out/debian13 (2 GB).
# DEBIAN_MIRROR: where it comes from; default what this machine's apt asks.
# JOBS: of the build; default all processors. Needs root and Debian's package debootstrap.
set -euo pipefail
cd "$(dirname "$0")/.."

program=$(realpath -m "${1:-build/release/carom}")
system=$(realpath -m "${DEBIAN13:-out/debian13}")
jobs=${JOBS:-$(nproc)}
mirror=${DEBIAN_MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' \
    'Created-By: Packages' 'Origin: Debian' 'Label: Debian' | sort -u | head -n 1)}
[ "$(id -u)" -eq 0 ] || { echo "check_debian13: needs root" >&2; exit 1; }
[ -n "$mirror" ] || { echo "check_debian13: set DEBIAN_MIRROR" >&2; exit 1; }

# ---- The system, once -----------------------------------------------------------------------------
if [ ! -e "$system/var/lib/carom-debian13" ]; then
    command -v debootstrap >/dev/null || { echo "check_debian13: install debootstrap" >&2; exit 1; }
    echo "check_debian13: making $system"
    mkdir -p "$system"
    log=$(mktemp)
    debootstrap --variant=minbase trixie "$system" "$mirror" >"$log" 2>&1 || { tail "$log" >&2; exit 1; }
    rm -f "$log"
    touch "$system/var/lib/carom-debian13"
fi

# What is mounted below goes with this shell's namespace.
inside() {
    unshare --mount bash -c '
        set -e
        mkdir -p "$0/carom"
        mount -t proc proc "$0/proc"
        mkdir -p "$0/dev/pts"
        mount -t devpts devpts "$0/dev/pts"
        mount --bind "$1" "$0/carom"
        mount -o remount,bind,ro "$0/carom"
        exec chroot "$0" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
            DEBIAN_FRONTEND=noninteractive bash -c "cd /carom && $2"' "$system" "$PWD" "$1"
}

# ---- Packages and the program ---------------------------------------------------------------------
packages=$(awk '$1 == "film" {print $2}' packages.txt | tr '\n' ' ')
inside "dpkg-query -W $packages >/dev/null 2>&1 ||
    { apt-get update -qq && apt-get install -y -qq --no-install-recommends $packages >/dev/null; }"
inside "cmake -S /carom -B /build -G Ninja -DCMAKE_BUILD_TYPE=Release >/build.log 2>&1 &&
    cmake --build /build --target carom -j $jobs >>/build.log 2>&1 || { tail -n 40 /build.log; false; }"

# ---- The golden pictures --------------------------------------------------------------------------
inside "find scenes -name '*.yaml' -not -path 'scenes/hard/*' -not -path 'scenes/measured/*' | sort |
    xargs /build/carom golden check --dir tests/golden --size 320x180"

# ---- The motions ----------------------------------------------------------------------------------
motions='for scene in $(find scenes -name "*.yaml" | sort); do
    "$CAROM" simulate "$scene" -o - --rate 1 --events "$TMP/e.csv" -y --stats "$TMP/s.json" -q >/dev/null ||
        echo "$scene: exit code $?"
    echo "$scene $(sed -n "s/.*\"motion_hash\": *\"\([^\"]*\)\".*/\1/p" "$TMP/s.json") $(md5sum <"$TMP/e.csv")"
done'
[ -x "$program" ] || { echo "check_debian13: no $program to compare motions with" >&2; exit 0; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
CAROM=$program TMP=$folder bash -c "$motions" >"$folder/here"
printf 'export CAROM=/build/carom TMP=/tmp\n%s\n' "$motions" >"$system/tmp/motions.sh"
inside "bash /tmp/motions.sh" >"$folder/there"
diff "$folder/here" "$folder/there"
echo "check_debian13: $(wc -l <"$folder/here") motions are the same"
