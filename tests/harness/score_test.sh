#!/usr/bin/env bash
# The kit of cases: scenes and answers to take away, errors and orders of what comes back, another code's among it.
#   score_test.sh PROGRAM
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/checks.sh"
score() { exit_of "$vlbeam" score "$@"; }

"$vlbeam" score > cases.txt
check "eleven cases of the judge, one of the program" 12 "$(grep -c '^  by ' cases.txt)"
check "the kit" 0 "$(score --kit kit)"
check "a kit over something" 2 "$(score --kit kit)"
check "a scene and answers of each" 24 "$(ls kit | wc -l)"

# The answers themselves have no error.
mkdir answers
cp kit/sleeve_smooth.csv answers/
check "the answers" 0 "$(score answers)"
"$vlbeam" score answers > answers.txt
check "no error is seen in them" 6 "$(grep -c 'no error seen' answers.txt)"

# This program, with three meshes.
mkdir ours
for n in 8 16 32; do
  python3 - $n > scene.json << 'SCENE'
import json, sys
scene = json.load(open("kit/sleeve_smooth.json"))
scene["beam"]["elements"] = int(sys.argv[1])
scene["integrator"] = {"type": "dopri5", "rtol": 1e-9, "atol": 1e-9}
scene["output"] = {"interval": 0.025}
json.dump(scene, sys.stdout)
SCENE
  "$vlbeam" run scene.json -q --csv ours/sleeve_smooth_ours_N$n.csv || failed "a run of the kit's scene"
done
check "three meshes" 0 "$(score ours --report ours.json)"
python3 - << 'LOOK' || failed "the errors of three meshes"
import json
rows = {row["column"]: row for row in json.load(open("ours.json"))["meshes"]}
for column in ("end_x", "end_y"):
    assert rows[column]["elements"] == [8, 16, 32], rows[column]
    assert rows[column]["errors"][2] < 1e-6, rows[column]
    assert rows[column]["errors"][2] < rows[column]["errors"][0] / 20, rows[column]
LOOK

# EXUDYN's.
"$vlbeam" score falling_beam_engineering "$here/../../reference/trajectories/exudyn_falling_beam_N80.csv" > exudyn.txt
check "another code" 0 "$?"
check "what it says of its joint" 1 "$(grep -c 'joint_position: no error seen: below what is known' exudyn.txt)"

printf 't,joint_positon\n0.1,0.1\n' > wrong.csv
check "a misnamed column" 2 "$(score falling_beam wrong.csv)"
check "a case without a trajectory" 2 "$(score falling_beam)"
verdict
