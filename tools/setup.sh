# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Functions for tools/quickstart, tools/test and other scripts that install missing packages and configure presets.

say() { printf '\n== %s\n' "$*"; }

# quietly COMMAND...: runs a command and shows its output only if it fails.
quietly() {
  local log status=0
  log=$(mktemp)
  "$@" >"$log" 2>&1 || status=$?
  [ "$status" -eq 0 ] || cat "$log" >&2
  rm -f "$log"
  return "$status"
}

# find_missing_packages LIST...: sets the array `missing` to the packages in the lists that are not installed.
find_missing_packages() {
  local package
  missing=()
  while read -r package _; do
    case $package in "#" | "") continue ;; esac
    dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed ||
      missing+=("$package")
  done < <(cat "$@")
}

# install_missing [PREFIX...]: installs `missing`. PREFIX are words before apt-get, such as sudo.
install_missing() {
  local apt=("$@" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=120)
  quietly "${apt[@]}" update &&
    quietly "${apt[@]}" install -y --no-install-recommends "${missing[@]}" &&
    switch_off_daemons "$@"
}

# switch_off_daemons [PREFIX...]: disables the daemons of munge and Slurm if they are in `missing`. Debian starts them
# after the installation and at every boot, but the tests start their own. Daemons installed before are not changed.
switch_off_daemons() {
  local package
  [ -d /run/systemd/system ] || return 0
  for package in "${missing[@]}"; do
    case $package in
      munge | slurmctld | slurmd) quietly "$@" systemctl disable --now "$package" || true ;;
    esac
  done
}

# Prints the commands that install `missing`, for a user who may not run them or needs a password to do so.
say_what_to_install() {
  local as_root=""
  if command -v sudo >/dev/null; then
    as_root="sudo "
    echo "These packages are missing. To install them, run:"
  else
    echo "These packages are missing, and this user may not install them. As root, run:"
  fi
  echo "  ${as_root}apt-get update"
  echo "  ${as_root}apt-get install -y --no-install-recommends ${missing[*]}"
}

# ensure_packages LIST...: installs missing packages if this user may, and exits with 1 if that fails. Otherwise prints
# the commands that install them and exits with 2.
ensure_packages() {
  local missing
  find_missing_packages "$@"
  [ "${#missing[@]}" -gt 0 ] || return 0
  if [ "$(id -u)" -eq 0 ]; then
    say "Installing Debian packages: ${missing[*]}"
    install_missing || exit 1
  elif sudo -n true 2>/dev/null; then
    say "Installing Debian packages: ${missing[*]}"
    install_missing sudo -n || exit 1
  else
    say_what_to_install >&2
    exit 2
  fi
}

# configure PRESET [CMake option]...: configures a preset quietly.
configure() {
  quietly cmake --preset "$@"
}
