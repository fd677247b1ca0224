#!/usr/bin/env bash
# cluster_test.sh slurm|parallel CLI: the scripts of packaging/cluster against one `prepare`. Exits
# with 77, saying why, where they cannot be tried.
set -euo pipefail

tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$tests/../.." && pwd)
kind=$1
cli=$2
work=$(mktemp -d)
# shellcheck source=tests/packaging/slurm_here.sh
. "$tests/slurm_here.sh"
trap 'stop_slurm; rm -rf "$work"' EXIT
cd "$work"

skip() {
    echo "SKIPPED: $1"
    exit 77
}
fail() {
    echo "FAILED: $1" >&2
    exit 1
}
same() {
    python3 "$tests/same_map.py" "$work/whole.tif" "$work/map.tif" || fail "$1"
    rm "$work/map.tif" "$work/map.tif.marsview"
    [ ! -e "$work/map.tif.parts" ] || fail "$1: the parts are left over"
    echo "$1: equal"
}

command -v gdal_translate >/dev/null || skip "gdal_translate is not installed"
gdal_translate -q -outsize 300% 300% "$root/resources/samples/mars_mola_4ppd.tif" "$work/dem.tif"
# Its name is in the level file.
"$cli" prepare "$work/dem.tif" -o "$work/map.tif" >/dev/null
mv map.tif whole.tif
mv map.tif.marsview whole.tif.marsview

# Runs the program; the first time that it makes part 2, it is killed while it copies.
cat >"$work/killed-once" <<SCRIPT
#!/usr/bin/env bash
if [[ "\$*" == *"--part 2" ]] && mkdir "$work/was-killed" 2>/dev/null; then
    "$cli" "\$@" &
    until [ -e "$work/map.tif.parts/2-of-4.new.tiles" ]; do sleep 0.01; done
    kill -KILL \$!
    exit 137
fi
exec "$cli" "\$@"
SCRIPT
chmod +x "$work/killed-once"

case $kind in
parallel)
    command -v parallel >/dev/null || skip "GNU parallel is not installed"
    MARSVIEW_CLI=$cli "$root/packaging/cluster/prepare-parallel.sh" dem.tif "$work/map.tif" 4 \
        >/dev/null
    same "GNU parallel"
    MARSVIEW_CLI=$work/killed-once "$root/packaging/cluster/prepare-parallel.sh" dem.tif \
        "$work/map.tif" 4 >/dev/null
    [ -d was-killed ] || fail "no part was killed"
    same "GNU parallel with a killed part"
    ;;
slurm)
    start_slurm "$work/slurm" 2>"$work/why" || skip "$(cat "$work/why")"
    run() { # COMMAND…: runs a script of ours and waits until its last job has ended
        local job
        job=$("$@")
        sbatch --wait --dependency="afterany:$job" --output=/dev/null --wrap=true >/dev/null
    }
    export MARSVIEW_CLI=$cli
    run "$root/packaging/cluster/prepare-slurm.sh" "$work/dem.tif" "$work/map.tif" 4
    [ -e map.tif ] || fail "no map: $(tail -n 2 slurm-*.out)"
    same "Slurm"
    export MARSVIEW_CLI=$work/killed-once
    run "$root/packaging/cluster/prepare-slurm.sh" "$work/dem.tif" "$work/map.tif" 4
    [ -d was-killed ] || fail "no part was killed"
    [ ! -e map.tif ] || fail "a map was joined without a part"
    sbatch --wait --array=2 --wrap="exec '$cli' prepare '$work/dem.tif' -o '$work/map.tif' --parts 4 --part \$SLURM_ARRAY_TASK_ID" >/dev/null
    "$cli" prepare "$work/dem.tif" -o "$work/map.tif" --parts 4 --join >/dev/null
    same "Slurm with a killed task, repeated alone"
    ;;
esac
