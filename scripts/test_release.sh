#!/usr/bin/env bash
# Tries a whole release in Debian systems of its own, made anew: set-up, packages, golden pictures,
# motions and tests in one, and the packages alone in others, as a user has them.
#   scripts/test_release.sh bookworm|trixie [STEP...]
# STEP: setup package film goldens motions autopkgtest piuparts tests; default all, in this order.
#   setup        a fresh system with what packages.txt lists, by scripts/setup.sh
#   package      dpkg-buildpackage, lintian, and what the built program has of hardening
#   film         a fresh system: apt install, a film by a user without a home, and what removal leaves
#   goldens      those in the tree, made on Debian 12, by the package's program
#   motions      every scene's hash and events, by it, against those of PROGRAM, where there is one
#   autopkgtest  debian/tests in a fresh system
#   piuparts     installing, upgrading and purging, by that tool
#   tests        ctest, all, by the preset release-tests
# Steps but `film`, `autopkgtest` and `piuparts` share a system, which is kept between calls.
# RELEASES: the folder for all of it; default out/releases. Minimal systems and downloaded packages
#   are kept there; delete it to begin with nothing (3 GB a release).
# CCACHE_DIR: shared with the systems, so that a second call builds in a minute.
# PROGRAM: default build/release-tests/carom. DEBIAN_MIRROR: default what this machine's apt asks.
# JOBS: default all processors.
# Needs root, mmdebstrap or debootstrap and, for their steps, autopkgtest and piuparts.
set -euo pipefail
cd "$(dirname "$0")/.."

say() { echo "test_release: $*"; }
fail() { say "$*" >&2; exit 1; }
all_steps=(setup package film goldens motions autopkgtest piuparts tests)
release=${1:-}
case "$release" in bookworm | trixie) shift ;; *) sed -n '2,23s/^# \?//p' "$0" >&2; exit 2 ;; esac
steps=("$@")
[ $# -gt 0 ] || steps=("${all_steps[@]}")
for step in "${steps[@]}"; do
    [[ " ${all_steps[*]} " == *" $step "* ]] || { say "no step '$step' (known: ${all_steps[*]})" >&2; exit 2; }
done
[ "$(id -u)" -eq 0 ] || fail "needs root"

folder=$(realpath -m "${RELEASES:-out/releases}")
base=$folder/$release.tar.gz system=$folder/$release built=$folder/$release.built
archives=$folder/$release.archives lists=$folder/$release.lists
ccache=$(realpath -m "${CCACHE_DIR:-$(ccache -k cache_dir 2>/dev/null || echo "$folder/ccache")}")
jobs=${JOBS:-$(nproc)}
program=$(realpath -m "${PROGRAM:-build/release-tests/carom}")
mirror=${DEBIAN_MIRROR:-$(apt-get indextargets --format '$(REPO_URI)' \
    'Created-By: Packages' 'Origin: Debian' 'Label: Debian' | sort -u | head -n 1)}
[ -n "$mirror" ] || fail "set DEBIAN_MIRROR"
mkdir -p "$archives/partial" "$lists" "$built" "$ccache"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# ---- Systems ---------------------------------------------------------------------------------------
# make_base FILE.tar: by mmdebstrap where it is there, which needs a tenth of debootstrap's time.
make_base() {
    if command -v mmdebstrap >/dev/null; then
        mmdebstrap --quiet --variant=minbase "$release" "$1" "$mirror"
        return
    fi
    command -v debootstrap >/dev/null || fail "install mmdebstrap or debootstrap"
    debootstrap --variant=minbase "$release" "$work/base" "$mirror" || return
    rm -rf "$work/base/var/cache/apt/archives"/*.deb
    tar -C "$work/base" -cf "$1" . && rm -rf "$work/base"
}

# fresh FOLDER: a minimal system.
fresh() {
    if [ ! -e "$base" ]; then
        say "making $base"
        make_base "$work/base.tar" >"$work/log" 2>&1 || { tail "$work/log" >&2; exit 1; }
        gzip -1 <"$work/base.tar" >"$base.part" && mv "$base.part" "$base"
        rm "$work/base.tar"
    fi
    rm -rf "$1"
    mkdir -p "$1"
    tar -C "$1" -xzf "$base"
    printf '#!/bin/sh\nexit 101\n' >"$1/usr/sbin/policy-rc.d"
    chmod +x "$1/usr/sbin/policy-rc.d"
    echo force-unsafe-io >"$1/etc/dpkg/dpkg.cfg.d/unsafe-io"  # these systems need not outlive a power cut
}

# inside SYSTEM COMMAND: runs it there as root in /carom. Mounts go with this shell's namespace.
inside() {
    unshare --mount --pid --fork --kill-child bash -c '
        set -e
        system=$1
        mkdir -p "$system/carom" "$system/dev/pts" "$system/dev/shm" "$system/ccache"
        mount -t proc proc "$system/proc"
        mount -t devpts -o newinstance,ptmxmode=0666 devpts "$system/dev/pts"
        mount -t tmpfs tmpfs "$system/dev/shm"
        mount --bind "$3" "$system/var/cache/apt/archives"
        mount --bind "$4" "$system/var/lib/apt/lists"
        mount --bind "$5" "$system/ccache"
        exec chroot "$system" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
            DEBIAN_FRONTEND=noninteractive CCACHE_DIR=/ccache CCACHE_BASEDIR=/carom CCACHE_NOHASHDIR=1 \
            CCACHE_MAXSIZE="$6" bash -c "cd /carom && $2"' inside "$1" "$2" "$archives" "$lists" "$ccache" \
        "$(ccache -k max_size 2>/dev/null || echo 5G)"
}

# The tree as it stands; what is built there stays.
copy_tree() {
    mkdir -p "$system/carom"
    git ls-files -z --cached --others --exclude-standard | xargs -0 ls -d 2>/dev/null | tr '\n' '\0' |
        tar -c --null -T - | tar -C "$system/carom" -x
}

# ---- Steps -----------------------------------------------------------------------------------------
step_setup() {
    fresh "$system"
    copy_tree
    inside "$system" 'apt-get update -qq'
    install_packages
}

install_packages() { inside "$system" "scripts/setup.sh --only-packages --group film --group test --group package"; }

step_tests() {
    copy_tree
    inside "$system" "CMAKE_BUILD_PARALLEL_LEVEL=$jobs scripts/setup.sh --group film --group test --preset release-tests"
    inside "$system" "ctest --preset release-tests -j $jobs >/tests.log" ||
        { grep -E 'tests passed|\*\*\*' "$system/tests.log" >&2; fail "tests fail; all of it: $system/tests.log"; }
    grep 'tests passed' "$system/tests.log"
}

step_goldens() {
    inside "$system" "scripts/golden_scenes.sh |
        xargs /packaged/usr/bin/carom golden check --dir tests/golden --size 320x180"
}

step_motions() {
    local motions='for scene in $(find scenes -name "*.yaml" -not -path "scenes/sweeps/*" | sort); do
        "$CAROM" simulate "$scene" -o - --rate 1 --events "$TMP/e.csv" -y --stats "$TMP/s.json" -q >/dev/null ||
            echo "$scene: exit code $?"
        echo "$scene $(sed -n "s/.*\"motion_hash\": *\"\([^\"]*\)\".*/\1/p" "$TMP/s.json") $(md5sum <"$TMP/e.csv")"
    done'
    [ -x "$program" ] || { say "no $program to compare motions with"; return; }
    CAROM=$program TMP=$work bash -c "$motions" >"$work/here"
    printf 'export CAROM=/packaged/usr/bin/carom TMP=/tmp\n%s\n' "$motions" >"$system/tmp/motions.sh"
    inside "$system" "bash /tmp/motions.sh" >"$work/there"
    diff "$work/here" "$work/there"
    say "$(wc -l <"$work/here") motions are the same"
}

step_package() {
    copy_tree
    install_packages
    inside "$system" "DEB_BUILD_OPTIONS='parallel=$jobs noautodbgsym' dpkg-buildpackage -us -uc -b >/package.log 2>&1" ||
        { tail -n 40 "$system/package.log" >&2; fail "dpkg-buildpackage fails; all of it: $system/package.log"; }
    rm -f "$built"/*
    mv "$system"/carom_*.changes "$system"/carom_*.buildinfo "$system"/*.deb "$built"
    rm -rf "$system/built"
    cp -r "$built" "$system/built"
    rm -rf "$system/packaged"
    dpkg-deb -x "$built"/carom_*.deb "$system/packaged"
    inside "$system" "lintian --fail-on error,warning,info --display-info --tag-display-limit 0 /built/*.changes"
    scripts/check_hardening.sh "$built"
}

# What stands in a system, but for apt's and dpkg's own books.
files_of() {
    (cd "$1" && find . -xdev \( -path ./var/cache -o -path ./var/lib/apt -o -path ./var/lib/dpkg -o -path ./var/log \
        -o -path ./tmp -o -path ./proc -o -path ./dev -o -path ./ccache -o -path ./carom \) -prune -o -print | sort)
}

step_film() {
    local user=$work/user
    fresh "$user"
    mkdir -p "$user/carom" "$user/dev/pts" "$user/dev/shm" "$user/ccache"
    files_of "$user" >"$work/before"
    cp "$built"/carom_*.deb "$user/tmp"
    inside "$user" 'begin=$(date +%s); apt-get update -qq; apt-get install -y -qq /tmp/carom_*.deb >/tmp/log 2>&1 ||
        { cat /tmp/log; exit 1; }; echo "installed in $(($(date +%s) - begin)) s"'
    # A user without a home: nobody, in a folder of its own.
    inside "$user" 'install -d -o nobody /tmp/films && cd /tmp/films &&
        setpriv --reuid nobody --clear-groups env -i PATH=/usr/bin bash -ec "
            begin=\$(date +%s); carom new ball -q; carom render ball.yaml -o ball.mp4 -q; test -s ball.mp4
            echo \"a film in \$((\$(date +%s) - begin)) s\"
            carom compare ball.mp4 ball.mp4 >/dev/null; carom golden update ball.yaml --time 0.5 --dir goldens -q
            carom golden check ball.yaml --time 0.5 --dir goldens -q"'
    inside "$user" 'test -s /usr/share/man/man1/carom.1.gz || grep -q man1 /etc/dpkg/dpkg.cfg.d/*
        bash -n /usr/share/bash-completion/completions/carom; zcat -f /usr/share/doc/carom/changelog.gz | head -n 1'
    inside "$user" 'apt-get purge -y -qq --autoremove carom >/tmp/log 2>&1 || { cat /tmp/log; exit 1; }'
    files_of "$user" >"$work/after"
    diff "$work/before" "$work/after" >"$work/left" || true
    if grep -i carom "$work/left"; then fail "removal leaves what is carom's"; fi
    say "removal leaves nothing of carom, and $(grep -c '^>' "$work/left" || true) files of other packages"
}

step_autopkgtest() {
    command -v autopkgtest >/dev/null || fail "install autopkgtest"
    local user=$work/user
    fresh "$user"
    git ls-files -z debian examples scenes tests docs python |
        tar -c --null -T - | (mkdir -p "$work/source" && tar -C "$work/source" -x)
    autopkgtest --no-built-binaries --apt-upgrade "$built"/*.deb "$work/source" -- chroot "$user" >"$work/log" 2>&1 ||
        { tail -n 60 "$work/log" >&2; fail "autopkgtest fails"; }
    sed -n '/@@@ summary/,$p' "$work/log" | sed 's/^.*autopkgtest[^:]*: *//'
}

step_piuparts() {
    command -v piuparts >/dev/null || fail "install piuparts"
    fresh "$work/user"
    TMPDIR=$work piuparts --basetgz "$base" --distribution "$release" --mirror "$mirror main" --no-eatmydata \
        --warn-on-leftovers-after-purge --warn-on-debsums-errors "$built"/*.deb >"$work/log" 2>&1 ||
        { tail -n 40 "$work/log" >&2; fail "piuparts fails"; }
    grep -o "PASS: .*" "$work/log"
}

for step in "${steps[@]}"; do
    say "$release: $step"
    begin=$(date +%s)
    "step_$step"
    say "$release: $step done in $(($(date +%s) - begin)) s"
done
