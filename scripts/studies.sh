#!/usr/bin/env bash
# Runs studies one after another (each spreads its own runs over the threads) and judges their reports.
#   scripts/studies.sh run    PROFILE OUT JOBS [STUDY]   run all studies, or one
#   scripts/studies.sh update PROFILE OUT JOBS [STUDY]   run those that have no report of a completed run
#   scripts/studies.sh gate   PROFILE OUT JOBS [STUDY]   evaluate the gates of the reports; with PROFILE full and all
#                                                        studies also compare the READMEs with them
# The times of files decide nothing: a copied tree has others.
set -euo pipefail

action=$1 profile=$2 out=$3 jobs=$4
vlbeam=build/vlbeam
python=/usr/bin/python3  # for which Debian's packages are
[[ -x $python ]] || python=python3
if [[ -n ${5:-} ]]; then studies=("$5"); else mapfile -t studies < <("$vlbeam" list --names); fi

completed() {
  [[ ! -e $out/$1.failed.json ]] && grep -qs '^  "status": "completed",$' "$out/$1.json"
}

# Studies that an interrupted `run` has finished, each with a sum over the program and the study's folder: the next `run`
# carries on behind those that are still what they were.
finished=$out/.finished
finished_line() {
  echo "$1 $(find "$vlbeam" "studies/$1" -type f -print0 | LC_ALL=C sort -z | xargs -0 sha256sum | sha256sum)"
}
done_before() { [[ -e $finished ]] && completed "$1" && grep -qxF "$(finished_line "$1")" "$finished"; }

# On two cores, to one digit; the studies spread over the cores that there are.
if [[ $action == run && -z ${5:-} ]]; then
  if [[ $profile == full ]]; then minutes="about 18 minutes"; else minutes="about 2 minutes"; fi
  echo "${#studies[@]} studies, profile $profile: $minutes on two cores" >&2
fi

case $action in
  run | update)
    failed=0
    mkdir -p "$out"
    for study in "${studies[@]}"; do
      if [[ $action == update ]] && completed "$study"; then continue; fi
      if [[ $action == run && -z ${5:-} ]] && done_before "$study"; then
        echo "$study: finished before the interruption"
        continue
      fi
      # With `update` the gates are judged afterwards, all together.
      code=0
      "$vlbeam" study "$study" --profile "$profile" --out "$out" --jobs "$jobs" || code=$?
      if [[ $code -ge 128 ]]; then exit "$code"; fi  # stopped by the user: the next run carries on
      if [[ $code -gt 1 || ($code -eq 1 && $action == run) ]]; then failed=$code; fi
      if [[ $code -eq 0 && $action == run && -z ${5:-} ]]; then finished_line "$study" >> "$finished"; fi
    done
    rm -f "$finished"
    if [[ $action == run && -d build/python/vlbeam ]] && "$python" -c "import matplotlib, pandas" 2> /dev/null; then
      PYTHONPATH=build/python "$python" docs/tutorials/run.py --quick
    fi
    if [[ $action == run ]]; then "$python" studies/site/build.py "$out"; fi
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
