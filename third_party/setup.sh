#!/usr/bin/env bash
# Installs packages that are missing, then configures and builds. Sourced by ./run and ./test.
third_party=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

#   install_packages LIST: the packages of third_party/LIST.
install_packages() {
  local missing sudo=""
  missing=$(grep -v '^#' "$third_party/$1" | while read -r package; do
    [ -e "/var/lib/dpkg/info/$package.list" ] || compgen -G "/var/lib/dpkg/info/$package:*.list" >/dev/null || echo "$package"
  done)
  [ -n "$missing" ] || return 0
  echo "installing: $(echo "$missing" | tr '\n' ' ')" >&2
  [ "$(id -u)" = 0 ] || sudo=sudo
  $sudo apt-get update -qq && echo "$missing" | xargs $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends >&2 ||
    { echo "etendue: packages could not be installed; third_party/$1 lists them" >&2; return 1; }
}

#   setup PRESET TARGET...
setup() {
  local preset=$1 root
  shift
  root=$(dirname "$third_party")
  install_packages packages.txt || return 1
  [ -f "$root/build/$preset/build.ninja" ] || cmake -S "$root" --preset "$preset" >"$root/build-$preset.log" 2>&1 ||
    { cat "$root/build-$preset.log" >&2; return 1; }
  rm -f "$root/build-$preset.log"
  cmake --build "$root/build/$preset" --target "$@" >"$root/build/$preset/build.log" 2>&1 ||
    { tail -n 60 "$root/build/$preset/build.log" >&2; return 1; }
}
