#!/usr/bin/env bash
# A program that is built without rooms (-DVLBEAM_ROOMS=none) runs the papers' falling beam, and refuses by its key what
# asks for a room.
#   rooms_test.sh PROGRAM SOURCE
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
scenes=$2/scenes

check "the falling beam" 0 "$(exit_of "$vlbeam" run "$scenes/falling_beam.json" --report beam.json)"
check "it has slid" 1 "$(grep -c '"status": "completed"' beam.json)"
grep -qE 'mass position|joint position' err.txt || failed "no mass on it: $(cat err.txt)"
check "the ramped one, by itself" 0 "$(exit_of "$vlbeam" run "$scenes/falling_beam_ramped.json")"
check "a pendulum" 0 "$(exit_of "$vlbeam" run "$scenes/pendulum.json")"

# refused ROOM KEY BEAM... : parts of a scene
refused() {
  local room=$1 key=$2 parts=$3
  [[ $parts == *'"beam"'* ]] || parts+=', "beam": {"elements": 4}'
  [[ $parts == *'"analysis"'* ]] || parts+=', "duration": 0.1'
  echo "{$parts}" > scene.json
  check "$room: exit code" 2 "$(exit_of "$vlbeam" run scene.json)"
  grep -qF "$key: " err.txt || failed "$room: not $key: $(cat err.txt)"
  grep -qF "it needs \"$room\", which this program is built without" err.txt || failed "$room: $(cat err.txt)"
}
clamped='"supports": [{"at": "start", "type": "clamp"}]'
refused statics /analysis "$clamped, \"analysis\": \"statics\""
refused statics /initial_shape "$clamped, \"initial_shape\": \"equilibrium\""
refused frames /beam/space_law '"dimension": 3, "gravity": [0, 0, -9.81], "supports": [{"at": "start", "type": "clamp", "clamp": "full"}],
  "beam": {"curve": {"type": "line", "start": [0, 0, 0], "end": [1, 0, 0]}, "space_law": "frames"}'
refused spin /spin '"dimension": 3, "gravity": [0, 0, 0], "spin": {"rate": 1}'
refused flow /flow '"gravity": [0, 0], "flow": {"tension": 1}'
refused ropes /drag "$clamped, \"drag\": {\"linear\": {\"normal\": 1}}"
refused ropes /ground "$clamped, \"ground\": {\"height\": -1, \"stiffness\": 1e6}"
refused conserving /integrator/type "$clamped, \"integrator\": {\"type\": \"energy-momentum\", \"step\": 1e-3}"
refused contact /sliding_mass/at_support "$clamped, \"sliding_mass\": {\"mass\": 1, \"position\": 0.5, \"at_support\": \"rebound\"}"
refused remesh /length_control/merge "$clamped, \"sliding_mass\": {\"mass\": 1, \"position\": 0.5}, \"length_control\": {\"cut\": \"exact\", \"merge\": \"relaxed\"}"
verdict
