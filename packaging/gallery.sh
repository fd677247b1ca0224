#!/usr/bin/env bash
# gallery.sh FOLDER [MARSVIEW-CLI]: draws the gallery, PNG pictures of the bundled maps with a page of
# captions, gallery.md. Needs no display.
set -euo pipefail

if [ $# -lt 1 ]; then
    sed -n 's/^# //p' "$0" >&2
    exit 2
fi
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=$1
cli=${2:-$root/build/run/bin/marsview-cli}
mars=$root/resources/samples/mars_mola_4ppd.tif
mountain=$root/resources/samples/mount_st_helens_30m.tif

mkdir -p "$folder"
page=$folder/gallery.md
printf '# Gallery\n\nDrawn by packaging/gallery.sh from the maps that come with the program.\n' >"$page"

picture() { # NAME CAPTION ARGUMENTS…
    local name=$1 caption=$2
    shift 2
    "$cli" render "$@" --size 1280x800 -o "$folder/$name.png"
    printf '\n## %s\n\n![%s](%s.png)\n\n    marsview-cli render %s\n' "$caption" "$caption" "$name" \
        "${*//$root\/resources\/samples\//}" >>"$page"
}

picture mars 'Mars from the south' "$mars"
picture tharsis 'Tharsis and Valles Marineris' "$mars" --look-at 266,-1 --distance 5600000 --tilt 52
picture olympus 'Olympus Mons, heights × 5, with contour lines' "$mars" --look-at 226.2,18.65 \
    --distance 1500000 --tilt 60 --exaggeration 5 --contours
picture hellas 'Hellas Planitia, straight down' "$mars" --look-at 70,-42 --distance 4200000 --tilt 0 \
    --ramp hypsometric
picture slopes 'Slopes of the canyon' "$mars" --look-at 290,-8 --distance 2500000 --tilt 45 \
    --shading slope
picture st_helens 'Mount St. Helens' "$mountain" --tilt 60 --azimuth 160
picture st_helens_light 'Mount St. Helens in low light' "$mountain" --tilt 0 --shading hillshade \
    --light 300,15
echo "$page"
