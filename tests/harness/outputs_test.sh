#!/usr/bin/env bash
# What a run may and may not do to files: devices, pipes, links, names that are one another, full disks, results of
# earlier runs.
#   outputs_test.sh PROGRAM
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

computing() {  # computing PROCESS: waits until it handles signals, SIGXCPU (24) among them
  local caught
  for ((try = 0; try < 200; ++try)); do
    caught=$(awk '/^SigCgt/ { print $2 }' "/proc/$1/status")
    (((16#${caught:-0} >> 23) & 1)) && break
    sleep 0.02
  done
  sleep 0.1
}

cat > scene.json << 'SCENE'
{"schema": "vlbeam.scene/1", "supports": [{"at": "start", "type": "clamp"}], "beam": {"elements": 4},
 "duration": 0.01, "output": {"interval": 0.005}}
SCENE
# Without length control the mass runs into a node.
cat > broken.json << 'SCENE'
{"supports": [{"at": "start", "type": "clamp"}], "beam": {"elements": 4}, "gravity": [0, 0], "duration": 1,
 "sliding_mass": {"mass": 0.8, "position": 0.6, "velocity": 5}, "length_control": {"enabled": false},
 "integrator": {"type": "generalized-alpha", "step": 1e-3}}
SCENE
sed 's/"duration": 0.01/"duration": 1000/' scene.json > long.json
cp scene.json kept.json

# Links are followed, whether their target is there or not; permissions stay.
ln -s target.json link.json
check "a link to nothing" 0 "$(exit_of "$vlbeam" run scene.json --report link.json)"
check "its target" 1 "$(grep -c '"status": "completed"' target.json)"
check "the link" target.json "$(readlink link.json)"
mkdir deep && ln -s ../link.json deep/chain.json && chmod 640 target.json && : > target.json
check "a chain of links" 0 "$(exit_of "$vlbeam" run scene.json --report deep/chain.json)"
check "its target" 1 "$(grep -c '"status": "completed"' target.json)"
check "its permissions" 640 "$(stat -c %a target.json)"

# What is no regular file is written into.
mkfifo pipe
(cat pipe > from_pipe.csv) &
check "a pipe" 0 "$(exit_of "$vlbeam" run scene.json --csv pipe)"
wait
check "what came through it" 4 "$(wc -l < from_pipe.csv)"
check "the pipe" fifo "$(stat -c %F pipe)"
if mknod null c 1 3 2> /dev/null && mknod full c 1 7 2> /dev/null; then
  check "a device" 0 "$(exit_of "$vlbeam" run scene.json --report null --csv null)"
  check "the device" "character special file" "$(stat -c %F null)"
  check "a full device" 3 "$(exit_of "$vlbeam" run scene.json --report full --csv r.csv)"
  check "its reason" 1 "$(says 'full: No space left on device')"
  check "the other file is written" 4 "$(wc -l < r.csv)"
fi
check "process substitution" 0 "$(exit_of "$vlbeam" run scene.json --csv >(cat > substituted.csv))"
check "/dev/stdout" 0 "$(exit_of "$vlbeam" run scene.json --csv /dev/stdout)"
check "what stands there" 4 "$(wc -l < out.txt)"

# A full disk under standard output is never silence.
for command in "schema scene" "list" "--help" "run --help" "run scene.json --report -" "run scene.json --csv -"; do
  # shellcheck disable=SC2086
  "$vlbeam" $command > /dev/full 2> err.txt
  check "full disk under $command" yes "$([[ $? -ne 0 ]] && echo yes)"
done
"$vlbeam" run scene.json 2> /dev/full
check "full disk under the summary" 3 $?
check "a closed standard error" 0 "$("$vlbeam" run scene.json 2>&-; echo $?)"

# Names that are one another, or the scene.
ln scene.json hard.json; ln -s scene.json soft.json
for name in scene.json ./scene.json hard.json soft.json "$PWD/scene.json"; do
  check "a report over the scene, $name" 2 "$(exit_of "$vlbeam" run scene.json --report "$name")"
  check "a table over the scene, $name" 2 "$(exit_of "$vlbeam" run scene.json --csv "$name")"
done
check "over the scene that is read from standard input" 2 \
  "$("$vlbeam" run - --report scene.json < scene.json 2> err.txt; echo $?)"
cp scene.json r.failed.json
check "where a failed run would put it" 2 "$(exit_of "$vlbeam" run r.failed.json --report r.json)"
rm r.failed.json
check "report and table in one" 2 "$(exit_of "$vlbeam" run scene.json --report new.json --csv ./new.json)"
check "both to standard output" 2 "$(exit_of "$vlbeam" run scene.json --report - --csv -)"
check "both to standard output, by name" 2 "$(exit_of "$vlbeam" run scene.json --report - --csv /dev/stdout)"
check "one by redirection" 2 "$("$vlbeam" run scene.json --report r.json --csv - > r.json 2> err.txt; echo $?)"
rm -f r.json
for option in --report --csv; do
  check "$option without name" 2 "$(exit_of "$vlbeam" run scene.json $option "")"
  check "its message" 1 "$(says "$option: an empty name")"
done
check "the scene" "" "$(diff scene.json kept.json)"

# No command replaces what it reads, nor what it did not write.
cat > sweep.json << 'SWEEP'
{"schema": "vlbeam.sweep/1", "scene": "scene.json", "over": {"/beam/elements": [4, 5]}}
SWEEP
cp sweep.json sweep.kept
check "a sweep into the folder of its file" 2 "$(exit_of "$vlbeam" sweep sweep.json --out .)"
check "the same by force" 2 "$(exit_of "$vlbeam" sweep sweep.json --out . --force)"
check "its message" 1 "$(says 'the sweep file itself stands there')"
check "the sweep" "" "$(diff sweep.json sweep.kept)"
mkdir foreign && echo mine > foreign/sweep.csv
check "a sweep over somebody's table" 2 "$(exit_of "$vlbeam" sweep sweep.json --out foreign --force)"
check "the table" mine "$(cat foreign/sweep.csv)"
rm foreign/sweep.csv && mkdir foreign/cases && echo mine > foreign/cases/notes.txt
check "a sweep beside somebody's notes" 0 "$(exit_of "$vlbeam" sweep sweep.json --out foreign)"
sed 's/\[4, 5\]/[4, 6]/' sweep.json > other.json
check "another one in its place" 0 "$(exit_of "$vlbeam" sweep other.json --out foreign --force)"
check "the notes" mine "$(cat foreign/cases/notes.txt)"
sed 's/"duration"/"output": {"interval": 0.005, "configurations": [0]}, "duration"/; s/"output": {"interval": 0.005}/"title": ""/' \
  scene.json > shapes.json
mkdir shapes && echo mine > shapes/shape.pvd
check "shapes over somebody's file" 2 "$(exit_of "$vlbeam" run shapes.json --vtk shapes)"
rm shapes/shape.pvd
check "shapes" 0 "$(exit_of "$vlbeam" run shapes.json --vtk shapes)"
check "shapes again" 0 "$(exit_of "$vlbeam" run shapes.json --vtk shapes)"
check "a checkpoint" 0 "$(exit_of "$vlbeam" run scene.json --checkpoint c --every 0.004)"
cp c c.kept; ln -s c c.link
for name in c ./c c.link; do
  check "a report over the checkpoint, $name" 2 "$(exit_of "$vlbeam" run scene.json --restart c --report "$name")"
done
check "the checkpoint" "" "$(cmp c c.kept)"
echo '{"schema": "vlbeam.scene/1"}' > torsion.json
check "a study over a scene" 2 "$(exit_of "$vlbeam" study torsion --profile ci --out .)"
check "the scene" 1 "$(grep -c vlbeam.scene torsion.json)"

# What cannot be written is known before the run.
for name in deep scene.json/r.csv /proc/r.csv /sys/r.csv "$(printf 'x%.0s' {1..300})"; do
  check "unwritable $name" 2 "$(exit_of timeout 60 "$vlbeam" run long.json --report r.json --csv "$name")"
  check "its option" 1 "$(says '^vlbeam: --csv: ')"
done
check "nothing of it" no "$([[ -e r.json ]] && echo yes || echo no)"
if [[ $(id -u) -ne 0 ]]; then
  mkdir shut && chmod 555 shut && : > readonly.csv && chmod 444 readonly.csv
  for name in shut/r.csv readonly.csv; do
    check "unwritable $name" 2 "$(exit_of timeout 60 "$vlbeam" run long.json --csv "$name")"
  done
fi
check "a folder that is made" 0 "$(exit_of "$vlbeam" run scene.json --report made/by/it/r.json)"

# A run that does not end well leaves earlier results alone.
check "a run" 0 "$(exit_of "$vlbeam" run scene.json --report r.json --csv r.csv)"
cp r.json r.json.kept; cp r.csv r.csv.kept
check "a failed run" 3 "$(exit_of "$vlbeam" run broken.json --report r.json --csv r.csv)"
check "earlier results" "" "$(cmp r.json r.json.kept; cmp r.csv r.csv.kept)"
check "its report" 1 "$(grep -c '"status": "failed"' r.failed.json)"
check "its table" yes "$([[ -s r.failed.csv ]] && echo yes)"
check "it says so" 2 "$(says 'stays (--force replaces it)')"
check "a failed run that may" 3 "$(exit_of "$vlbeam" run broken.json --report r.json --force)"
check "its report" 1 "$(grep -c '"status": "failed"' r.json)"
check "a failed run over a failed one" 3 "$(exit_of "$vlbeam" run broken.json --report r.json)"
check "its message" 0 "$(says 'stays (--force')"
check "a run over a failed one" 0 "$(exit_of "$vlbeam" run scene.json --report r.json)"
check "its report" 1 "$(grep -c '"status": "completed"' r.json)"

# Ended by a signal: reported beside what is there, and told by the exit code. A signal may come twice for one cause.
for signal in INT TERM HUP XCPU; do
  "$vlbeam" run long.json --report r.json --csv new.csv > /dev/null 2> err.txt &
  computing $!; kill -"$signal" $!; kill -"$signal" $! 2> /dev/null; sleep 0.01; kill -"$signal" $! 2> /dev/null; wait $!
  check "the earlier report after $signal" 1 "$(grep -c '"status": "completed"' r.json)"
  check "the report after $signal" 1 "$(grep -c '"status": "interrupted"' r.interrupted.json)"
  check "the table after $signal" yes "$([[ -s new.csv ]] && echo yes)"
  rm -f r.interrupted.json new.csv
  "$vlbeam" run long.json 2> err.txt & computing $!; kill -"$signal" $!; wait $!
  code=$?
  check "exit after $signal" $((128 + $(kill -l "$signal"))) "$code"
done
(trap '' HUP; exec "$vlbeam" run long.json --report hup.json 2> /dev/null) & computing $!; kill -HUP $!; sleep 0.2
kill -KILL $!; wait $! 2> /dev/null
check "an ignored SIGHUP stays ignored" no "$([[ -e hup.json ]] && echo yes || echo no)"

# Files may grow no further, memory is used up: no parts left behind, and the reason is said.
sed 's/0.005/1e-6/' scene.json > many.json
check "a limit of file sizes" 3 "$(ulimit -f 10; exit_of "$vlbeam" run many.json --report big.json --csv small.csv)"
check "its reason" 1 "$(says 'big.json: File too large')"
check "no part of it" no "$([[ -e big.json ]] && echo yes || echo no)"
sed 's/0.005/1e-8/' scene.json > too_many.json
check "a limit of memory" 3 "$(ulimit -v 120000; exit_of "$vlbeam" run too_many.json)"
check "its reason" 1 "$(says 'out of memory')"

check "nothing half-written" "" "$(find . -name '*.part')"
verdict
