#!/usr/bin/env bash
# Scenes that are none: each is refused with exit code 2, by a message that names the file, the place in it, what stands
# there and what may, and nothing is written. The limit in time is no speed: it ends what takes more than linear time.
#   bad_input_test.sh PROGRAM
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

refused() {  # refused WHAT FILE PATTERN...: every pattern must be found in the message
  local what=$1 file=$2 pattern code
  shift 2
  timeout 60 "$vlbeam" run "$file" --report r.json --csv r.csv > out.txt 2> err.txt
  code=$?
  [[ $code -eq 2 ]] || failed "$what: exit code $code (124: not done in 60 s): $(head -c 300 err.txt)"
  [[ $(wc -l < err.txt) -eq 1 && $(wc -c < err.txt) -le 800 ]] || failed "$what: not one short line: $(head -c 300 err.txt)"
  [[ ! -s out.txt && ! -e r.json && ! -e r.csv ]] || failed "$what: something was written"
  rm -f r.json r.csv
  for pattern in "vlbeam: $file: " "$@"; do
    grep -qF -- "$pattern" err.txt || failed "$what: no '$pattern' in: $(head -c 300 err.txt)"
  done
}

text() {  # text NAME TEXT PATTERN...: a file of this text
  local what=$1 content=$2
  shift 2
  printf '%s' "$content" > scene.json
  refused "$what" scene.json "$@"
}

# scene KEYS...: a scene with these keys; nurbs POINTS WEIGHTS: one along a curve
scene() { echo "{\"beam\": {\"elements\": 4}, \"duration\": 0.5, $1}"; }
beam() { echo "{\"beam\": {$1}, \"duration\": 0.5}"; }

# What is no JSON: with line and column.
text "nothing" "" "line 1, column 1: the end of the text"
text "an open object" '{"duration": 1,' "line 1, column 16: the end of the text"
text "a missing comma" $'{\n "duration": 1\n "beam": {}}' 'line 3, column 2: "beam"' "it is no JSON"
text "letters before it in the line" $'{"title": "\xc2\xb5\xc2\xb5", "duration": NaN}' 'line 1, column 29: "NaN"' "invalid literal"
text "infinity" '{"duration": -Infinity}' 'line 1, column 14: "-Infinity"' "it is no JSON"
text "a number beyond all" '{"duration": 1e400}' 'line 1, column 14: "1e400"' "1.8e308"
text "a comment" '{} // no' 'line 1, column 4: "/"'
text "bytes that are no text" $'{"title": "\xff"}' "line 1, column 12"
printf '{"title": "a\0b"}' > scene.json
refused "a zero byte" scene.json "line 1, column 13"

# What is no scene.
for top in 3 null '[]' '"beam"' true; do text "top level $top" "$top" "the top level: $top" "it must be an object"; done
text "no beam" '{"duration": 1}' "/beam: is missing"
text "no duration" '{"beam": {}}' "/duration: is missing" "a number > 0 [s]"
text "nothing in it" '{}' "is missing"
text "equal keys" '{"beam": {"curve": {"a/b~": [{}, {"x": 1, "x": 2}]}}}' "/beam/curve/a~1b~0/1/x: a second key"
text "equal keys at the top" '{"beam": {}, "beam": {}}' " /beam: a second key"

# Nesting that no recursion can follow, in what is read and in what is shown of it.
for count in 100000 1000000; do
  head -c "$count" < /dev/zero | tr '\0' '[' > deep.json
  refused "$count open arrays" deep.json "nested more than 100 deep"
  { printf '{"beam": '; head -c "$count" < /dev/zero | tr '\0' '['; head -c "$count" < /dev/zero | tr '\0' ']'; echo '}'; } > deep.json
  refused "$count nested arrays" deep.json "/beam/...: arrays and objects nested more than 100 deep"
  { yes '{"a":' | head -n "$count" | tr -d '\n'; printf 1; yes '}' | head -n "$count" | tr -d '\n'; } > deep.json
  refused "$count nested objects" deep.json "/a/...: arrays and objects nested more than 100 deep"
done

# Long ones.
{ printf '{"beam": {'; seq -f '"k%.0f":1' -s, 1 100000; printf '}, "duration": 1}'; } > long.json
refused "1e5 unknown keys" long.json "/beam/k1: an unknown key"
{ printf '{"beam": {}, "duration": 1, "title": ['; seq -s, 1 1000000; printf ']}'; } > long.json
refused "a title of 1e6 numbers" long.json "/title: [1,2,3,4" "a string"
{ printf '{"beam": {"curve": {"type": "nurbs", "degree": 3, "knots": ['; seq -s, 1 2000000
  printf '], "control_points": [[0,0],[1,0],[2,0],[3,0]]}}, "duration": 1}'; } > long.json
refused "2e6 knots" long.json "/beam/curve/knots: 2000000 entries" "at most 69"
{ printf '{"beam": {}, "duration": 1, "output": {"configurations": [0.5'; yes ',0.5' | head -n 100000 | tr -d '\n'; echo ']}}'; } > long.json
refused "1e5 equal times" long.json "/output/configurations/1: 0.5" "ascending"
{ printf '{"duration": 1, "output": {"configurations": ['; seq -f '%.0fe-7' -s, 1 100000
  echo ']}, "beam": {"elements": 1000}}'; } > long.json
refused "1e8 nodes of shapes" long.json "/output/configurations: 100000 entries" "at most 99900 shapes"

# Numbers that cannot be meant, or not be computed with.
text "an int that is none" "$(beam '"elements": 4.5')" "/beam/elements: 4.5" "a whole number in [2, 1e+06]"
text "an int beyond ints" "$(beam '"elements": 1e300')" "/beam/elements: 1e+300"
text "rtol" "$(scene '"integrator": {"rtol": 1e-15}')" "/integrator/rtol: 1e-15" "in [1e-14, 1]"
for step in 1e-10 1e-300; do
  text "step $step" "$(scene "\"integrator\": {\"type\": \"generalized-alpha\", \"step\": $step}")" \
    "/integrator/step: " "1e9 steps"
done
for interval in 1e-9 1e-300; do
  text "interval $interval" "$(scene "\"output\": {\"interval\": $interval}")" "/output/interval: " "at most 1e7 samples"
done
text "unequal weights" "$(beam '"weights": [1, 1e-7, 1, 1]')" "/beam/weights/1: 1e-07" "the largest here is 1"
text "unequal weights of a curve" "$(beam '"curve": {"type": "nurbs", "degree": 1, "knots": [0,0,1,1], "weights": [1e9, 1],
  "control_points": [[0,0],[1,0]]}')" "/beam/curve/weights/1: 1" "the largest here is 1e+09"
for radius in 1e-200 1e200 1e-90; do
  text "radius $radius" "$(beam "\"section\": {\"radius\": $radius}")" "/beam/section/radius: " "between 1e-100 and 1e100"
done
text "EA" "$(beam '"section": {"type": "stiffness", "EA": 1e200, "EI": 0, "rhoA": 1}')" "/beam/section/EA: 1e+200"
text "a short beam" "$(beam '"curve": {"end": [1e-200, 0]}')" "/beam/curve: a length of"
text "a long beam" "$(beam '"curve": {"end": [1e200, 0]}')" "/beam/curve: a length of"
text "a mass on the end" "$(scene '"sliding_mass": {"mass": 1, "position": 1e-14}')" "/sliding_mass/position: 1e-14" \
  "more than 1e-09 and less than 0.999999999"
text "a torque on a beam" "$(scene '"loads": [{"type": "torque", "node": 1, "magnitude": {"value": 1}}]')" \
  '/spin: is missing' "/loads/0 is a torque"

# Control characters do nothing at the terminal.
printf '{"beam": {"\\u001b[31m": 1}, "duration": 1}' > scene.json
refused "a control character in a key" scene.json '\u001b[31m: an unknown key'
printf '{"beam": {}, "duration": 1, "title": "\\u001b]0;owned\\u0007\\nstatus", "integrator": {"type": "\\u001b[0m"}}' > scene.json
refused "a control character in a value" scene.json '\u001b[0m'
printf '{"beam": {"elements": 1e1}, "duration": 0.001, "title": "a\\u001b]0;owned\\u0007\\n  status"}' > scene.json
"$vlbeam" run scene.json 2> err.txt || failed "a whole number written as 1e1"
LC_ALL=C grep -q $'[\x01-\x09\x0b-\x1f]' err.txt && failed "a title acts on the terminal"
grep -qF 'a\u001b]0;owned\u0007\u000a  status' err.txt || failed "a title with control characters is not shown"

# Other files say where, too.
mkdir -p studies/torsion
printf '{\n "modes": 3,,}' > studies/torsion/study.json
printf '{"schema": "vlbeam.gates/1", "gates": [{"name": "a", "name": "b"}]}' > studies/torsion/gates.json
"$vlbeam" study torsion --profile ci --studies studies --out out 2> err.txt; code=$?
[[ $code -eq 2 ]] && grep -qF 'studies/torsion/study.json: line 2, column 13: ","' err.txt || failed "a study's data: $(cat err.txt)"
"$vlbeam" study torsion --profile ci --studies nowhere --out out 2> err.txt; code=$?
[[ $code -eq 2 ]] && grep -qF 'looked for nowhere/torsion/gates.json' err.txt || failed "no studies: $(cat err.txt)"
echo '{"study": "torsion"}' > report.json
"$vlbeam" gate report.json 2> err.txt; code=$?
[[ $code -eq 2 ]] && grep -qF 'report.json: /schema_version' err.txt || failed "no report: $(cat err.txt)"
[[ ! -e out ]] || failed "a refused study writes"

verdict
