#!/usr/bin/env bash
# Runs studies twice: as they are, and as on a machine whose processor has no vectors beyond SSE2 and no fused multiply-add.
# The files must be equal byte for byte. Ends with 1 where one differs.
#   scripts/same_reports.sh [PROGRAM [STUDY ...]]     profile ci, by default of all studies; PROGRAM is build/vlbeam
set -euo pipefail
vlbeam=$(realpath "${1:-build/vlbeam}")
shift || true
studies=("$@")
[[ ${#studies[@]} -gt 0 ]] || mapfile -t studies < <("$vlbeam" list --names)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

masked=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F,-AVX2_Usable,-FMA_Usable,-FMA4_Usable
different=0
for study in "${studies[@]}"; do
  "$vlbeam" study "$study" --profile ci --out "$folder/as_is" > "$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
  GLIBC_TUNABLES=$masked "$vlbeam" study "$study" --profile ci --out "$folder/masked" > "$folder/log" 2>&1 ||
    { cat "$folder/log"; exit 1; }
  if changes=$(diff --recursive --brief --exclude '*.timing.*' "$folder/as_is" "$folder/masked"); then
    echo "$study: $(find "$folder/as_is" -type f ! -name '*.timing.*' | wc -l) files, equal"
  else
    echo "$study: $changes"
    different=1
  fi
  rm -rf "$folder/as_is" "$folder/masked"
done
exit $different
