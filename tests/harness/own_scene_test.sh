#!/usr/bin/env bash
# A scene of one's own: print one, run it, draw it; what is not understood is said, and nothing is lost.
#   own_scene_test.sh PROGRAM
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

# Scenes
check "a scene" 0 "$(exit_of "$vlbeam" scene pendulum)"
cp out.txt scene.json
check "an unknown scene" 2 "$(exit_of "$vlbeam" scene pendulun)"
check "the nearest one" 1 "$(says 'is "pendulum"')"
"$vlbeam" scene bridge > bridge.json
check "a guided mass" 0 "$(exit_of "$vlbeam" run bridge.json)"
check "is said to be guided" 1 "$(says '8000 kg is guided along it')"
check "and not to be held" 0 "$(says 'held')"
"$vlbeam" list > out.txt
check "the list has scenes" 1 "$(grep -c '^  pendulum  Flexible pendulum$' out.txt)"
check "and studies" 1 "$(grep -c "^  torsion  Torsional" out.txt)"

# A tree that was moved brings its scenes along.
mkdir -p moved/bin moved/share/vlbeam/scenes && cp "$vlbeam" moved/bin/ && cp scene.json moved/share/vlbeam/scenes/falling_beam.json
check "a moved tree" 0 "$(exit_of moved/bin/vlbeam scene falling_beam)"
check "its own scene" 1 "$(grep -c '"Flexible pendulum"' out.txt)"

# Shapes and figures
check "a run" 0 "$(exit_of "$vlbeam" run scene.json --report r.json --shape shape.csv --points 4 -q)"
check "points along the axis" $((6 * 8 * 5 + 1)) "$(wc -l < shape.csv)"
check "their units" 1 "$(head -1 shape.csv | grep -c 'tension \[N\]')"
sed 's/"configurations":/"points": 4, "configurations":/' scene.json > points.json
"$vlbeam" run points.json --report points.out -q
check "the report has the same points" 1 "$(python3 - points.out shape.csv << 'PYTHON'
import csv, json, sys
report, table = json.load(open(sys.argv[1])), list(csv.DictReader(open(sys.argv[2])))
mine = [(shape["t"], a["element"][i], a["x"][i], *a["r"][i], *a["v"][i], a["strain"][i], a["curvature"][i], a["tension"][i],
         a["shear"][i], a["moment"][i], a["torque"][i])
        for shape in report["configurations"] for a in [shape["axis"]] for i in range(len(a["x"]))]
print(int(mine == [tuple(map(float, row.values())) for row in table]))
PYTHON
)"
check "the shape is not the report" 2 "$(exit_of "$vlbeam" run scene.json --report x.json --shape x.json)"
sed 's/, "configurations": \[[^]]*\]//' scene.json > without.json
check "no shapes to write" 2 "$(exit_of "$vlbeam" run without.json --shape none.csv)"
check "said so" 1 "$(says '/output/configurations')"
check "nothing written" no "$(there none.csv)"
"$vlbeam" run without.json --report without.out -q
if command -v gnuplot > /dev/null; then
  for what in shape energy tip strain tension curvature moment shear; do
    check "figure $what" 0 "$(exit_of "$vlbeam" plot r.json --what $what -o $what.svg)"
    check "its title" 1 "$(grep -c '>Flexible pendulum<' $what.svg)"
    check "its unit" 1 "$(grep -Ec '\((m|J|N|N m|-|1/m)\)</' $what.svg | sed 's/[1-9][0-9]*/1/')"
  done
  "$vlbeam" scene falling_beam > mass.json && "$vlbeam" run mass.json --report mass.out --quiet
  check "a shape with its mass" 0 "$(exit_of "$vlbeam" plot mass.out -o mass.svg)"
  check "its key" 1 "$(grep -c '>mass<' mass.svg)"
  check "its animation" 0 "$(exit_of "$vlbeam" plot mass.out --what animation -o mass.gif)"
  check "an animation" 0 "$(exit_of "$vlbeam" plot r.json --what animation -o a.gif)"
  check "is a GIF" GIF "$(head -c 3 a.gif)"
  check "a PNG" 0 "$(exit_of "$vlbeam" plot r.json --quantity end.x end.y -o q.png)"
  check "of two units" 2 "$(exit_of "$vlbeam" plot r.json --quantity end.x energy.total -o bad.svg)"
  check "an animation is a GIF" 2 "$(exit_of "$vlbeam" plot r.json --what animation -o bad.svg)"
  "$vlbeam" run scene.json --report many.out --frames 20 -q
  check "an envelope" 0 "$(exit_of "$vlbeam" plot many.out --what moment-envelope -o envelope.svg)"
  check "says of how many shapes" 1 "$(grep -c 'envelope of 2[0-9] shapes' envelope.svg)"
  check "extremes" 0 "$(exit_of "$vlbeam" run scene.json --extremes --no-check --report most.out)"
  check "are printed" 1 "$(says 'least, largest')"
  check "and reported" 1 "$(grep -c '"bending_moment.max": {' most.out)"
  check "no joint" 2 "$(exit_of "$vlbeam" plot r.json --what joint -o bad.svg)"
  check "no shapes" 2 "$(exit_of "$vlbeam" plot without.out -o bad.svg)"
  check "an unknown figure" 2 "$(exit_of "$vlbeam" plot r.json --what shap -o bad.svg)"
  check "the nearest" 1 "$(says 'is "shape"')"
  check "another ending" 2 "$(exit_of "$vlbeam" plot r.json -o bad.jpg)"
  check "no report" 2 "$(exit_of "$vlbeam" plot scene.json -o bad.svg)"
  check "over the report" 2 "$(exit_of "$vlbeam" plot r.json -o r.json)"
  check "no figure of these" no "$(there bad.svg)"
fi

check "nothing half-written" "" "$(find . -name '*.part')"
verdict
