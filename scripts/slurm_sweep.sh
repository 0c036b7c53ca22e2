#!/usr/bin/env bash
# One case of a sweep, as a job of a Slurm array:
#   sbatch --array=0-11 scripts/slurm_sweep.sh PROGRAM SWEEP.json OUT
# Then join them: PROGRAM sweep SWEEP.json --out OUT --collect
#SBATCH --job-name=vlbeam
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
set -euo pipefail
program=$1 sweep=$2 out=$3
"$program" sweep "$sweep" --out "$out" --case "$SLURM_ARRAY_TASK_ID"
