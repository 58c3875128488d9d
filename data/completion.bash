#compdef shelfbeam
# Completes verbs, options and choices from --help, in bash and, through bashcompinit, in zsh.

_shelfbeam() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} verb='' wanted
  ((COMP_CWORD == 1)) || verb=${COMP_WORDS[1]}
  if [[ $word == -* ]]; then
    wanted='s/^  (-.,)?(--[a-z-]+).*/\2/p'
  elif [[ ! $verb ]]; then
    wanted='/^Verbs:/,/^$/s/^  ([a-z]+) .*/\1/p'
  elif [[ $before == -* ]]; then
    wanted="s/^  (-.,)?${before//[^a-z-]/} \{([^}]*)\}.*/\2/p"
  elif ((COMP_CWORD == 2)); then
    wanted='/^Arguments:/,/^$/s/^  [A-Z]+ \{([^}]*)\}.*/\1/p'
  else
    return 0
  fi
  wanted=$("${COMP_WORDS[0]}" ${verb:+"$verb"} --help 2>/dev/null | sed -nE "$wanted")
  # shellcheck disable=SC2207
  COMPREPLY=($(compgen -W "${wanted//,/ }" -- "$word"))
}

if [[ ${ZSH_VERSION-} ]]; then
  autoload -Uz bashcompinit && bashcompinit
fi
complete -o default -F _shelfbeam shelfbeam
# zsh loads this file at the first completion.
[[ ${funcstack[1]-} != _shelfbeam ]] || _bash_complete -o default -F _shelfbeam
