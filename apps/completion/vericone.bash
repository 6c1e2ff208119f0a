# SPDX-License-Identifier: BSD-3-Clause
# Completion for bash: commands, options of a command, kinds of `schema`, otherwise files. What there is, the helps say.
_vericone() {
  local word=${COMP_WORDS[COMP_CWORD]} help
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    help=$("${COMP_WORDS[0]}" --help 2>/dev/null | sed -n 's/^  \([a-z][a-z-]*\) .*/\1/p')
  elif [[ $word == -* ]]; then
    help=$("${COMP_WORDS[0]}" "${COMP_WORDS[1]}" --help 2>/dev/null | grep -o -e '^  *\(-[a-zA-Z],\)\?--[a-z-]*' | grep -o -e '--[a-z-]*')
  elif [ "$COMP_CWORD" -eq 2 ] && [ "${COMP_WORDS[1]}" = schema ]; then
    help=$("${COMP_WORDS[0]}" schema --help 2>/dev/null | sed -n 's/.*One of \(.*\)/\1/p' | tr -d ,)
  fi
  if [ -n "$help" ]; then
    mapfile -t COMPREPLY < <(compgen -W "$help" -- "$word")
  fi
}
complete -o default -F _vericone vericone
