#!/bin/sh
# Usage: manual_pages.sh HELP2MAN PROGRAM FOLDER
#
# Writes the manual pages of shelfbeam and of each verb to FOLDER/man1, from their --help.
set -eu

help2man=$1 program=$2 folder=$3
PATH=$(dirname "$program"):$PATH
version=$(shelfbeam --version)

rm -rf "$folder"
mkdir -p "$folder/man1"
cat >"$folder/see_also" <<END
[see also]
.BR shelfbeam (1)
lists the verbs. Each verb has its own page, such as
.BR shelfbeam-plan (1).
END

# help2man requires a prompt before commands, and two spaces before the description of an option (in column 30).
as_wanted='s/^  shelfbeam /  $ shelfbeam /; s/^(  -.{26} )([^ ])/\1 \2/'

# page TITLE SUMMARY COMMAND
page() {
  "$help2man" --no-info --output "$folder/man1/$1.1" --name "$2" --version-string "$1 $version" \
    --source "shelfbeam $version" --include "$folder/see_also" --help-option "--help | sed -E '$as_wanted'" "$3"
}

shelfbeam --help >"$folder/help"
page shelfbeam "$(head -n 1 "$folder/help")" shelfbeam
sed -nE '/^Verbs:/,/^$/s/^  ([a-z]+) +/\1 /p' "$folder/help" |
  while read -r verb summary; do page "shelfbeam-$verb" "$summary" "shelfbeam $verb"; done
