# shellcheck shell=bash
# The scripts in this folder and below it source this file first. It sets strict mode, makes the top of the checkout the
# working directory, and defines messages.

set -euo pipefail
invoked=$(realpath "$0")
cd "$(dirname "${BASH_SOURCE[0]}")/.."

say() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; }

die() {
  say "$@"
  exit 1
}

# Prints the comment at the head of a script as its help.
usage() { sed -n '2,/^[^#]/{s/^# \{0,1\}//p}' "$invoked"; }

bad_usage() {
  usage >&2
  exit 2
}

# need COMMAND [PACKAGE]
need() { command -v "$1" >/dev/null || die "$1 is missing: apt-get install ${2-$1}"; }
