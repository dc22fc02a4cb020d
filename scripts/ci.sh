#!/usr/bin/env bash
# The jobs of .github/workflows/ci.yml, each also for any Debian or Ubuntu machine.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: scripts/ci.sh tests|warnings|style|sanitizers|documentation|packages|seeds

  tests           everything, with a seed of the day (test.sh)
  warnings        everything by GCC and by Clang, a warning is an error (presets gcc and clang)
  style           clang-format, spelling, and shellcheck on all scripts
  sanitizers      memory, damaged files, threads (scripts/sanitize.sh)
  documentation   doxygen without a warning, links, groups
  packages        installed, static and guest builds; Debian packages, by lintian and installed (scripts/packages.sh --use)
  seeds           all tests at five seeds that change every day

Missing packages are installed. CXX=clang++ selects the compiler; JOBS=N sets the number of compilers at work.
TEXT
}

case ${1:-} in
-h | --help)
  usage
  exit 0
  ;;
tests | warnings | style | sanitizers | documentation | packages | seeds) [ $# -eq 1 ] || { usage >&2; exit 2; } ;;
*)
  usage >&2
  exit 2
  ;;
esac
# shellcheck source=scripts/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
cd "$root"

case $1 in
tests) ./test.sh ;;
warnings)
  install_packages "${packages[@]}" "${test_packages[@]}" clang libomp-dev
  for compiler in gcc clang; do
    cmake --preset "$compiler"
    cmake --build --preset "$compiler" --parallel "$(job_count)"
  done
  ;;
style)
  install_packages clang-format shellcheck
  scripts/lint.sh format
  scripts/lint.sh spell
  mapfile -t shell < <(find . -path ./build -prune -o -path ./out -prune -o -name '*.sh' -print | sort)
  shellcheck -x "${shell[@]}"
  echo "style: ${#shell[@]} scripts are as shellcheck wants them"
  ;;
sanitizers)
  install_packages "${packages[@]}" "${test_packages[@]}"
  scripts/sanitize.sh memory
  scripts/sanitize.sh files
  scripts/sanitize.sh threads
  ;;
documentation)
  install_packages "${packages[@]}" "${test_packages[@]}"
  build_tree doc
  python3 test/pages/checkPages.py # without commands, which need the programs: they are checked by `tests`
  ;;
packages)
  install_packages "${packages[@]}" "${test_packages[@]}" pkg-config
  build_tree vispdirect_installable
  VISP_DIRECT_LONG_TESTS=1 ctest --preset release --no-tests=error -R '^(exportedSymbols|installedPackage|staticPackage|guestProject)$'
  scripts/packages.sh --use
  ;;
seeds)
  day=$(date +%Y%m%d)
  VISP_DIRECT_LONG_TESTS=2 VISP_DIRECT_SEED="${day}1 ${day}2 ${day}3 ${day}4 ${day}5" ./test.sh -LE doc
  ;;
esac
