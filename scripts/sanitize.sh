#!/bin/sh
# Runs tests under the compiler's sanitizers. Builds only what they need, in build/asan and build/tsan.
#
#   scripts/sanitize.sh memory [MODULE...]   address and undefined behaviour: all tests of these modules
#                                            (default: trajectory feedforward manipulator avoidance)
#   scripts/sanitize.sh files [FACTOR]       same sanitizers: damaged files of every format, 400 times FACTOR each (default: 25)
#   scripts/sanitize.sh threads              data races: the programs' job runner, the real-time arm, the servo of two threads, and the pattern tracker
#
# JOBS=N compiles N files at a time (default: the number of cores). Exit status 1 when anything is found.
set -eu
cd "$(dirname "$0")/.."
jobs=${JOBS:-$(nproc)}

export ASAN_OPTIONS="detect_stack_use_after_return=1:strict_string_checks=1"
export UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1"
export LSAN_OPTIONS="suppressions=$PWD/scripts/sanitizers/leaks.txt"
export TSAN_OPTIONS="suppressions=$PWD/scripts/sanitizers/threads.txt:halt_on_error=1:second_deadlock_stack=1"

# build PRESET TEST...: builds these test programs. run PRESET TEST...: runs them by ctest.
build() {
  preset=$1
  shift
  launcher=
  if command -v ccache >/dev/null; then launcher=-DCMAKE_CXX_COMPILER_LAUNCHER=ccache; fi
  cmake --preset "$preset" $launcher >/dev/null
  cmake --build --preset "$preset" -j "$jobs" --target "$@"
}
run() {
  preset=$1
  shift
  ctest --preset "$preset" --parallel "$jobs" -R "^($(echo "$@" | tr ' ' '|'))\$" --no-tests=error
}
tests_of() {
  for module; do
    for file in "modules/$module"/test/catch*.cpp; do basename "$file" .cpp; done
  done
}

case ${1:-} in
memory)
  shift
  if [ $# -eq 0 ]; then set -- trajectory feedforward manipulator avoidance; fi
  tests=$(tests_of "$@")
  # shellcheck disable=SC2086 # names of tests, one word each
  build asan $tests
  # shellcheck disable=SC2086
  run asan $tests
  ;;
files)
  export VISP_DIRECT_LONG_TESTS="${2:-25}"
  build asan catchMutatedFiles catchMutatedProgramFiles
  run asan catchMutatedFiles catchMutatedProgramFiles
  ;;
threads)
  build tsan catchAppsCommon catchSimulatedArm catchSimulatedArmThreads catchVisualServoThreads catchPatternThreads
  run tsan catchAppsCommon catchSimulatedArm catchSimulatedArmThreads catchVisualServoThreads catchPatternThreads
  ;;
*)
  sed -n '2,/^set/s/^# \{0,1\}//p' "$0" >&2
  exit 2
  ;;
esac
