#!/usr/bin/env bash
# A run that is killed, or stopped, goes on from its checkpoint and ends with the digits of one that was not.
#   restart_test.sh PROGRAM
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

cat > scene.json << 'SCENE'
{"schema": "vlbeam.scene/1", "supports": [{"at": "start", "type": "clamp"}],
 "beam": {"elements": 12, "element": "ALE-ANCF"}, "sliding_mass": {"mass": 0.8, "position": 0.1},
 "integrator": {"type": "dopri5", "rtol": 1e-9}, "duration": 0.5, "output": {"interval": 0.01, "configurations": [0.4]}}
SCENE
differences() {  # differences A B: the keys of two reports that differ, but for what no two runs have in common
  python3 -c '
import json, sys
a, b = ({**json.load(open(f)), "provenance": 0, "timing": 0} for f in sys.argv[1:])
print(*(key for key in a if a[key] != b.get(key)))' "$1" "$2"
}
appears() {  # appears FILE: waits for it
  for ((try = 0; try < 1000; ++try)); do [[ -e $1 ]] && return; sleep 0.01; done
  failed "$1 does not appear"
}

check "a run" 0 "$(exit_of "$vlbeam" run scene.json --report whole.json --csv whole.csv)"
check "a run with checkpoints" 0 "$(exit_of "$vlbeam" run scene.json --report with.json --checkpoint c --every 0.05)"
check "its report" "" "$(differences whole.json with.json)"
rm c

"$vlbeam" run scene.json --report r.json --checkpoint c --every 0.05 2> /dev/null &
appears c; kill -KILL $!; wait $! 2> /dev/null
check "no report of a run that was killed" no "$(there r.json)"
check "a run from its checkpoint" 0 "$(exit_of "$vlbeam" run scene.json --report r.json --csv r.csv --restart c)"
check "its report" "" "$(differences whole.json r.json)"
check "its table" "" "$(cmp whole.csv r.csv)"
rm c

"$vlbeam" run scene.json --report stopped.json --checkpoint c --every 0.05 2> err.txt &
appears c; kill -TERM $!; wait $!
check "a run that is stopped" 143 $?
check "how it says so" 1 "$(says 'interrupted; --restart c goes on')"
check "a run from its checkpoint, that keeps more" 0 \
  "$(exit_of "$vlbeam" run scene.json --report r.json --restart c --checkpoint c --every 0.05 --force)"
check "its report" "" "$(differences whole.json r.json)"
check "a run from the last of these" 0 "$(exit_of "$vlbeam" run scene.json --report r.json --restart c)"
check "its report" "" "$(differences whole.json r.json)"

cp c whole; head -c 1000 whole > c
check "a truncated checkpoint" 2 "$(exit_of "$vlbeam" run scene.json --restart c)"
check "its message" 1 "$(says 'c: a checkpoint that is truncated or damaged is not allowed')"
check "no checkpoint" 2 "$(exit_of "$vlbeam" run scene.json --restart scene.json)"
check "no file" 2 "$(exit_of "$vlbeam" run scene.json --restart nothing)"
sed 's/0.8/0.9/' scene.json > other.json
check "a checkpoint of another scene" 2 "$(exit_of "$vlbeam" run other.json --restart whole)"
check "its message" 1 "$(says 'it differs at /sliding_')"
check "statics" 2 "$(echo '{"analysis": "statics", "supports": [{"at": "start", "type": "clamp"}]}' > statics.json
                     exit_of "$vlbeam" run statics.json --checkpoint c)"
check "an interval without a file" 2 "$(exit_of "$vlbeam" run scene.json --every 0.1)"
check "an interval of nothing" 2 "$(exit_of "$vlbeam" run scene.json --checkpoint c --every 0)"
check "standard output" 2 "$(exit_of "$vlbeam" run scene.json --checkpoint -)"
check "a limit of file sizes" 3 "$(ulimit -f 2; exit_of "$vlbeam" run scene.json --checkpoint large --every 0.1)"
check "its reason" 1 "$(says 'large: File too large')"
check "no part of it" no "$(there large)"
check "the scene itself" 2 "$(exit_of "$vlbeam" run scene.json --checkpoint scene.json)"
check "nothing half-written" "" "$(find . -name '*.part')"
verdict
