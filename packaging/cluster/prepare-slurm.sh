#!/usr/bin/env bash
# prepare-slurm.sh DEM OUTPUT.tif PARTS [OPTION…]: prepares a map on a Slurm cluster, in PARTS
# tasks of a job array and a job that joins them. All nodes must see OUTPUT's folder, and DEM, which
# may be an address. Prints the number of the last job. Options go to sbatch, for example
# --partition=long. If a task fails, repeat it alone:
#   sbatch --array=TASK … or marsview-cli prepare DEM -o OUTPUT --parts PARTS --part TASK
set -euo pipefail

if [ $# -lt 3 ]; then
    sed -n 's/^# //p' "$0" >&2
    exit 2
fi
dem=$1
output=$2
parts=$3
shift 3
command=$(printf '%q ' "${MARSVIEW_CLI:-marsview-cli}" prepare "$dem" -o "$output" --parts "$parts")

# Every task copies its part and surveys it; the second array, once all are there, measures errors.
survey=$(sbatch --parsable "$@" --job-name=marsview-copy --array="1-$parts" --requeue \
    --wrap="exec $command --part \"\$SLURM_ARRAY_TASK_ID\"")
measure=$(sbatch --parsable "$@" --job-name=marsview-measure --array="1-$parts" --requeue \
    --dependency="afterok:${survey%%;*}" --kill-on-invalid-dep=yes \
    --wrap="exec $command --part \"\$SLURM_ARRAY_TASK_ID\"")
join=$(sbatch --parsable "$@" --job-name=marsview-join --requeue \
    --dependency="afterok:${measure%%;*}" --kill-on-invalid-dep=yes \
    --wrap="exec $command --join")
echo "${join%%;*}"
