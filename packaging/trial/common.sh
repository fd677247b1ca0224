# shellcheck shell=bash
# What user.sh and developer.sh share; they run as root in a fresh system, started by try-packages.sh.
set -euo pipefail
export DEBIAN_FRONTEND=noninteractive
cd /trial

say() {
    echo "== $*"
}
fail() {
    echo "FAILED: $*"
    exit 1
}
# show COMMAND…: a command with its output.
show() {
    printf '\n$ %s\n' "$*"
    "$@"
}
# as_user COMMAND…: as an ordinary user in the user's home, without a network.
as_user() {
    printf '\n%% %s\n' "$*"
    unshare --net setpriv --reuid=visitor --regid=visitor --init-groups \
        env --chdir=/home/visitor HOME=/home/visitor "$@"
}
apt() {
    show apt-get --quiet --yes -o Dpkg::Use-Pty=0 "$@"
}
section() { # NAME: its packages in packages.txt
    awk -v heading="[$1]" '/^\[/ { on = $0 == heading; next } on && NF && !/^#/' packages.txt
}
installed() {
    dpkg-query --show --showformat '${db:Status-Status} ${Package}\n' | sed -n 's/^installed //p' | sort
}
# fresh SECTION: the system with what the trial itself needs.
fresh() {
    # The system is thrown away: no need to write every file through to the disk.
    echo force-unsafe-io >/etc/dpkg/dpkg.cfg.d/trial
    useradd --create-home --shell /bin/bash visitor
    apt update
    mapfile -t tools < <(section "$1")
    apt install --no-install-recommends "${tools[@]}"
}
