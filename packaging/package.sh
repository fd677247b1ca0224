#!/usr/bin/env bash
# package.sh [FOLDER]: builds the Debian packages into FOLDER, by default build/packages, and lists
# them. Installs missing build packages.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
output=$(realpath -m "${1:-$root/build/packages}")
version=$(sed -n 's/^  VERSION \([0-9.]*\)$/\1/p' "$root/CMakeLists.txt")
work=$root/build/debian
tree=$work/marsview-$version

"$root/packaging/install-packages.sh" run package

# A copy of the source files, since dpkg wants the folder debian at the top. The build folder in it
# is kept, so that the next run compiles only what has changed.
mkdir -p "$tree" "$output"
if git -C "$root" ls-files >/dev/null 2>&1; then
    files() { git -C "$root" ls-files -z --cached --others --exclude-standard; }
else
    files() { (cd "$root" && find . \( -path ./build -o -path ./.git \) -prune -o -type f -print0); }
fi
files | (cd "$root" && while IFS= read -r -d '' file; do
    # Not what has been removed from the tree, and not with a new time what has not changed.
    if [ -f "$file" ] && ! cmp -s "$file" "$tree/$file"; then
        mkdir -p "$tree/$(dirname "$file")"
        cp -p "$file" "$tree/$file"
    fi
done)
rm -rf "$tree/debian"
cp -r "$root/packaging/debian" "$tree/debian"

export DEB_BUILD_OPTIONS="${DEB_BUILD_OPTIONS:-noautodbgsym}"
echo "Building the packages (takes minutes the first time)"
(cd "$tree" && dpkg-buildpackage --no-sign --build=binary --no-pre-clean >"$work/build.log" 2>&1) || {
    tail -n 40 "$work/build.log" >&2
    echo "package.sh: the build failed; its log is $work/build.log" >&2
    exit 1
}
mv "$work"/*_"$version"-*.deb "$output/"
echo "Packages in $output:"
(cd "$output" && ls -1 -- *_"$version"-*.deb)
