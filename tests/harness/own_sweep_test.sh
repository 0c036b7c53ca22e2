#!/usr/bin/env bash
# A sweep is killed at random moments and gone on with: the joined files have the same bits. A case that crashes, or asks
# for too much memory, costs itself only. A scene that has changed is no resume.
#   own_sweep_test.sh PROGRAM [COUNT [SEED]]
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
count=${2:-5}
RANDOM=${3:-1}

bits() { cat "$1/sweep.csv" "$1/sweep.json" | sha256sum; }

"$vlbeam" scene pendulum > pendulum.json
cat > sweep.json << 'SWEEP'
{"schema": "vlbeam.sweep/1", "scene": "pendulum.json", "quantities": ["end.y"],
 "over": {"/beam/elements": [4, 5, 6, 7, 8], "/integrator/rtol /integrator/atol":
          {"from": 1e-9, "to": 1e-6, "count": 4, "spacing": "logarithmic"}, "/beam/element": ["ALE-RANCF", "ALE-ANCF"]}}
SWEEP
check "a sweep" 0 "$(exit_of "$vlbeam" sweep sweep.json --out whole -j 1)"
check "its cases" 41 "$(wc -l < whole/sweep.csv)"
check "again: nothing to run" 0 "$(exit_of "$vlbeam" sweep sweep.json --out whole)"

for ((round = 1; round <= count; ++round)); do
  out=killed_$((round % 3))
  how=(KILL TERM INT)
  "$vlbeam" sweep sweep.json --out $out -j 2 > /dev/null 2>&1 &
  sleep "0.$(printf '%03d' $((RANDOM % 900)))"
  kill -"${how[RANDOM % 3]}" $! 2> /dev/null
  wait $! 2> /dev/null
  for file in $out/cases/*.json; do
    [[ ! -e $file ]] || python3 -c 'import json, sys; json.load(open(sys.argv[1]))' "$file" || check "whole" "$file" "torn"
  done
  if ((round % 3 == 0 || round == count)); then
    check "resumed" 0 "$(exit_of "$vlbeam" sweep sweep.json --out $out -j 2)"
    check "the same bits, round $round" "$(bits whole)" "$(bits $out)"
    rm -rf $out
  fi
done

# By hand, as the jobs of an array do it.
for ((k = 39; k >= 0; --k)); do "$vlbeam" sweep sweep.json --out array --case $k > /dev/null 2>&1; done
check "cases of an array, joined" 0 "$(exit_of "$vlbeam" sweep sweep.json --out array --collect)"
check "the same bits" "$(bits whole)" "$(bits array)"
rm array/cases/000007.json
check "one is missing" 3 "$(exit_of "$vlbeam" sweep sweep.json --out array --collect)"
check "which one" 1 "$(grep -c 'the first is 7' err.txt)"
check "no such case" 2 "$(exit_of "$vlbeam" sweep sweep.json --out array --case 40)"

# One case is killed from outside, one asks for too much.
sed 's/"duration": 0.5/"duration": 500/' pendulum.json > long.json
cat > crash.json << 'SWEEP'
{"schema": "vlbeam.sweep/1", "scene": "long.json", "combine": "zip", "quantities": ["end.y"],
 "over": {"/duration": [0.3, 0.05, 0.05, 500], "/beam/elements": [4, 4, 300000, 4]}}
SWEEP
sed -i 's/"configurations": \[[^]]*\]/"configurations": []/' long.json
"$vlbeam" sweep crash.json --out crash -j 2 --memory 300 > /dev/null 2> err.txt &
sweep=$!
for ((i = 0; i < 600; ++i)); do
  victim=$(pgrep -P $sweep -f -- '--case 3' | head -1)
  [[ -n $victim && -e crash/cases/000002.json ]] && break
  sleep 0.1
done
kill -SEGV "$victim"
wait $sweep
check "a sweep with crashes" 3 $?
check "killed" 1 "$(grep -c '^3,500,4,crashed' crash/sweep.csv)"
check "by what" 1 "$(grep -c 'ended by signal 11' crash/sweep.json)"
check "out of memory" 1 "$(grep -c 'out of memory' crash/sweep.json)"
check "the others" 2 "$(grep -c ',completed,' crash/sweep.csv)"

sed -i 's/"gravity_ramp": 0.25/"gravity_ramp": 0.2/' pendulum.json
check "another scene" 2 "$(exit_of "$vlbeam" sweep sweep.json --out whole)"
check "says so" 1 "$(grep -c 'scene has changed' err.txt)"
check "nothing lost" 41 "$(wc -l < whole/sweep.csv)"

check "nothing half-written" "" "$(find whole crash -name '*.part')"
verdict
