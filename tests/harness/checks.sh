# Sourced by tests of the program, whose first argument it is: they run in a folder of their own, and count what fails.
set -u
vlbeam=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
failures=0

failed() { echo "FAILED: $1"; failures=$((failures + 1)); }
check() { [[ $2 == "$3" ]] || failed "$1: expected '$2', got '$3'"; }  # check WHAT EXPECTED ACTUAL
exit_of() { "$@" > out.txt 2> err.txt; echo $?; }
says() { grep -c -- "$1" err.txt; }
there() { [[ -e $1 ]] && echo yes || echo no; }
verdict() {
  [[ $failures -eq 0 ]] && echo "all checks passed"
  exit "$((failures > 0))"
}
