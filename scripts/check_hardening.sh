#!/usr/bin/env bash
# What built programs and libraries, alone or in packages, have of Debian's hardening, read from the files:
# position independent, read-only relocations, all symbols bound at the start, stack protector,
# checked functions of the C library. And: what is loaded when it is needed stands in no list of
# libraries, so the package has to name it.
#   scripts/check_hardening.sh FOLDER_OF_DEBS
#   scripts/check_hardening.sh --program PROGRAM...
set -euo pipefail
folder=${1:?usage: scripts/check_hardening.sh FOLDER_OF_DEBS | --program PROGRAM...}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
wrong=0
complain() { echo "hardening: $*" >&2; wrong=1; }

check_file() {
    local file=$1 shown=$2 header dynamic segments symbols
    header=$(readelf -hW "$file") dynamic=$(readelf -dW "$file") segments=$(readelf -lW "$file")
    symbols=$(nm -D --undefined-only "$file")
    grep -q 'Type: *DYN' <<<"$header" || complain "$shown is not position independent"
    grep -q GNU_RELRO <<<"$segments" || complain "$shown has no read-only relocations"
    grep -q 'BIND_NOW\|FLAGS.*NOW' <<<"$dynamic" || complain "$shown does not bind its symbols at the start"
    grep -q 'GNU_STACK.*RW ' <<<"$segments" || complain "$shown has an executable stack"
    grep -q '__stack_chk_fail' <<<"$symbols" || complain "$shown has no stack protector"
    grep -q '_chk@' <<<"$symbols" || complain "$shown checks no function of the C library"
    ! grep -q 'RPATH\|RUNPATH' <<<"$dynamic" || complain "$shown has a path of libraries inside"
}

if [ "$folder" = --program ]; then
    shift
    for file in "$@"; do check_file "$file" "$file"; done
    exit $wrong
fi

for package in "$folder"/carom_*.deb "$folder"/libcarom0*.deb "$folder"/python3-carom_*.deb; do
    name=$(basename "$package" | sed 's/_.*//')
    dpkg-deb -x "$package" "$work/$name"
    checked=0
    while read -r file; do
        readelf -h "$file" >/dev/null 2>&1 || continue
        checked=$((checked + 1))
        check_file "$file" "${file#"$work/"}"
    done < <(find "$work/$name" -type f \( -perm -u+x -o -name '*.so*' \))
    [ $checked -gt 0 ] || complain "$name has no program or library"

    depends=$(dpkg-deb -f "$package" Depends)
    for library in libosmesa libavformat libavcodec libavutil libswscale; do
        grep -q "$library" <<<"$depends" || complain "$name does not depend on $library"
    done
    echo "hardening: $name: $checked checked"
done
exit $wrong
