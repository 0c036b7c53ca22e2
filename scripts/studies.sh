#!/usr/bin/env bash
# Runs studies one after another (each spreads its own runs over the threads) and judges their reports.
#   scripts/studies.sh run    PROFILE OUT JOBS [STUDY]   run all studies, or one
#   scripts/studies.sh update PROFILE OUT JOBS [STUDY]   run those that have no report of a completed run; with another
#                                                        profile than full, of this program and this study
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

# The same of each report, for `update`: that of profile full is committed, and judged as it is.
made=$out/.made
made_by_this() { [[ $profile == full ]] || grep -qsxF "$(finished_line "$1")" "$made"; }
note_made() {
  [[ $profile != full ]] || return 0
  { grep -v "^$1 " "$made" 2> /dev/null || true; finished_line "$1"; } > "$made.new"
  mv "$made.new" "$made"
}

# On two cores, to one digit; the studies spread over the cores that there are.
if [[ $action == run && -z ${5:-} ]]; then
  if [[ $profile == full ]]; then minutes="about 18 minutes"; else minutes="about 2 minutes"; fi
  echo "${#studies[@]} studies, profile $profile: $minutes on two cores" >&2
fi

case $action in
  update)
    mkdir -p "$out"
    todo=()
    for study in "${studies[@]}"; do
      { completed "$study" && made_by_this "$study"; } || todo+=("$study")
    done
    [[ ${#todo[@]} -gt 0 ]] || exit 0
    # Side by side, a core each, so that none is idle while a study waits for its longest run. The last one first: it takes
    # one core however many there are (work_precision, which measures times). Gates are judged afterwards, all together.
    each=$((${#todo[@]} < jobs ? jobs / ${#todo[@]} : 1))
    export vlbeam profile out each
    code=0
    printf '%s\n' "${todo[@]}" | tac | xargs -P "$jobs" -I '{}' bash -c '
      code=0
      said=$("$vlbeam" study "{}" --profile "$profile" --out "$out" --jobs "$each" 2>&1) || code=$?
      printf "%s\n" "$said"
      [[ $code -lt 128 ]] || exit 255  # stopped by the user: xargs starts no more, and the next call carries on
      [[ $code -le 1 ]]' || code=$?
    case $code in
      0)
        for study in "${todo[@]}"; do note_made "$study"; done
        exit 0
        ;;
      124 | 125) exit 130 ;;
      *) exit 3 ;;
    esac
    ;;
  run)
    failed=0
    mkdir -p "$out"
    for study in "${studies[@]}"; do
      if [[ -z ${5:-} ]] && done_before "$study"; then
        echo "$study: finished before the interruption"
        continue
      fi
      code=0
      before=$SECONDS
      "$vlbeam" study "$study" --profile "$profile" --out "$out" --jobs "$jobs" || code=$?
      took+=("$((SECONDS - before)) s $study")
      if [[ $code -ge 128 ]]; then exit "$code"; fi  # stopped by the user: the next run carries on
      if [[ $code -ge 1 ]]; then failed=$code; else note_made "$study"; fi
      if [[ $code -eq 0 && -z ${5:-} ]]; then finished_line "$study" >> "$finished"; fi
    done
    rm -f "$finished"
    if [[ -z ${5:-} ]]; then
      echo "It took $((SECONDS / 60)) minutes; by study:" >&2
      printf '%s\n' "${took[@]}" | sort -rn | sed 's/^/  /' >&2
    fi
    if PYTHONPATH=build/python "$python" -c "import vlbeam, matplotlib, pandas; vlbeam.Scene" 2> /dev/null; then
      PYTHONPATH=build/python "$python" docs/tutorials/run.py --quick
    fi
    "$python" studies/site/build.py "$out"
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
