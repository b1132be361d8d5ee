# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Sourced by tools/package-test and tools/fresh-machine: makes a minimal Debian 12 in a folder and runs
# commands in it. Needs root and debootstrap. Packages come from this machine's apt sources.

fail() { echo "tools/${0##*/}: error: $*" >&2; exit 2; }

needs_debootstrap() {
  [ "$(id -u)" -eq 0 ] || fail "needs root, because it makes a root file system"
  command -v debootstrap >/dev/null || fail "debootstrap was not found; expected the Debian package debootstrap"
}

# make_bare_debian ROOT: a minimal Debian 12 in an empty folder, with a user `someone`.
make_bare_debian() {
  local root=$1 sources mirror
  # SITE RELEASE COMPONENT of all apt sources of Debian 12.
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
  echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/unsafe-io"  # loss at a power failure is acceptable
  cp -L /etc/resolv.conf "$root/etc/resolv.conf"
  # As written by Debian's installer.
  printf '127.0.0.1\tlocalhost\n127.0.1.1\t%s\n' "$(uname -n)" >"$root/etc/hosts"
  inside "$root" root useradd --create-home --shell /bin/bash someone
}

# inside ROOT USER COMMAND...: runs a command as a user of that Debian. It shares the kernel and the network
# with this machine, but no files. Its mounts and processes end with it.
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
