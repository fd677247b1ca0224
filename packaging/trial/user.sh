#!/usr/bin/env bash
# Somebody who wants to look at a map: installs, starts, upgrades and removes.
# shellcheck source=packaging/trial/common.sh
. /trial/common.sh
fresh trial-user

# Without what apt and dpkg keep for themselves, and what users write.
files() {
    find / -xdev \( -path /proc -o -path /dev -o -path /run -o -path /tmp -o -path /trial -o -path /home \
        -o -path /var/cache -o -path /var/log -o -path /var/lib/apt -o -path /var/lib/dpkg \) \
        -prune -o -print | sort
}
files >files-before
installed >installed-before

map=/usr/share/marsview/samples/mars_mola_4ppd.tif
window() { # PICTURE: the window with the bundled map
    as_user xvfb-run --auto-servernum --server-args='-screen 0 1600x1000x24' \
        marsview --size 1400x900 --screenshot "$1" "$map"
    [ "$(stat --format %s "/home/visitor/$1")" -gt 100000 ] || fail "$1 is nearly empty"
}

apt install ./packages/marsview_*.deb
installed | comm -13 installed-before - >needed
show cat needed
! grep -E '^(gcc|g\+\+|cpp|clang|cmake|make|ninja-build|build-essential|debhelper|.*-dev)(-[0-9.]+)?$' \
    needed || fail "build tools among the dependencies"
say "marsview installs with $(($(wc -l <needed) - 1)) packages of Debian, no build tools"
show dpkg --verify marsview
show dpkg --status marsview

as_user marsview --version
as_user marsview-cli --version
as_user marsview-cli info "$map"
# The crater on top of Olympus Mons.
as_user marsview-cli sample "$map" --lonlat 226.9,18.3 | tee sampled
awk '/^[0-9.]+$/ { found = $1 > 17000 && $1 < 21300 } END { exit !found }' sampled ||
    fail "not the elevation of Olympus Mons"
as_user marsview-cli render "$map" -o render.png --size 800x500
as_user marsview-cli loop "$map" --device sim:swipe=5 --seconds 2 --record swipe.csv
as_user marsview-cli trace "$map" --goals swipe.csv -o trace.csv --summary summary.json
show cat /home/visitor/summary.json
grep -q '"contact_updates": *[1-9]' /home/visitor/summary.json || fail "the terrain was not touched"
as_user marsview-cli devices
window marsview.png
say "the programs start, open a map and touch it"

apt install ./packages/libmarsview-contact1_*.deb ./packages/python3-marsview_*.deb \
    ./packages/marsview-doc_*.deb
as_user python3 - <<'PYTHON' || fail "the Python module"
import marsview, numpy

mars = marsview.open("/usr/share/marsview/samples/mars_mola_4ppd.tif")
print(mars.info["body"], mars.shape, mars.elevation(226.9, 18.3))
assert mars.elevation(numpy.zeros((3, 4)), 10.0).shape == (3, 4)
slope = numpy.add.outer(numpy.zeros(20), 0.5 * numpy.arange(20.0))  # z = x / 2
touched = marsview.ContactModel(slope).update([[9.0, 9.0, 9.0], [9.0, 9.0, 2.0]])
normal = numpy.array([-0.5, 0.0, 1.0]) / 1.25**0.5
assert touched["contact"].tolist() == [False, True]
assert numpy.allclose(touched["force_direction"][1], normal)
assert mars.render(size=(320, 200)).shape == (200, 320, 3)
PYTHON
python3 - <<'PYTHON' || fail "links between documents"
import pathlib, re, sys

pages = list(pathlib.Path("/usr/share/doc/marsview").rglob("*.md"))
links = [(page, link) for page in pages for link in re.findall(r"\]\(([^)#]+)", page.read_text())]
broken = [(page, link) for page, link in links if "://" not in link and not (page.parent / link).exists()]
for page, link in broken:
    print(f"{page} links {link}, which is not there")
sys.exit(bool(broken) or len(pages) < 15)
PYTHON
say "the Python module opens, samples, touches and draws"

apt install ./newer/marsview_*.deb ./newer/libmarsview-contact1_*.deb \
    ./newer/python3-marsview_*.deb ./newer/marsview-doc_*.deb
for package in marsview libmarsview-contact1 python3-marsview marsview-doc; do
    show dpkg --status "$package" | tee status
    [ "$(grep -cxE 'Status: install ok installed|Version: .*[+]trial' status)" -eq 2 ] ||
        fail "$package is not upgraded"
    show dpkg --verify "$package"
done
window upgraded.png
as_user python3 -c 'import marsview; print(marsview.contact_models)'
say "upgrade"

apt remove marsview libmarsview-contact1 python3-marsview marsview-doc
! command -v marsview marsview-cli || fail "the programs are still there"
mapfile -t configured < <(dpkg-query --show --showformat '${db:Status-Status} ${Package}\n' |
    sed -n 's/^config-files //p')
[ ${#configured[@]} -eq 0 ] || apt purge "${configured[@]}"
apt autoremove --purge
installed | comm -13 installed-before - >packages-left
show cat packages-left
[ ! -s packages-left ] || fail "packages are left over"
files | comm -13 files-before - >files-left
show cat files-left
! grep -i marsview files-left || fail "files are left over"
! grep -rIil marsview /etc /usr /var/lib --exclude-dir=dpkg --exclude-dir=apt ||
    fail "files still name MarsView"
say "removed; left by packages of Debian: $(wc -l <files-left) files"
show find /home/visitor -type f
