#!/usr/bin/env bash
# What compiling costs, in processor seconds, from nothing and without a cache.
#   scripts/build_cost.sh [TARGET...]      each unit and each library; without targets, the program
#   scripts/build_cost.sh --unit FILE.cpp  what in one unit costs most, as clang sees it: headers, templates, functions
set -euo pipefail
cd "$(dirname "$0")/.."
folder=build-cost

configure() {
  mkdir -p $folder
  cat > $folder/timed << 'SCRIPT'
#!/usr/bin/env bash
# Runs a compiler, and notes the seconds that it took for which file.
output=
for ((i = 1; i < $#; ++i)); do
  next=$((i + 1))
  if [[ ${!i} == -o ]]; then output=${!next}; fi
done
exec /usr/bin/time --append --output="$(dirname "$0")/times" --format="%U %S $output" "$@"
SCRIPT
  chmod +x $folder/timed
  cmake -S . -B $folder -DCMAKE_BUILD_TYPE=Release -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
    -DCMAKE_CXX_COMPILER_LAUNCHER="$PWD/$folder/timed" > $folder/configure.log
}

if [[ ${1:-} == --unit ]]; then
  python3 - "$2" << 'SCRIPT'
import collections, json, os, subprocess, sys, tempfile

with tempfile.TemporaryDirectory() as folder:
    output = os.path.join(folder, "unit.o")
    subprocess.run(["clang++", "-std=c++20", "-O3", "-DNDEBUG", "-ffp-contract=off", "-DVLBEAM_HAS_AVX2", "-I.",
                    "-I/usr/include/eigen3", "-ftime-trace", "-c", sys.argv[1], "-o", output], check=True)
    with open(os.path.join(folder, "unit.json"), encoding="utf-8") as file:
        events = json.load(file)["traceEvents"]
for event in events:
    if event["name"] in ("Total ExecuteCompiler", "Total Source", "Total InstantiateFunction", "Total Backend"):
        print(f"{event['dur'] / 1e6:8.2f}  {event['name']}")
costs = collections.Counter()
for event in events:
    if event["name"] in ("Source", "InstantiateFunction", "InstantiateClass", "OptFunction"):
        costs[event["name"] + " " + event["args"].get("detail", "")[:120]] += event["dur"]
for what, micros in costs.most_common(30):
    print(f"{micros / 1e6:8.2f}  {what}")
SCRIPT
  exit
fi

configure
rm -f $folder/times
cmake --build $folder --clean-first --parallel "$(nproc)" --target "${@:-vlbeam_program}" > $folder/build.log
awk '{ library = $3; sub(/.*CMakeFiles\//, "", library); sub(/\.dir\/.*/, "", library)
       unit = $3; sub(/.*\.dir\//, "", unit); sub(/\.o$/, "", unit)
       seconds = $1 + $2; all += seconds; of[library] += seconds; ++units[library]
       printf "%8.1f  %s %s\n", seconds, library, unit > "'$folder'/units" }
     END { for (l in of) printf "%8.1f  %s, %d units\n", of[l], l, units[l] | "sort -rn"; close("sort -rn"); printf "%8.1f  all\n", all }' \
  $folder/times
echo
sort -rn $folder/units | head -25
