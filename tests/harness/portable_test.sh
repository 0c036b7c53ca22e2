#!/usr/bin/env bash
# The program and the library ask no processor what it can do: they call no function of the C library whose digits depend
# on it (core/geometry/elementary.hpp has these), and hold no `cpuid` (Eigen would block products by the caches' sizes).
#   portable_test.sh PROGRAM
set -euo pipefail
names='sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|acosh|atanh|sincos|exp|exp2|exp10|expm1|log|log2|log10|log1p'
names+='|pow|cbrt|hypot|erf|erfc|tgamma|lgamma|fma'
# Of long double these end in instructions of the x87, whose last bits differ between makers of processors.
x87='acosl|atanl|atan2l|sinhl|coshl|tanhl|asinhl|acoshl|atanhl|expl|exp2l|exp10l|expm1l|logl|log2l|log10l|log1pl|powl'
complex='cabs|cexp|clog|csqrt|cpow|carg|csin|ccos|ctanh'
called=$(nm --dynamic --undefined-only "$1" | sed -E 's/^ +[Uw] +//; s/@.*//' | grep -xE "($names|$complex)f?" || true)
if [[ -n $called ]]; then
  echo "calls whose digits depend on the processor:" $called
  exit 1
fi
# Boost's automatic differentiation has a gamma function for factorials beyond 170, which no order of ours reaches.
x87_called=$(objdump --disassemble --no-show-raw-insn "$1" |
  awk -v names="<($x87)@plt>" '/^[0-9a-f]+ </ { caller = $2 } /(call|jmp) / && $0 ~ names && caller !~ /gamma_imp/ { print caller, $NF }')
if [[ -n $x87_called ]]; then
  echo "calls of the x87, whose digits depend on the processor's maker: $x87_called"
  exit 1
fi
asked=$(objdump --disassemble --no-show-raw-insn "$1" | grep -cw cpuid || true)
if [[ $asked -ne 0 ]]; then
  echo "the program asks the processor what it can do, at $asked places"
  exit 1
fi
