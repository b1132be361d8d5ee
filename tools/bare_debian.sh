# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Functions for tools/package-test and tools/fresh-machine that make a minimal Debian 12 in a folder and run commands in
# it. Need root and debootstrap. Packages come from the apt sources of this machine.

fail() { echo "tools/${0##*/}: error: $*" >&2; exit 2; }

needs_debootstrap() {
  [ "$(id -u)" -eq 0 ] || fail "needs root, because it makes a root file system"
  command -v debootstrap >/dev/null || fail "debootstrap was not found; expected the Debian package debootstrap"
}

# make_bare_debian ROOT: makes a minimal Debian 12 with a user `someone` in an empty folder.
make_bare_debian() {
  local root=$1 sources mirror
  # All apt sources for Debian 12, as lines "SITE RELEASE COMPONENT".
  # shellcheck disable=SC2016
  sources=$(apt-get indextargets --format '$(SITE) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
    grep -E '^[^ ]+ bookworm(-updates|-security)? ' | sort -u) ||
    fail "apt has no source of Debian 12 (bookworm); expected one in /etc/apt"
  mirror=$(awk '$2 == "bookworm" { print $1; exit }' <<<"$sources")
  quietly debootstrap --variant=minbase bookworm "$root" "$mirror"
  chmod 755 "$root"
  # shellcheck disable=SC2001
  sed 's/^/deb /' <<<"$sources" >"$root/etc/apt/sources.list"
  apt-config dump | grep -E '^Acquire::(https?::|Check-)' >"$root/etc/apt/apt.conf.d/90host" || true
  echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/unsafe-io"  # losing the folder in a power failure is acceptable
  cp -L /etc/resolv.conf "$root/etc/resolv.conf"
  # The same lines as Debian's installer writes.
  printf '127.0.0.1\tlocalhost\n127.0.1.1\t%s\n' "$(uname -n)" >"$root/etc/hosts"
  inside "$root" root useradd --create-home --shell /bin/bash someone
}

# inside ROOT USER COMMAND...: runs a command as a user in the Debian in ROOT. The command shares the kernel and the
# network with this machine, but no files. When it ends, its mounts and all its processes end.
inside() {
  local root=$1 user=$2 home
  shift 2
  home=$(awk -F : -v user="$user" '$1 == user { print $6 }' "$root/etc/passwd")
  # shellcheck disable=SC2016
  unshare --mount --pid --fork --kill-child sh -c '
    set -e
    mount --bind "$1" "$1"
    cd "$1"
    mount -t proc proc proc
    mount -t sysfs -o ro sysfs sys
    mount -t tmpfs -o mode=1777 tmpfs dev/shm
    mount -t devpts -o newinstance,ptmxmode=0666,mode=620,gid=5 devpts dev/pts
    pivot_root . mnt
    cd /
    umount -l /mnt
    shift
    exec "$@"' sh "$root" \
    env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME="$home" USER="$user" LOGNAME="$user" \
    setpriv --reuid "$user" --regid "$user" --init-groups "$@"
}
