#!/usr/bin/env bash
# try-packages.sh [PACKAGES [FOLDER]]: tries the Debian packages in PACKAGES, by default build/packages,
# in fresh systems made with debootstrap in FOLDER, by default build/trial: install, start, upgrade,
# remove (trial/user.sh), and programs that use them (trial/developer.sh). FOLDER gets the transcripts
# and pictures. Needs root. DEBIAN_MIRROR is where the system's packages come from, by default where
# this machine has its own from.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
packages=$(realpath -m "${1:-$root/build/packages}")
trial=$(realpath -m "${2:-$root/build/trial}")
release=bookworm

fail() {
    echo "try-packages.sh: $1" >&2
    exit 1
}
[ "$(id -u)" -eq 0 ] || fail "needs root, for debootstrap and chroot"
compgen -G "$packages/marsview_*.deb" >/dev/null ||
    fail "no packages in $packages; make them with package.sh"
"$root/packaging/install-packages.sh" trial

# The first of apt's addresses for the release.
# shellcheck disable=SC2016 # apt-get's own variables
mirror=${DEBIAN_MIRROR:-$(apt-get indextargets --format '$(CODENAME) $(REPO_URI)' \
    'Created-By: Packages' | sed -n "0,/^$release /s/^$release //p")}
[ -n "$mirror" ] || fail "apt knows no mirror of $release; name one in DEBIAN_MIRROR"

mkdir -p "$trial"
if [ ! -e "$trial/base.made" ]; then
    echo "Making a fresh $release in $trial/base"
    rm -rf --one-file-system "$trial/base"
    debootstrap --variant=minbase "$release" "$trial/base" "$mirror" >"$trial/debootstrap.log" 2>&1 ||
        fail "debootstrap failed; its log is $trial/debootstrap.log"
    touch "$trial/base.made"
fi

# The same packages with a higher version, to upgrade to.
newer=$trial/newer
rm -rf "$newer"
mkdir "$newer"
for package in "$packages"/*.deb; do
    version=$(dpkg-deb --field "$package" Version)
    dpkg-deb --raw-extract "$package" "$newer/content"
    sed -i -e "s/^Version: .*/&+trial/" -e "s/(= $version)/(= $version+trial)/g" \
        "$newer/content/DEBIAN/control"
    dpkg-deb --root-owner-group -Znone --build "$newer/content" "$newer" >/dev/null
    rm -rf "$newer/content"
done

for part in user developer; do
    system=$trial/$part
    rm -rf --one-file-system "$system"
    cp --archive "$trial/base" "$system"
    mkdir "$system/trial"
    cp -r "$packages" "$system/trial/packages"
    cp -r "$newer" "$root/packaging/trial/." "$root/packaging/packages.txt" "$system/trial/"
    echo "Trying the packages as a $part: $trial/$part.txt"
    # The mounts are in a name space of their own, so that none is left over.
    # shellcheck disable=SC2016 # expanded by the inner shell
    unshare --mount --pid --fork --kill-child bash -c '
        mount --types proc proc "$0/proc"
        mount --rbind /dev "$0/dev"
        exec chroot "$0" /usr/bin/env --ignore-environment HOME=/root LANG=C.UTF-8 \
            PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
            bash "/trial/$1.sh"' "$system" "$part" >"$trial/$part.txt" 2>&1 </dev/null || {
        tail -n 20 "$trial/$part.txt" >&2
        fail "failed; the transcript is $trial/$part.txt"
    }
    sed -n 's/^== //p' "$trial/$part.txt"
    cp "$system"/home/visitor/*.png "$trial/" 2>/dev/null || true
done
