#!/usr/bin/env bash
# The runs of a study are processes: one that crashes costs its case only; a study that is stopped stops them, goes on
# where they were, and has the report of one that never stopped; none outlives it.
#   study_runs_test.sh PROGRAM
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

# It and its runs hold a lock.
study() { flock --no-fork lock "$vlbeam" study energy_drift --profile ci --out "$1" -j 2 > out.txt 2> err.txt; }
bits() { (cd "$1" && find . -type f ! -name '*.timing.*' -exec sha256sum {} + | sort); }
runs_of() { pgrep -P "$1" -f kept-run; }
wait_for() {  # wait_for COMMAND...: until it succeeds
  for ((try = 0; try < 600; ++try)); do "$@" > /dev/null && return; sleep 0.05; done
  failed "waiting for $*"
}
ended() { ! kill -0 "$@" 2> /dev/null; }
kept() { ls "$1"/.energy_drift.ci.kept/*.checkpoint 2> /dev/null; }
# end_run PROCESS SIGNAL: ends a run of the process, which is stopped before so that it does not end by itself.
end_run() {
  local run
  stopped() { run=$(runs_of "$1" | head -1) && kill -STOP "$run" && grep -q '^State:.[Tt]' "/proc/$run/status"; }
  wait_for stopped "$1" 2> /dev/null
  kill -"$2" "$run"
  kill -CONT "$run" 2> /dev/null
  wait_for ended "$run"
}

check "a study" 0 "$(study whole; echo $?)"

for how in INT TERM KILL; do
  study stopped & shell=$!
  wait_for pgrep -P $shell -f energy_drift
  process=$(pgrep -P $shell -f energy_drift)
  wait_for kept stopped
  wait_for runs_of "$process"
  kill -$how "$process"
  wait $shell
  code=$?
  check "a study that is stopped, $how" "$(kill -l $how | awk '{print 128 + $1}')" $code
  check "no run outlives it, $how" 0 "$(timeout 60 flock lock true; echo $?)"
  check "nothing changes, $how" no "$(there stopped/energy_drift.json)"
  check "something is kept, $how" yes "$(kept stopped > /dev/null && echo yes)"
done
check "it goes on" 0 "$(study stopped; echo $?)"
check "with the same bits" "$(bits whole)" "$(bits stopped)"
check "and keeps nothing" no "$(there stopped/.energy_drift.ci.kept)"

# One case crashes; the system ends another one for its memory.
study crash & shell=$!
wait_for pgrep -P $shell -f energy_drift
process=$(pgrep -P $shell -f energy_drift)
end_run "$process" SEGV
end_run "$process" KILL
wait $shell
check "a study with a crash" 3 $?
check "crashed" 1 "$(grep -c 'ended by signal 11 (Segmentation fault)' crash/energy_drift.json)"
check "killed" 1 "$(grep -c 'ended by signal 9 (killed' crash/energy_drift.json)"
check "only these" 1 "$(grep -c '"failure": "2 of [0-9]* cases failed"' crash/energy_drift.json)"
check "again: these are run, the others are kept" 0 "$(study crash; echo $?)"
check "with the same bits" "$(bits whole)" "$(bits crash)"

# A run whose study is gone before it begins ends at once.
echo '{"scene": {"schema": "vlbeam.scene/1", "beam": {"elements": 6}, "duration": 1e3}, "automatic": false}' > asked.json
(sleep 0.2; timeout 20 "$vlbeam" kept-run alone < asked.json; echo $? > code.txt) | true
check "a run that nobody waits for goes on" no "$([[ $(< code.txt) -eq 124 ]] && echo yes || echo no)"

check "a command that is not shown" 0 "$("$vlbeam" --help | grep -c kept-run)"
verdict
