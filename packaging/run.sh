#!/usr/bin/env bash
# run.sh [DEM]: installs missing packages, builds MarsView and starts it; without a display it
# renders the window to a picture and prints its path.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/run
program=$build/bin/marsview
picture=$build/marsview.png

"$root/packaging/install-packages.sh" run

# On a terminal ninja shows one line of progress; a log gets only errors.
quiet=()
[ -t 1 ] || quiet=(-- --quiet)
echo "Building MarsView (takes minutes the first time)"
cmake --preset release -S "$root" -B "$build" --log-level=WARNING \
    -DMARSVIEW_BUILD_TESTS=OFF -DMARSVIEW_WERROR=OFF >/dev/null
cmake --build "$build" --target marsview marsview-cli "${quiet[@]}"

if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
    exec "$program" "$@"
fi
rm -f "$picture"
xvfb-run --auto-servernum --server-args='-screen 0 1600x1000x24' \
    "$program" --screenshot "$picture" "$@"
echo "No display: the window was rendered to $picture"
