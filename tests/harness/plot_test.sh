#!/usr/bin/env bash
# Pictures for papers: a column's width, letters in the file, words in the key, energies that add up, fields, animations.
#   plot_test.sh PROGRAM
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"
command -v gnuplot > /dev/null || exit 0
plot() { exit_of "$vlbeam" plot "$@"; }

"$vlbeam" scene falling_beam > scene.json
"$vlbeam" run scene.json --report r.json --csv plain.csv -q
check "a run with frames" 0 "$(exit_of "$vlbeam" run scene.json --report frames.json --csv frames.csv --frames 31 -q)"
check "frames change no digit" 0 "$(exit_of cmp plain.csv frames.csv)"

check "frames of 0.4 s, where 6 * 0.4 / 6 is more" 0 \
  "$("$vlbeam" scene suspended_beam | "$vlbeam" run - --frames 7 -q > out.txt 2> err.txt; echo $?)"

check "a column in SVG" 0 "$(plot r.json --what energy --column --bare -o e.svg)"
check "84 mm at 96 dpi" 1 "$(grep -c '^ width="318"' e.svg)"
check "letters that every viewer has" 0 "$(grep 'font-family' e.svg | grep -vc 'font-family="sans-serif"')"
check "no title" 0 "$(grep -c 'Falling beam' e.svg)"
check "words in the key" 4 "$(grep -cE '>(kinetic|axial strain|bending|gravity)<' e.svg)"
check "no keys in it" 0 "$(grep -c 'energy\.' e.svg)"
check "with a title" 0 "$(plot r.json --column -o s.svg)"
check "the title" 1 "$(grep -c '>Falling beam with a sliding mass<' s.svg)"
check "times with their unit" 1 "$(grep -c '>0.3 s<' s.svg)"
check "a column in PDF" 0 "$(plot r.json --what energy --column -o e.pdf)"
check "its width, 84 mm" 1 "$(grep -ac 'MediaBox \[ 0 0 238 ' e.pdf)"
check "its letters are in it" 1 "$(grep -ac '/FontFile' e.pdf)"
check "a column in PNG" 0 "$(plot r.json --column -o e.png)"
check "84 mm at 300 dpi" 992 "$(python3 -c "print(int.from_bytes(open('e.png','rb').read()[16:20],'big'))")"

# What is drawn adds up to the total, with what friction takes.
sed 's/"position": 0.1/"position": 0.1, "friction": {"coefficient": 0.2}/' scene.json > rubs.json
"$vlbeam" run rubs.json --report rubs.out -q
check "energy with friction" 0 "$(plot rubs.out --what energy -o rubs.svg)"
check "what is dissipated" 1 "$(grep -c '>dissipated<' rubs.svg)"
check "nothing dissipated without" 0 "$(grep -c '>dissipated<' e.svg)"

for what in strain tension curvature; do
  check "a field of $what" 0 "$(plot frames.json --what $what-field -o $what.pdf)"
done
check "a field of one shape" 2 "$(sed 's/"configurations": \[[^]]*\]/"configurations": [0.5]/' scene.json > one.json
  "$vlbeam" run one.json --report one.out -q; plot one.out --what strain-field -o bad.svg)"
check "says how to get more" 1 "$(says '--frames')"

check "an animation" 0 "$(plot frames.json --what animation --column -o a.gif)"
check "a frame a shape" 1 "$(python3 - a.gif frames.json << 'PYTHON'
import json, sys
frames = open(sys.argv[1], "rb").read().count(b"\x21\xf9\x04")
print(int(frames == len(json.load(open(sys.argv[2]))["configurations"]) >= 31))
PYTHON
)"

check "its frames are enough" 0 "$(says 'smooth')"
check "an animation of few frames" 0 "$(plot r.json --what animation -o few.gif)"
check "says how to get more" 1 "$(says 'smooth motion, run the scene with --frames')"
if command -v ffmpeg > /dev/null; then
  check "a film" 0 "$(plot frames.json --what animation -o a.mp4)"
  check "that is one" ftyp "$(head -c 8 a.mp4 | tail -c 4)"
fi
mkdir tools && ln -s "$(command -v gnuplot)" tools/
check "a film without ffmpeg" 2 "$(PATH=$folder/tools plot frames.json --what animation -o b.mp4)"
check "says what does without" 1 "$(says 'ffmpeg, which is not installed .*; a .gif does without')"
check "and leaves nothing" no "$(there b.mp4)"

# In space a picture says which plane it shows.
"$vlbeam" scene drill_stem | sed 's/"duration": [0-9.]*/"duration": 0.01/; s/"output": {[^}]*}/"output": {"configurations": [0, 0.01]}/' > stem.json
"$vlbeam" run stem.json --report stem.out -q
check "in space" 0 "$(plot stem.out -o stem.svg)"
check "its plane" 1 "$(grep -cE ', [XYZ][XYZ] plane<' stem.svg)"

check "formats are named" 2 "$(plot r.json -o bad.jpg)"
check "all three" 1 "$(says '".svg", ".png", ".pdf"')"
check "a misspelled option" 2 "$(exit_of "$vlbeam" run scene.json --cvs r.csv)"
check "the nearest" 1 "$(says '"--csv"')"
check "frames of statics" 2 "$(exit_of "$vlbeam" run <("$vlbeam" scene shallow_arch) --frames 5 -q)"
verdict
