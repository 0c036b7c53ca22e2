# Completion of vlbeam for bash. What there is to complete, the program itself says.
_vlbeam() {
  local current=${COMP_WORDS[COMP_CWORD]} program=${COMP_WORDS[0]} command=${COMP_WORDS[1]:-} words=""
  if [[ $COMP_CWORD -eq 1 ]]; then
    words="--help --version $("$program" --help 2> /dev/null | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\+\) .*/\1/p')"
  elif [[ $current == -* ]]; then
    words=$("$program" "$command" --help 2> /dev/null | sed '/^Examples:/,$d' | grep -o -e '--[a-z][a-z-]*')
  else
    case $command in
      study) words=$("$program" list --names 2> /dev/null) ;;
      scene) words=$("$program" list 2> /dev/null | sed -n '/^Scenes/,$s/^  \([a-z_]\+\) .*/\1/p') ;;
      schema) words="scene run study gates sweep converge" ;;
    esac
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}
complete -o default -F _vlbeam vlbeam
