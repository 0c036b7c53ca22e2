#!/usr/bin/env bash
# Installs the Debian packages that are missing, when run as root or with passwordless sudo;
# otherwise prints the one line to type and stops.
#   scripts/packages.sh build    what `make` needs
#   scripts/packages.sh python   that, and what `make python` needs
#   scripts/packages.sh package  that, and what `make package` needs
#   scripts/packages.sh api      that, and what `make api` needs
#   scripts/packages.sh theory   that, and what `make theory` and `make book` need
#   scripts/packages.sh ci       that, and what .ci/run needs
set -euo pipefail

packages=(g++ cmake make git libeigen3-dev libboost-dev nlohmann-json3-dev libcli11-dev libtbb-dev libgtest-dev libgmock-dev
          libbenchmark-dev gnuplot-nox python3 python3-markdown python3-jinja2 blahtexml)
if [[ ${1:-build} == python || ${1:-build} == ci ]]; then
  packages+=(pybind11-dev python3-dev python3-numpy python3-setuptools python3-wheel python3-pip python3-venv)
fi
if [[ ${1:-build} == package ]]; then
  packages+=(dpkg-dev file help2man)
fi
if [[ ${1:-build} == api || ${1:-build} == ci ]]; then
  packages+=(doxygen)
fi
if [[ ${1:-build} == theory ]]; then
  packages+=(chromium fonts-stix fonts-dejavu-core)
fi
if [[ ${1:-build} == ci ]]; then
  packages+=(ccache dpkg-dev file procps pkg-config help2man python3-pytest python3-matplotlib python3-pandas mypy chromium)
  packages+=(clang-14 libclang-rt-14-dev clang-format-14 clang-tidy-14 python3-jsonschema python3-meshio)
fi

command -v dpkg-query > /dev/null || exit 0  # not Debian: CMake will name what it misses

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat '${db:Status-Status}' "$package" 2> /dev/null || true)
  [[ $status == *installed* && $status != *not-installed* ]] || missing+=("$package")
done
[[ ${#missing[@]} -eq 0 ]] && exit 0

install=(apt-get install --yes --no-install-recommends "${missing[@]}")
if [[ $(id -u) -eq 0 ]]; then
  as_root=()
elif command -v sudo > /dev/null && sudo --non-interactive true 2> /dev/null; then
  as_root=(sudo)
else
  echo "Missing packages. Type this, then repeat your command:" >&2
  echo "  sudo apt-get update && sudo ${install[*]}" >&2
  exit 1
fi
echo "Installing: ${missing[*]}" >&2
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update --quiet >&2
"${as_root[@]}" "${install[@]}" >&2
