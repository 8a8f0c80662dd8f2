#!/usr/bin/env bash
# Installs the packages of packages.txt that are missing, then configures and builds. Sourced by ./run and ./test.
#   setup PRESET TARGET...
setup() {
  local preset=$1 root missing
  shift
  root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
  missing=$(grep -v '^#' "$root/third_party/packages.txt" | while read -r package; do
    [ -e "/var/lib/dpkg/info/$package.list" ] || compgen -G "/var/lib/dpkg/info/$package:*.list" >/dev/null || echo "$package"
  done)
  if [ -n "$missing" ]; then
    echo "installing: $(echo "$missing" | tr '\n' ' ')" >&2
    local sudo=""
    [ "$(id -u)" = 0 ] || sudo=sudo
    $sudo apt-get update -qq && echo "$missing" | xargs $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends >&2 ||
      { echo "etendue: packages could not be installed; third_party/packages.txt lists them" >&2; return 1; }
  fi
  [ -f "$root/build/$preset/build.ninja" ] || cmake -S "$root" --preset "$preset" >"$root/build-$preset.log" 2>&1 ||
    { cat "$root/build-$preset.log" >&2; return 1; }
  rm -f "$root/build-$preset.log"
  cmake --build "$root/build/$preset" --target "$@" >"$root/build/$preset/build.log" 2>&1 ||
    { tail -n 60 "$root/build/$preset/build.log" >&2; return 1; }
}
