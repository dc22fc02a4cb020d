# shellcheck shell=bash disable=SC2034
# Sourced by demo.sh, test.sh and scripts/lint.sh: from a fresh Debian 12 to a configured and built tree.
# Every step prints one line; the output of the tools goes to build/*.log and is shown when a step fails.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/release
logs=$root/build
mkdir -p "$logs"

# Debian 12 packages needed by the build. ViSP depends on OpenCV and Eigen; they are listed because we use them directly.
# Python, numpy, matplotlib, jinja2 and three.js make the reports; pybind11 the Python package.
packages=(g++ cmake ninja-build libvisp-dev libopencv-dev libeigen3-dev libdlib-dev catch2 libbenchmark-dev
  libcli11-dev nlohmann-json3-dev liburdfdom-dev libfcl-dev liboctomap-dev libassimp-dev
  libompl-dev libaravis-dev pybind11-dev python3-dev python3-numpy
  python3-matplotlib python3-jinja2 libjs-three)
case ${CXX:-} in *clang*) packages+=(clang libomp-dev) ;; esac # ViSP is built with OpenMP
# Real images for some tests, which are skipped if the images are missing. Documentation tools, as the documentation is also
# a test: doxygen, and bibtex for the bibliography. Open MPI, for the program that can run on several processes.
# KDL and MuJoCo, second opinions on arms. libabigail, for the test of the binary interface. pytest, and a browser that opens the reports.
test_packages=(visp-images-data opencv-doc doxygen doxygen-awesome-css texlive-binaries libopenmpi-dev openmpi-bin liborocos-kdl-dev libmujoco-dev abigail-tools
  python3-pytest chromium)

# run LOG SENTENCE COMMAND...
run() {
  local log=$logs/$1 start=$SECONDS status=0
  printf '%s ... ' "$2"
  shift 2
  "$@" >"$log" 2>&1 </dev/null || status=$?
  if [ "$status" -eq 0 ]; then
    echo "done, $((SECONDS - start)) s"
  else
    echo "failed"
    # The lines with the reason, wherever they are, then the end; compilers write long lines.
    {
      grep -m 10 -E '^(FAILED|E): |error: |undefined reference|CMake Error' "$log" && echo ...
      tail -n 15 "$log"
    } | cut -c 1-200 >&2
    echo "The command was: $*" >&2
    echo "Its whole output is in ${log#"$root"/}" >&2
    exit "$status"
  fi
}

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    env DEBIAN_FRONTEND=noninteractive "$@"
  else
    sudo env DEBIAN_FRONTEND=noninteractive "$@"
  fi
}

apt_install() {
  local get=(apt-get -y -o DPkg::Lock::Timeout=300 -o Dpkg::Options::=--force-confold) # nobody is there to answer
  as_root "${get[@]}" install --no-install-recommends "$@" && return
  # Package lists missing or out of date: fetch them once and retry.
  as_root "${get[@]}" update && as_root "${get[@]}" install --no-install-recommends "$@"
}

# install_packages PACKAGE...: installs the missing ones; no network access when none is missing.
install_packages() {
  local package missing=()
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    echo "This is no Debian: please install the equivalents of: $*"
    return
  fi
  for package in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
    echo "Missing packages. As root: apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  # Ask for the password before the output goes to a log.
  [ "$(id -u)" -eq 0 ] || sudo -v || exit 1
  run install.log "Installing ${#missing[@]} Debian packages and what they need" apt_install "${missing[@]}"
}

# Parallel compilers: one per processor, at most one per 1.5 GB of free memory. JOBS=N overrides.
job_count() {
  local jobs memory
  jobs=$(nproc 2>/dev/null || echo 1)
  memory=$(awk '/^MemAvailable:/ { print int($2 / 1572864) }' /proc/meminfo 2>/dev/null || true)
  if [ -n "$memory" ] && [ "$memory" -lt "$jobs" ]; then
    jobs=$memory
  fi
  [ "$jobs" -ge 1 ] || jobs=1
  echo "${JOBS:-$jobs}"
}

# build_tree TARGET...: configure and build; incremental.
build_tree() {
  local options=()
  ! command -v ccache >/dev/null || options=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  cd "$root" || exit 1 # presets are searched in the current folder
  run configure.log "Configuring" cmake --preset release -DVISP_DIRECT_BUILD_APPS=ON ${options[@]+"${options[@]}"}
  run build.log "Building, $(job_count) at a time (minutes the first time)" \
    cmake --build --preset release --parallel "$(job_count)" --target "$@"
}
