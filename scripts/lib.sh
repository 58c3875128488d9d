# shellcheck shell=bash
# Sourced first by the scripts beside it and below it: strict mode, the top of the checkout as the working directory, messages.

set -euo pipefail
invoked=$(realpath "$0")
cd "$(dirname "${BASH_SOURCE[0]}")/.."

say() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; }

die() {
  say "$@"
  exit 1
}

# The comment at the head of a script is its help.
usage() { sed -n '2,/^[^#]/{s/^# \{0,1\}//p}' "$invoked"; }

bad_usage() {
  usage >&2
  exit 2
}

# need COMMAND [PACKAGE]
need() { command -v "$1" >/dev/null || die "$1 is missing: apt-get install ${2-$1}"; }
