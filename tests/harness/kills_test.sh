#!/usr/bin/env bash
# Ends runs and studies at random moments, by signals, by a limit of file sizes and of memory, on a full disk where one
# can be mounted: no file is torn, no finished result lost, nothing else is touched, and what was begun can be finished.
#   kills_test.sh PROGRAM [COUNT [SEED]]
set -u
vlbeam=$1
count=${2:-30}
RANDOM=${3:-1}
folder=$(mktemp -d)
cleanup() { umount "$folder/here/disk" 2> /dev/null; rm -rf "$folder"; }
trap cleanup EXIT
mkdir "$folder/here" && cd "$folder/here" || exit 1
failures=0
failed() { echo "FAILED, end $round ($how of $what): $1"; failures=$((failures + 1)); }

cat > scene.json << 'SCENE'
{"schema": "vlbeam.scene/1", "supports": [{"at": "start", "type": "clamp"}], "beam": {"elements": 6},
 "duration": 0.05, "output": {"interval": 5e-5}}
SCENE
mkdir results others && cp scene.json others/kept.json && echo "a line" > others/kept.csv
"$vlbeam" run scene.json --report results/r.json --csv results/r.csv 2> /dev/null || exit 1
"$vlbeam" study quadrature --profile ci --out studies > /dev/null 2>&1 || exit 1
disks=$({ mkdir -p disk && mount -t tmpfs -o size=200k tmpfs disk; } 2> /dev/null && echo yes)
state_of_others() { (cd others && sha256sum -- *; ls -la --time-style=full-iso); sha256sum scene.json; }
others=$(state_of_others)

whole() {  # whole FILE: a report or table that is there is complete
  case $1 in
    *.json) python3 -c 'import json, sys; json.load(open(sys.argv[1]))' "$1" 2> /dev/null || failed "$1 is torn" ;;
    *.csv | *.svg) [[ -s $1 && -z $(tail -c 1 "$1" | tr -d '\n') ]] || failed "$1 is torn" ;;
  esac
}
completed() { grep -q '"status": "completed"' "$1" 2> /dev/null || failed "the result in $1 is lost"; }

ways=(TERM HUP INT KILL QUIT size memory)
[[ $disks == yes ]] && ways+=(disk)
for ((round = 1; round <= count; ++round)); do
  how=${ways[RANDOM % ${#ways[@]}]}
  what=run
  command=("$vlbeam" run scene.json --report results/r.json --csv results/r.csv)
  if ((RANDOM % 3 == 0)) && [[ $how != disk ]]; then
    what=study
    command=("$vlbeam" study quadrature --profile ci --out studies)
  fi
  locked=(flock --no-fork "$folder/lock" "${command[@]}")  # until the program and all that it has started have ended
  case $how in
    size) (ulimit -f $((RANDOM % 400)); "${locked[@]}" > /dev/null 2>&1) ;;
    memory) (ulimit -v $((60000 + RANDOM)); "${locked[@]}" > /dev/null 2>&1) ;;
    disk)
      "$vlbeam" run scene.json --report disk/r.json --csv disk/r.csv > /dev/null 2>&1
      [[ -z $(find disk -name '*.part*') ]] || failed "a part stays on the full disk"
      for file in disk/*; do [[ ! -e $file ]] || whole "$file"; done
      rm -rf disk/*
      ;;
    *)
      "${locked[@]}" > /dev/null 2>&1 &
      while kill -0 $! 2> /dev/null && [[ ! /proc/$!/exe -ef $vlbeam ]]; do sleep 0.001; done  # a shell until then
      sleep "0.$(printf '%03d' $((RANDOM % 400)))"
      kill -"$how" $! 2> /dev/null
      wait $! 2> /dev/null
      ;;
  esac
  flock "$folder/lock" true  # the runs of a study that is killed keep what they have, and end after it
  while IFS= read -r file; do whole "$file"; done < <(find results studies -type f ! -path '*.part*')
  completed results/r.json
  completed studies/quadrature.json
  [[ $(state_of_others) == "$others" ]] || failed "other files were touched"
done

# What was killed is taken up again, and what it had left is gone.
round=after
"$vlbeam" run scene.json --report results/r.json --csv results/r.csv 2> /dev/null || failed "the run"
"$vlbeam" study quadrature --profile ci --out studies > /dev/null 2>&1 || failed "the study"
[[ -z $(find studies -name '*.kept') ]] || failed "runs are kept of a study that is complete"
[[ -z $(find studies -name '*.part') ]] || failed "parts of studies are left: $(find studies -name '*.part')"
[[ $failures -eq 0 ]] && echo "$count ends, nothing lost"
exit "$((failures > 0))"
