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

# Turns ninja's status lines into progress on standard error: one line that is rewritten on a terminal, else a line per
# tenth of the work. Needs NINJA_STATUS='@ %f %t ' in front of each line.
show_progress() {
  local terminal=no
  [ -t 2 ] && terminal=yes
  awk -v terminal=$terminal '
    BEGIN { srand(); start = srand() }
    $1 == "@" && $3 > 2 {
      percent = int(100 * $2 / $3)
      srand(); elapsed = srand() - start
      text = sprintf("building: %3d %%  %d of %d  %d s", percent, $2, $3, elapsed)
      if (terminal == "yes") printf "\r%s ", text
      else if (int(percent / 10) > tenth) { tenth = int(percent / 10); print text }
      fflush(); shown = 1
    }
    END { if (shown && terminal == "yes") print "" }' >&2
}

# Whether the build in this folder was configured while OpenImageIO, Open MPI or OpenVDB was missing, and it is installed
# now.
lacks_plugin() {
  pkg-config --exists OpenImageIO && ! grep -q etendue_openimageio "$1/build.ninja" && return
  pkg-config --exists ompi-c && ! grep -q etendue_mpi "$1/build.ninja" && return
  [ -e /usr/include/openvdb/openvdb.h ] && [ -e /usr/include/boost/version.hpp ] && ! grep -q etendue_openvdb "$1/build.ninja"
}

#   setup PRESET TARGET...
setup() {
  local preset=$1 root log
  shift
  root=$(dirname "$third_party")
  log=$root/build/$preset/build.log
  install_packages packages.txt || return 1
  if [ ! -f "$root/build/$preset/build.ninja" ] || lacks_plugin "$root/build/$preset"; then
    echo "configuring the preset '$preset'; the first build takes a few minutes" >&2
    mkdir -p "$root/build/$preset"
    cmake -S "$root" --preset "$preset" >"$log" 2>&1 || { cat "$log" >&2; return 1; }
  fi
  NINJA_STATUS='@ %f %t ' cmake --build "$root/build/$preset" --target "$@" 2>&1 | tee "$log" | show_progress
  [ "${PIPESTATUS[0]}" = 0 ] || { grep -v '^@' "$log" | tail -n 60 >&2; return 1; }
}
