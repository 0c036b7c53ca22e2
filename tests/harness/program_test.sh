#!/usr/bin/env bash
# The program as users meet it: exit codes, and output files that only appear once they are whole.
#   program_test.sh PROGRAM
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

cat > scene.json << 'SCENE'
{"schema": "vlbeam.scene/1", "supports": [{"at": "start", "type": "clamp"}], "beam": {"elements": 4},
 "duration": 0.01, "output": {"interval": 0.005}}
SCENE

check "a run" 0 "$(exit_of "$vlbeam" run scene.json --report r.json --csv r.csv)"
check "its report" 1 "$(grep -c '"status": "completed"' r.json)"
check "its samples" 4 "$(wc -l < r.csv)"
check "summary on standard error" 0 "$(exit_of "$vlbeam" run scene.json)"
check "summary says the status" 1 "$(grep -c 'status *completed' err.txt)"
check "nothing on standard output" "" "$(cat out.txt)"
check "no summary" "0" "$(exit_of "$vlbeam" run scene.json --quiet)"
check "no summary" "" "$(cat out.txt err.txt)"
"$vlbeam" run - --report - < scene.json > piped.json 2> err.txt
check "standard input and output" 1 "$(grep -c '"status": "completed"' piped.json)"

sed 's/"elements": 4/"elemnts": 4/' scene.json > bad.json
check "bad input" 2 "$(exit_of "$vlbeam" run bad.json --report bad.out --csv bad.csv)"
check "its message" 1 "$(grep -c '/beam/elemnts.*"elements"' err.txt)"
check "no report of it" no "$([[ -e bad.out || -e bad.csv ]] && echo yes || echo no)"
check "a file that is not there" 2 "$(exit_of "$vlbeam" run missing.json)"
echo 'not json' > bad.json
check "not JSON" 2 "$(exit_of "$vlbeam" run bad.json)"

# Interrupted: the report is kept, and says so.
sed 's/"duration": 0.01/"duration": 1000/' scene.json > long.json
"$vlbeam" run long.json --report long.out 2> /dev/null &
sleep 0.5
kill -INT $!
wait $!
check "an interrupted run" 130 $?
check "its report" 1 "$(grep -c '"status": "interrupted"' long.out)"

check "no command" 2 "$(exit_of "$vlbeam")"
check "an unknown command" 2 "$(exit_of "$vlbeam" dance)"
check "and the nearest" 1 "$(exit_of "$vlbeam" runn > /dev/null; grep -c 'nearest is "run"' err.txt)"
check "a plot of a scene" 2 "$(exit_of "$vlbeam" plot scene.json -o p.svg)"
check "which says what to do" 1 "$(grep -c 'this is a scene; run it first' err.txt)"
check "one part of a schema, to read" 0 "$(exit_of "$vlbeam" schema scene /beam/material --text)"
check "its lines" 1 "$(grep -c '^/beam/material/density  number > 0.0  default 7200.0$' out.txt)"
check "nothing else" 0 "$(grep -c '^/gravity' out.txt)"
check "a part that is not there" 2 "$(exit_of "$vlbeam" schema scene /beam/materal)"
check "and the nearest" 1 "$(grep -c '"material"' err.txt)"
check "converge" 0 "$(exit_of "$vlbeam" converge scene.json --quantity end.y --error 1e-3)"
check "says each level" 1 "$(($(grep -c '^  mesh .* s$' err.txt) >= 3))"

# Shaken 20 times a second, an undamped method of steps of 10 ms gains energy; the integrator that a scene chooses does not.
cat > shaken.json << 'SCENE'
{"beam": {"elements": 128, "section": {"radius": 0.005},
          "material": {"density": 1100, "youngs_modulus": 2e9, "damping": 1e-4}},
 "supports": [{"at": "start", "type": "clamp",
               "motion": {"direction": [0, 1], "amplitude": 0.02, "frequency": 3, "ramp": 0.5}}],
 "point_masses": [{"node": 128, "mass": 0.1}],
 "sliding_mass": {"mass": 0.05, "position": 0.3, "friction": {"coefficient": 0.1}},
 "duration": 0.4, "output": {"interval": 0.01}}
SCENE
check "a scene that chooses its steps" 0 "$(exit_of "$vlbeam" run shaken.json)"
check "which it says" 1 "$(grep -c 'generalized-alpha (auto), rtol 2.8e-09, .*, steps up to .* s$' err.txt)"
check "and no warning" 0 "$(grep -c warning err.txt)"
sed -e 's/"duration"/"integrator": {"type": "generalized-alpha", "step": 0.01, "rho_inf": 1}, "duration"/' -e 's/128/10/g' \
  -e 's/"amplitude": 0.02, "frequency": 3, "ramp": 0.5/"amplitude": 0.3, "frequency": 20, "ramp": 0.1/' -e 's/, "damping": 1e-4//' \
  -e 's/"duration": 0.4/"duration": 2/' shaken.json > unstable.json
check "an unstable computation" 3 "$(exit_of "$vlbeam" run unstable.json --report u.json)"
check "which it says" 1 "$(grep -c 'the computation is unstable: of .* come from nowhere' err.txt)"
check "and keeps what there is" 1 "$(grep -c '"status": "failed"' u.json)"

# Whole numbers beyond 1e5 stay numbers.
cat > large.json << 'SCENE'
{"beam": {"curve": {"start": [0, 1e6], "end": [1, 1e6]}, "elements": 2}, "gravity": [0, 0], "duration": 0.01}
SCENE
check "a place of 1e6 m" 0 "$(exit_of "$vlbeam" run large.json --report large.out)"
check "can be read" 0 "$(exit_of "$vlbeam" compare large.out large.out)"

check "help" 0 "$(exit_of "$vlbeam" --help)"
check "list" 0 "$(exit_of "$vlbeam" list)"
check "an unknown study" 2 "$(exit_of "$vlbeam" study no-such-study)"
check "gate of a missing report" 2 "$(exit_of "$vlbeam" gate missing.json)"
for schema in scene run study gates; do check "schema $schema" 0 "$(exit_of "$vlbeam" schema $schema)"; done
check "an unknown schema" 2 "$(exit_of "$vlbeam" schema beam)"
check "nothing half-written" "" "$(find . -name '*.part')"

verdict
