#!/usr/bin/env bash
# Runs studies one after another (each spreads its own runs over the threads) and judges their reports.
#   scripts/studies.sh run    PROFILE OUT JOBS [STUDY]   run all studies, or one
#   scripts/studies.sh update PROFILE OUT JOBS [STUDY]   run those whose report is missing or outdated
#   scripts/studies.sh gate   PROFILE OUT JOBS [STUDY]   evaluate the gates of the reports
set -euo pipefail

action=$1 profile=$2 out=$3 jobs=$4
vlbeam=build/vlbeam
if [[ -n ${5:-} ]]; then studies=("$5"); else mapfile -t studies < <("$vlbeam" list --names); fi

# A report is outdated when the program or anything in the study's folder is newer.
outdated() {
  local report=$out/$1.json
  [[ ! -e $report || $vlbeam -nt $report || -n $(find "studies/$1" -type f -newer "$report" -print -quit) ]]
}

case $action in
  run | update)
    failed=0
    for study in "${studies[@]}"; do
      if [[ $action == update ]] && ! outdated "$study"; then continue; fi
      # With `update` the gates are judged afterwards, all together.
      code=0
      "$vlbeam" study "$study" --profile "$profile" --out "$out" --jobs "$jobs" || code=$?
      if [[ $code -gt 1 || ($code -eq 1 && $action == run) ]]; then failed=$code; fi
    done
    exit "$failed"
    ;;
  gate)
    [[ ${#studies[@]} -gt 0 ]] || { echo "no studies" >&2; exit 2; }
    reports=("${studies[@]/#/$out/}")
    exec "$vlbeam" gate "${reports[@]/%/.json}"
    ;;
  *)
    echo "unknown action $action" >&2
    exit 2
    ;;
esac
