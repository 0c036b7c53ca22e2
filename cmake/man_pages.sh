#!/usr/bin/env bash
# man_pages.sh HELP2MAN PROGRAM FOLDER: a page of the program, and one of each of its commands, from what --help says.
set -euo pipefail
help2man=$1 program=$2 folder=$3
mkdir -p "$folder"
version=$("$program" --version)
commands=$("$program" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\+\) .*/\1/p')
page() {  # NAME, DESCRIPTION, COMMAND...
  local name=$1 description=$2
  shift 2
  "$help2man" --no-info --no-discard-stderr --version-string="$version" --name="$description" \
    --source="$version" --manual="vlbeam" "$*" |
    sed "s|$program|vlbeam|g; s|^\.TH [^ ]*|.TH ${name^^}|; s|^vlbeam \\\\-|$name \\\\-|" > "$folder/$name.1.new"
  mv "$folder/$name.1.new" "$folder/$name.1"
}
for command in $commands; do
  page "vlbeam-$command" "$("$program" "$command" --help | head -1)" "$program $command"
done
page vlbeam "beams along which something slides, and how far their numbers can be trusted" "$program"
