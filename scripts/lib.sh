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

# find_changed BASE: puts the files, committed or not, that this branch has changed since it left BASE into the array
# changed, and those that it has deleted into the array deleted.
find_changed() {
  local base
  git rev-parse --quiet --verify "$1^{commit}" >/dev/null || die "this checkout has no revision $1: fetch it, or name another"
  base=$(git merge-base "$1" HEAD) || die "$1 and this branch have no commit in common: fetch the history, or name another"
  # shellcheck disable=SC2034
  mapfile -t -d '' deleted < <(git diff -z --name-only --diff-filter=D "$base")
  # shellcheck disable=SC2034
  mapfile -t -d '' changed < <({
    git diff -z --name-only --diff-filter=d "$base"
    git ls-files -z --others --exclude-standard
  } | sort -zu)
}

# stage NAME COMMAND...: runs the command and prints its time; an error ends the script.
stage() {
  local begun=$EPOCHREALTIME
  say "$1"
  "${@:2}" || die "$1: failed"
  say "$(awk -v from="$begun" -v to="$EPOCHREALTIME" -v name="$1" 'BEGIN { printf "%s: %.1f s", name, to - from }')"
}

# debian_mirror: prints the address from which this system gets the packages of its own release; prints nothing before
# the first "apt-get update".
debian_mirror() {
  # shellcheck disable=SC1091,SC2016
  apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Component: main' 'Origin: Debian' \
    "Codename: $(. /etc/os-release && echo "${VERSION_CODENAME-}")" | head -n 1
}

# required_mirror: the same, but fails with a message if there is none.
required_mirror() {
  local mirror
  mirror=$(debian_mirror)
  [[ $mirror ]] || die "apt knows no source of Debian packages: name one in /etc/apt/sources.list," \
    "run 'apt-get update' as root, and repeat this command"
  echo "$mirror"
}

# system_release: this system and its version, e.g. "debian 12".
# shellcheck disable=SC1091
system_release() (. /etc/os-release && echo "$ID ${VERSION_ID-}")
