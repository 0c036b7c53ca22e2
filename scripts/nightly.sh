#!/usr/bin/env bash
# The checks that take too long for each change, one after another; all run, whatever fails. What was found stands in
# build-nightly/: a log for each, and last.txt, which .ci/run repeats.
#   scripts/nightly.sh [STAGE...]   sanitizers, fuzzing, mutants, documents, studies, trust, fifty (default: all)
set -uo pipefail
cd "$(dirname "$0")/.."
out=build-nightly
mkdir -p $out
export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1 CCACHE_MAXSIZE=5G
jobs=$(nproc)

sanitizers() {  # all tests of the sanitized programs
  cmake --preset asan && cmake --build --preset asan --parallel "$jobs" --target vlbeam_sanitized_nightly || return 1
  printf '%s\n' build-asan/tests/*/vlbeam_*_tests |
    xargs -P "$jobs" -I '{}' sh -c 'timeout 5400 "$1" --gtest_brief=1 || { echo "$1: failed ($?)"; exit 1; }' sh '{}'
}
fuzzing() { scripts/fuzz.sh 300; }
mutants() { CMAKE_ARGS="-DVLBEAM_WERROR=ON -DVLBEAM_PYTHON=ON" scripts/mutants.py --start; }
documents() { make test-docs; }
studies() {  # anew, and no byte of the committed reports differs
  make build && scripts/studies.sh run full $out/reports "$jobs" || return 1
  local differ
  differ=$(for file in "$out"/reports/*.json; do
    [[ $file == *.timing.json ]] || cmp --silent "$file" "reports/${file##*/}" || echo "${file##*/}"
  done)
  [[ -z $differ ]] || { echo "reports differ from those that are committed:" $differ; return 1; }
}
trust() {  # all scenes of the study, of which its report has every fourth
  make build || return 1
  rm -rf $out/trust
  mkdir $out/trust
  cp -r studies reference $out/trust/
  echo '{"every": 1, "fine_every": 12, "first": 2}' > $out/trust/studies/trust/study.json
  build/vlbeam study trust --studies $out/trust/studies --out $out/trust/reports --jobs "$jobs"
}

fifty() { make build && scripts/converge_fifty.py build/vlbeam $out/fifty; }

scripts/packages.sh ci || exit 1
failed=0
{
  echo "$(date -u '+%F %R'), commit $(git rev-parse --short HEAD)"
  for stage in "${@:-sanitizers fuzzing mutants documents studies trust fifty}"; do
    for name in $stage; do
      SECONDS=0
      verdict=passed
      $name > "$out/$name.log" 2>&1 || { verdict="failed, see $out/$name.log"; failed=1; }
      echo "  $name: $verdict ($SECONDS s)"
    done
  done
} > $out/running.txt
mv $out/running.txt $out/last.txt
cat $out/last.txt
exit $failed
