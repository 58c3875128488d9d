# shellcheck shell=bash
# Sourced by scripts that format or check sources: which files, and with which programs.

# clang_format check|format FILE...: by one version for Debian 12 and 13, because versions format differently.
clang_format() {
  local program=clang-format-19 found
  need "$program"
  if [[ $1 == format ]]; then
    printf '%s\0' "${@:2}" | xargs -0 -n 50 -P "$(nproc)" "$program" -i
  else
    found=$(printf '%s\0' "${@:2}" | xargs -0 -n 50 -P "$(nproc)" "$program" --dry-run --ferror-limit=1 2>&1)
    sed -n 's/^\([^ :]*\):[0-9].*clang-format.*/\1: not formatted/p' <<<"$found" | sort -u
    [[ ! $found || $found == *clang-format-violations* ]] || echo "$found"
    [[ ! $found ]]
  fi
}

# find_sources [FILE...]: sorts the given files, or all files of the checkout, into the arrays cpp and others (Python,
# TypeScript, JavaScript, CSS and JSON).
find_sources() {
  local file first
  (($#)) || { need git && git rev-parse --git-dir >/dev/null; } || die "this is not a git checkout: name the files"
  cpp=() others=()
  for file; do [[ -e $file ]] || die "$file does not exist in $PWD"; done
  while IFS= read -r -d '' file; do
    file=${file#"$PWD/"}
    [[ -f $file && ! -L $file ]] || continue
    case $file in
      test/data/* | */package-lock.json) ;;
      src/*.[ch]pp | test/*.[ch]pp | bench/*.[ch]pp | fuzz/*.[ch]pp | scripts/*.[ch]pp) cpp+=("$file") ;;
      src/page/*.json | scripts/style/*.json | *.py | *.ts | *.mjs | *.css) others+=("$file") ;;
      *.*) ;;
      scripts/* | test/*)
        IFS= read -r first <"$file" || true
        if [[ $first == '#!'*python* ]]; then others+=("$file"); fi
        ;;
    esac
  done < <(if (($#)); then printf '%s\0' "$@"; else git ls-files -z --cached --others --exclude-standard; fi)
}

# style MODE FILE...: runs style.mjs. npm installs its packages in build/style if they are not there.
style() {
  local home=build/style
  need npm 'nodejs npm'
  if ! cmp --silent scripts/style/package-lock.json "$home/installed.json"; then
    mkdir -p "$home"
    cp scripts/style/package{,-lock}.json "$home"
    npm ci --prefix "$home" --ignore-scripts --no-audit --no-fund --loglevel=error --fetch-retries=1 >/dev/null ||
      die "npm could not install the packages of scripts/style, which check Python and TypeScript: check the network" \
        "and npm's proxy settings, and repeat"
    cp "$home/package-lock.json" "$home/installed.json"
  fi
  PACKAGES=$PWD/$home/node_modules node scripts/style/style.mjs "$@"
}
