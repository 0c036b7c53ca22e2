#!/usr/bin/env bash
# Draws a picture of every example scene.
#   gallery.sh PROGRAM [OUT]
set -euo pipefail
program=$1
out=${2:-docs/scenes}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$out"
for file in scenes/*.json; do
  name=$(basename "$file" .json)
  case $name in
    torsion) what=(--quantity angle_start angle_end) ;;
    drill_stem) what=(--quantity end.x end.y) ;;
    bridge) what=(--quantity mass_position.y) ;;
    rotating_load) what=(--quantity load0_x load0_y) ;;
    cable_robot) what=(--quantity platform.position.y) ;;
    cable_robot_in_space) what=(--quantity platform.position.z) ;;
    double_atwood) what=(--quantity "lower string.joint 0.position") ;;
    elevator) what=(--quantity end.y) ;;
    atwood | incline | lead_screw | rope_off_peg | suspended_beam_friction) what=(--what joint) ;;
    hanging_cable) what=(--what tension) ;;
    pulled_bar) what=(--what strain) ;;
    *) what=(--what shape) ;;
  esac
  "$program" run "$file" --report "$scratch/r.json" --quiet
  "$program" plot "$scratch/r.json" "${what[@]}" --column --bare -o "$out/$name.svg"
done
