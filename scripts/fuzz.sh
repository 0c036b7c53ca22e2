#!/usr/bin/env bash
# Feeds what reads other people's input (scenes, sweeps, reports, NURBS curves) with what nobody would write, under
# AddressSanitizer and UndefinedBehaviorSanitizer. Ends with 1 at the first finding.
#   scripts/fuzz.sh [SECONDS [RUNS]]     of each reader (default: 60 s and any number of inputs); two readers at a time
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60} runs=${2:--1}
cmake --preset asan > /dev/null
cmake --build --preset asan --parallel "$(nproc)" --target fuzz_scene fuzz_sweep fuzz_report fuzz_nurbs
# What a million inputs of each reader have found to take another way through it: to begin where they ended.
mkdir -p build-asan/corpus
tar -xzf tests/fuzz/corpus.tar.gz -C build-asan/corpus --skip-old-files
feed() {
  local reader=$1
  # New inputs go to the build folder; the corpus of the sources keeps what once failed, and a start.
  local grown=build-asan/corpus/$reader
  local seeds=(tests/fuzz/corpus/"$reader")
  [[ $reader == scene ]] && seeds+=(scenes)
  build-asan/tests/fuzz/fuzz_"$reader" -max_total_time="$seconds" -runs="$runs" -max_len=8192 -timeout=25 \
    -rss_limit_mb=4096 -print_final_stats=1 -verbosity=0 -artifact_prefix=build-asan/"$reader"- "$grown" "${seeds[@]}" \
    > "$grown.log" 2>&1 || { echo "== $reader"; tail -40 "$grown.log"; return 1; }
  echo "$reader: $(sed -n 's/.*number_of_executed_units: *//p' "$grown.log") inputs, no finding"
}
export -f feed
export seconds runs
printf '%s\n' scene sweep report nurbs | xargs -P 2 -I '{}' bash -c 'feed {}'
