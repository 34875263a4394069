#!/usr/bin/env bash
# Completion in the shells that are installed: the script is sound, and asked for a beginning it gives what it should.
#   check_completion.sh DAMSLIP
set -euo pipefail
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
fail() { echo "FAIL: $*" >&2; exit 1; }
for shell in bash zsh fish; do "$1" completion $shell >"$work/$shell"; done

# Line, a blank, what its last word must become.
asked=("damslip scr screen" "damslip fe --redu --reduced" "damslip record inf info" "damslip record generate --pga --pga-m-s2"
       "damslip fe --base ti tied")

bash -n "$work/bash"
for line in "${asked[@]}"; do
    read -r -a words <<<"$line"
    wanted=${words[-1]}
    unset 'words[-1]'
    answer=$(bash -c 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _damslip; echo "${COMPREPLY[*]}"' bash "$work/bash" "${words[@]}")
    [ "$answer" = "$wanted" ] || fail "bash: ${words[*]} gives '$answer', not $wanted"
done

if command -v fish >/dev/null; then
    fish --no-execute "$work/fish"
    for line in "${asked[@]}"; do
        answer=$(HOME=$work fish --no-config -c "source $work/fish; complete -C '${line% *}'" | cut -f 1)
        [ "$answer" = "${line##* }" ] || fail "fish: ${line% *} gives '$answer', not ${line##* }"
    done
fi

if command -v zsh >/dev/null; then
    zsh -n "$work/zsh"
    # An interactive zsh in a pseudo terminal; after the tab the line is accepted and printed instead of run.
    cat >"$work/ask.zsh" <<'ZSH'
zmodload zsh/zpty
zpty -b shell zsh -f -i
zpty -w shell "PS1=; unsetopt beep; autoload -U compinit; compinit -u -D; source $1; damslip() { print -r -- \"<\"damslip \"\$*>\" }"
zpty -w shell "print re''ady"
out=
until [[ $out == *ready* ]]; do zpty -r -t shell chunk && out+=$chunk || sleep 0.05; done
zpty -w shell "$2"$'\t'
until [[ $out == *'<damslip'*'>'* ]]; do zpty -r -t shell chunk && out+=$chunk || sleep 0.05; done
print -r -- "${${out##*<}%%>*}"
ZSH
    for line in "${asked[@]}"; do
        answer=$(timeout 20 zsh -f "$work/ask.zsh" "$work/zsh" "${line% *}") || fail "zsh: no answer to ${line% *}"
        [[ "$answer" =~ \ ${line##* }\ *$ ]] || fail "zsh: ${line% *} gives '$answer', not ${line##* }"
    done
fi
