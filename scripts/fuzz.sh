#!/usr/bin/env bash
# Feeds what reads other people's input (scenes, sweeps, reports, NURBS curves) with what nobody would write, under
# AddressSanitizer and UndefinedBehaviorSanitizer. Ends with 1 at the first finding.
#   scripts/fuzz.sh [SECONDS]     of each reader (default: 60)
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}
cmake --preset fuzz > /dev/null
cmake --build --preset fuzz --parallel "$(nproc)" --target fuzz_scene fuzz_sweep fuzz_report fuzz_nurbs
for reader in scene sweep report nurbs; do
  # New inputs go to the build folder; the corpus keeps what once failed, and a start.
  grown=build-fuzz/corpus/$reader
  mkdir -p "$grown"
  seeds=(tests/fuzz/corpus/"$reader")
  [[ $reader == scene ]] && seeds+=(scenes)
  echo "== $reader"
  build-fuzz/tests/fuzz/fuzz_"$reader" -max_total_time="$seconds" -max_len=8192 -timeout=25 -rss_limit_mb=4096 \
    -print_final_stats=1 -verbosity=0 -artifact_prefix=build-fuzz/"$reader"- "$grown" "${seeds[@]}" > "$grown.log" 2>&1 ||
    { tail -40 "$grown.log"; exit 1; }
  grep number_of_executed_units "$grown.log"
done
