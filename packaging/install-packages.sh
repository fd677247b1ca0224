#!/usr/bin/env bash
# install-packages.sh SECTION...: installs the missing packages of these sections of packages.txt.
set -euo pipefail

list=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/packages.txt

fail() {
    echo "install-packages.sh: $1" >&2
    exit 1
}

packages_of() {
    awk -v heading="[$1]" '/^\[/ { on = $0 == heading; next } on && NF && !/^#/' "$list"
}

installed() {
    dpkg-query --show --showformat '${db:Status-Status} ${Package}\n' | sed -n 's/^installed //p'
}

[ $# -gt 0 ] || fail "name the sections to install, for example: run test"
for section in "$@"; do
    grep -qxF "[$section]" "$list" || fail "$list has no section [$section]"
done
if ! command -v dpkg-query >/dev/null; then
    echo "Not a Debian system: continuing without installing the equivalents of $list" >&2
    exit 0
fi

mapfile -t missing < <(
    comm -23 <(for section in "$@"; do packages_of "$section"; done | sort -u) <(installed | sort -u)
)
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
        fail "neither root nor sudo here; have an administrator install: ${missing[*]}"
    as_root=(sudo)
fi
apt() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get -qq --yes -o DPkg::Lock::Timeout=600 -o Dpkg::Use-Pty=0 "$@"
}

echo "Installing ${#missing[@]} missing packages and their dependencies: ${missing[*]}"
# Continue if a source is unreachable: it may have none of these packages.
apt update || echo "install-packages.sh: some package lists could not be refreshed" >&2
apt install --no-install-recommends "${missing[@]}" >/dev/null
