#!/usr/bin/env bash
# Kernels for an instruction set that not every machine has share no function with other units: the linker could take
# theirs for all. Functions of packs are theirs alone (core/pack.hpp).
#   kernels_test.sh OBJECT...
set -euo pipefail
shared=$(nm --demangle "$@" | grep -E ' [WVu] ' | grep -vE 'in_one_register|vlbeam::avx2::' || true)
if [[ -n $shared ]]; then
  echo "functions that the linker may give to machines without the instruction set:"
  echo "$shared"
  exit 1
fi
