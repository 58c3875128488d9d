# shellcheck shell=bash
# Sourced by the scripts that work in a Debian of their own: a folder made by mmdebstrap and entered with chroot.

# make_root RELEASE: makes the folder $root, or takes it as it is; without a name it is a temporary one, which goes
# when the script ends unless $keep says otherwise. Needs root.
make_root() {
  ((EUID == 0)) || die "this needs root"
  need mmdebstrap
  if [[ ! $root ]]; then
    root=$(mktemp -d --tmpdir "shelfbeam-$1.XXXXXX")
    chmod 755 "$root" # as / has to be for apt's own user
    [[ $keep ]] || trap 'rm -rf --one-file-system "$root"' EXIT
  fi
  say "Debian $1 in $root"
  [[ -x $root/usr/bin/apt-get ]] || mmdebstrap --variant=apt "$1" "$root"
  # Where this machine's network has certificates of its own, npm needs them inside, too.
  : >"$root/etc/extra-certificates.pem"
  [[ ! -r ${NODE_EXTRA_CA_CERTS-} ]] || cp "$NODE_EXTRA_CA_CERTS" "$root/etc/extra-certificates.pem"
}

# inside COMMAND...: runs it in the root, in /shop/shelfbeam.
# The mounts and the processes live in namespaces of their own: both are gone when the command ends, however it ends.
inside() {
  # shellcheck disable=SC2016
  unshare --mount --pid --fork --kill-child bash -euc '
    mount -t proc proc "$0/proc"
    mount --rbind /dev "$0/dev"
    exec chroot "$0" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/shop LC_ALL=C.UTF-8 CI=true \
      NODE_EXTRA_CA_CERTS=/etc/extra-certificates.pem \
      sh -c '\''cd /shop/shelfbeam && exec "$@"'\'' sh "$@"' "$root" "$@"
}
