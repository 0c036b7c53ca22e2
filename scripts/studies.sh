#!/usr/bin/env bash
# Runs studies one after another (each spreads its own runs over the threads) and judges their reports.
#   scripts/studies.sh run    PROFILE OUT JOBS [STUDY]   run all studies, or one
#   scripts/studies.sh update PROFILE OUT JOBS [STUDY]   run those whose report is missing or outdated
#   scripts/studies.sh gate   PROFILE OUT JOBS [STUDY]   evaluate the gates of the reports; with PROFILE full and all
#                                                        studies also compare the READMEs with them
set -euo pipefail

action=$1 profile=$2 out=$3 jobs=$4
vlbeam=build/vlbeam
if [[ -n ${5:-} ]]; then studies=("$5"); else mapfile -t studies < <("$vlbeam" list --names); fi

# A report is outdated when it is not of a completed study, when a later run failed, or when the program or anything in
# the study's folder is newer that makes it.
outdated() {
  local report=$out/$1.json
  [[ ! -e $report || -e $out/$1.failed.json || $vlbeam -nt $report ]] ||
    ! grep -q '^  "status": "completed",$' "$report" ||
    [[ -n $(find "studies/$1" -type f ! -name README.md ! -name claims.json ! -name gates.json -newer "$report" \
      -print -quit) ]]
}

# Studies that an interrupted `run` has finished: the next one carries on behind them.
finished=$out/.finished
done_before() { [[ -e $finished ]] && grep -qx "$1" "$finished" && ! outdated "$1"; }

case $action in
  run | update)
    failed=0
    mkdir -p "$out"
    for study in "${studies[@]}"; do
      if [[ $action == update ]] && ! outdated "$study"; then continue; fi
      if [[ $action == run && -z ${5:-} ]] && done_before "$study"; then
        echo "$study: finished before the interruption"
        continue
      fi
      # With `update` the gates are judged afterwards, all together.
      code=0
      "$vlbeam" study "$study" --profile "$profile" --out "$out" --jobs "$jobs" || code=$?
      if [[ $code -ge 128 ]]; then exit "$code"; fi  # stopped by the user: the next run carries on
      if [[ $code -gt 1 || ($code -eq 1 && $action == run) ]]; then failed=$code; fi
      if [[ $code -eq 0 && $action == run && -z ${5:-} ]]; then echo "$study" >> "$finished"; fi
    done
    rm -f "$finished"
    if [[ $action == run ]]; then python3 studies/site/build.py "$out"; fi
    exit "$failed"
    ;;
  gate)
    [[ ${#studies[@]} -gt 0 ]] || { echo "no studies" >&2; exit 2; }
    reports=("${studies[@]/#/$out/}")
    code=0
    "$vlbeam" gate "${reports[@]/%/.json}" || code=$?
    if [[ $profile == full && -z ${5:-} && $code -lt 2 ]]; then
      claims=0
      "$vlbeam" claims --reports "$out" || claims=$?
      [[ $claims -gt $code ]] && code=$claims
    fi
    exit "$code"
    ;;
  *)
    echo "unknown action $action" >&2
    exit 2
    ;;
esac
