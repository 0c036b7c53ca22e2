#!/usr/bin/env bash
# Installs the build, and uses what is there as a stranger would: find_package, pkg-config, the program, its data.
#   install_test.sh CMAKE BUILD SOURCES CXX
set -euo pipefail
cmake=$1 build=$2 sources=$3 cxx=$4
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
root=$scratch/root
says() { echo "FAILED: $1" >&2; exit 1; }

"$cmake" --install "$build" --prefix "$root" > "$scratch/install.log" || { cat "$scratch/install.log"; exit 1; }

# Nothing that is installed names a folder of the sources or the build, but where data are looked for at last.
if grep -rIl -e "$build" -e "$sources" "$root/include" "$root"/lib*; then says "a path of the build is installed"; fi
[[ ! -e $root/include/core && ! -e $root/include/vlbeam/studies ]] || says "headers stand outside vlbeam/"

# The program finds its data beside it.
mv "$root" "$scratch/elsewhere" && root=$scratch/elsewhere
"$root/bin/vlbeam" scene pendulum > "$scratch/scene.json"
cmp "$scratch/scene.json" "$sources/scenes/pendulum.json"
"$root/bin/vlbeam" gate --help > /dev/null

# The documents' links lead somewhere there, too.
for document in $(find "$root/share/doc" -name '*.md'); do
  while read -r link; do
    [[ -e $(dirname "$document")/$link ]] || says "$document: its link to $link"
  done < <(sed -e '/^ *```/,/^ *```/d' -e 's/`[^`]*`//g' "$document" | grep -oP '\]\(\K[^)#\s]+' | grep -v '://' || true)
done

# Man pages of all commands, where help2man was there to write them, and completion that knows them.
commands=$("$root/bin/vlbeam" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\+\) .*/\1/p')
[[ $(wc -w <<< "$commands") -ge 12 ]] || says "the commands in --help"
if command -v help2man > /dev/null; then
  for command in $commands; do
    grep -q "^vlbeam-$command " "$root/share/man/man1/vlbeam-$command.1" || says "the man page of $command"
  done
  grep -q 'Exit codes' "$root/share/man/man1/vlbeam.1" || says "the man page"
fi
completed() {
  PATH=$root/bin:$PATH bash -c 'source "$1"; shift
    COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _vlbeam; echo "${COMPREPLY[*]}"' - \
    "$root/share/bash-completion/completions/vlbeam" "$@"
}
[[ $(completed vlbeam conv) == converge ]] || says "completion of a command"
[[ $(completed vlbeam converge --qua) == --quantity ]] || says "completion of an option"
[[ $(completed vlbeam scene pend) == pendulum ]] || says "completion of a scene"

# A project of its own.
cp -r "$root/share/vlbeam/examples" "$scratch/examples"
"$cmake" -S "$scratch/examples" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$root" -DCMAKE_CXX_COMPILER="$cxx" \
  -DCMAKE_CXX_FLAGS_RELEASE=-O1 > "$scratch/configure.log" || { cat "$scratch/configure.log"; exit 1; }
"$cmake" --build "$scratch/build" > "$scratch/build.log" 2>&1 || { cat "$scratch/build.log"; exit 1; }
cd "$scratch"
build/run_scene scene.json r.json | grep 'status          completed' > /dev/null || says "run_scene"
"$root/bin/vlbeam" run scene.json --report theirs.json -q --no-check
"$root/bin/vlbeam" compare r.json theirs.json --tol 0 > /dev/null || says "the library gives other numbers than the program"
sed -i 's/"radius"/"radios"/' scene.json
code=0
build/run_scene scene.json 2> err.txt || code=$?
[[ $code -eq 2 ]] && grep -q '/beam/section/radios' err.txt || says "an error of a scene: $(cat err.txt)"
build/own_study > own_study.txt 2>&1 || { cat own_study.txt; says "own_study"; }
[[ -s own_study_report/own_study.json && -s own_study_report/own_study_meshes.csv ]] || says "the report of own_study"
build/element_alone > alone.txt || { cat alone.txt; says "element_alone"; }
build/own_element_law > law.txt || { cat law.txt; says "own_element_law"; }
"$root/bin/vlbeam" scene falling_beam > falling.json
[[ $(build/own_merge_rule falling.json | grep -c ' J$') -eq 3 ]] || says "own_merge_rule"

# Another version is refused.
mkdir other && cat > other/CMakeLists.txt <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(other LANGUAGES CXX)
find_package(vlbeam 99 REQUIRED)
CMAKE
if "$cmake" -S other -B other/build -DCMAKE_PREFIX_PATH="$root" > /dev/null 2>&1; then says "version 99 was found"; fi

# The element library alone needs neither scenes nor JSON nor threads of its own.
"$cmake" -S examples -B alone -DELEMENTS_ALONE=ON -DCMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON \
  -DCMAKE_DISABLE_FIND_PACKAGE_Threads=ON -DCMAKE_PREFIX_PATH="$root" -DCMAKE_CXX_COMPILER="$cxx" \
  -DCMAKE_CXX_FLAGS_RELEASE=-O1 > alone.log 2>&1 && "$cmake" --build alone >> alone.log 2>&1 &&
  alone/element_alone >> alone.log || { cat alone.log; says "the component core"; }

# As a part of another project: the library is optimized although that one has chosen nothing, and there are no tests,
# benchmarks or programs.
mkdir part && cat > part/CMakeLists.txt <<CMAKE
cmake_minimum_required(VERSION 3.25)
project(part LANGUAGES CXX)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
add_subdirectory($sources vlbeam)
add_executable(mine $sources/examples/run_scene.cpp)
target_link_libraries(mine PRIVATE vlbeam::library)
CMAKE
"$cmake" -S part -B part/build -DCMAKE_CXX_COMPILER="$cxx" > part.log 2>&1 || { cat part.log; exit 1; }
commands=part/build/compile_commands.json
grep '"command"' $commands | grep mechanics/motion/system/beam_system.cpp | grep -e ' -O2 ' > /dev/null || says "a part is not optimized"
grep '"command"' $commands | grep run_scene.cpp | grep -e ' -O3 ' > /dev/null && says "the build type of the whole was changed"
grep '"file"' $commands | grep -e /tests/ -e /bench/ -e /studies/app/ > /dev/null && says "a part brings its tests along"

# pkg-config
if command -v pkg-config > /dev/null; then
  PKG_CONFIG_PATH=$(dirname "$(find "$root" -name vlbeam.pc)")
  export PKG_CONFIG_PATH
  [[ $(pkg-config --modversion vlbeam) == "$("$root/bin/vlbeam" --version | sed 's/vlbeam //')" ]] ||
    says "the version of pkg-config"
  # shellcheck disable=SC2046
  "$cxx" -O0 examples/run_scene.cpp $(pkg-config --cflags --libs vlbeam) -o by_pkg_config
  "$root/bin/vlbeam" scene pendulum > scene.json && ./by_pkg_config scene.json > /dev/null
else
  echo "pkg-config is not installed: its file was not tried"
fi
echo "installed and used"
