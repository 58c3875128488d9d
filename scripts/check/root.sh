# shellcheck shell=bash
# Sourced by scripts that work in a separate Debian: a folder set up by mmdebstrap and entered with chroot.

# make_root RELEASE: sets up Debian in the folder $root, or reuses it. If $root is empty, creates a temporary folder,
# which is removed when the script ends unless $keep is set. Requires root.
make_root() {
  ((EUID == 0)) || die "this needs root"
  need mmdebstrap
  if [[ ! $root ]]; then
    root=$(mktemp -d --tmpdir "shelfbeam-$1.XXXXXX")
    chmod 755 "$root" # apt's own user must be able to enter it
    [[ $keep ]] || trap 'rm -rf --one-file-system "$root"' EXIT
  fi
  say "Debian $1 in $root"
  if [[ ! -x $root/usr/bin/apt-get ]]; then
    local mirror
    mirror=$(required_mirror)
    mmdebstrap --variant=apt "$1" "$root" "$mirror"
  fi
  # npm needs the extra certificates of this machine's network inside, too.
  : >"$root/etc/extra-certificates.pem"
  [[ ! -r ${NODE_EXTRA_CA_CERTS-} ]] || cp "$NODE_EXTRA_CA_CERTS" "$root/etc/extra-certificates.pem"
}

# inside COMMAND...: runs the command in the root, in /shop/shelfbeam.
# Separate namespaces ensure that no mount or process remains when the command ends.
inside() {
  # shellcheck disable=SC2016
  unshare --mount --pid --fork --kill-child bash -euc '
    mount -t proc proc "$0/proc"
    mount --rbind /dev "$0/dev"
    exec chroot "$0" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/shop LC_ALL=C.UTF-8 CI=true \
      NODE_EXTRA_CA_CERTS=/etc/extra-certificates.pem \
      sh -c '\''cd /shop/shelfbeam && exec "$@"'\'' sh "$@"' "$root" "$@"
}
