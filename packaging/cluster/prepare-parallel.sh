#!/usr/bin/env bash
# prepare-parallel.sh DEM OUTPUT.tif PARTS [OPTION…]: prepares a map in PARTS parts with GNU parallel
# and joins them. Options go to parallel: without any, as many parts run at a time as there are
# cores; --sshloginfile FILE names hosts, which must see OUTPUT's folder, and DEM, which may be an
# address. A part that fails is tried three times; run the script again to make what is missing.
set -euo pipefail

if [ $# -lt 3 ]; then
    sed -n 's/^# //p' "$0" >&2
    exit 2
fi
dem=$1
output=$2
parts=$3
shift 3
command=("${MARSVIEW_CLI:-marsview-cli}" prepare "$dem" -o "$output" --parts "$parts")

# The second round, once all parts are there, measures errors.
for _ in copy measure; do
    parallel --will-cite --retries 3 "$@" --quote "${command[@]}" --part '{}' ::: $(seq "$parts")
done
exec "${command[@]}" --join
