#!/usr/bin/env bash
# Configure, build and test with each optional library switched off in turn, and see what a program says that wants it.
set -euo pipefail
usage() {
  cat <<'TEXT'
usage: test/dependencies/run.sh [NAME...]

Everything is built and tested in build/without-NAME, once for each NAME: KDL, URDFDOM, OCTOMAP, ASSIMP, FCL, OMPL, DLIB, ARAVIS,
CLI11 or PYTHON (by default all of them). CTEST_ARGS="-R Servo" goes to ctest; JOBS=N sets the number of compilers and tests at work.
TEXT
}
case ${1:-} in -h | --help) usage; exit 0 ;; esac
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
[ $# -gt 0 ] || set -- KDL URDFDOM OCTOMAP ASSIMP FCL OMPL DLIB ARAVIS CLI11 PYTHON
launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)

# expect STATUS SENTENCE COMMAND...: the command ends with the status and says the sentence.
expect() {
  local wanted=$1 sentence=$2 said status=0
  shift 2
  said=$("$@" 2>&1) || status=$?
  if [ "$status" -ne "$wanted" ] || [[ $said != *"$sentence"* ]]; then
    printf 'dependencies: "%s" ended with %s, not %s, and said:\n%s\n' "$*" "$status" "$wanted" "$said" >&2
    exit 1
  fi
}

for name; do
  build=build/without-$name
  out=$(mktemp -d)
  echo "== without $name"
  cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DVISP_DIRECT_BUILD_BENCHMARKS=OFF "-DWITH_$name=OFF" "${launcher[@]}" >"$build.log" 2>&1 || { cat "$build.log" >&2; exit 1; }
  grep -q "$name is switched off\|no programs are built" "$build.log" || { echo "dependencies: no word about $name" >&2; exit 1; }
  cmake --build "$build" -j "${JOBS:-$(nproc)}" >"$build.log" 2>&1 || { tail -40 "$build.log" >&2; exit 1; }
  bin=$build/bin
  [ "$name" = CLI11 ] || expect 0 "cells printed" "$bin/visp-print-pattern" --cells 3 --no-thesis --out "$out/print"
  case $name in
  KDL) expect 0 "report.html" "$bin/visp-servo-compare" --law pbvs1 --plant D --robot amor --out "$out/arm" ;;
  URDFDOM) expect 1 "urdfdom" "$bin/visp-servo-compare" --robot data/robot/generic-6r.urdf --out "$out/arm" ;;
  OMPL) expect 0 "report.html" "$bin/visp-avoid-obstacle" --method planner --out "$out/planner" ;;
  esac
  rm -rf "$out"
  # shellcheck disable=SC2086 # several arguments
  OMP_NUM_THREADS=1 ctest --test-dir "$build" -j "${JOBS:-$(nproc)}" --no-tests=error --output-on-failure ${CTEST_ARGS:-} >"$build.log" 2>&1 ||
    { grep -A 20 "tests passed" "$build.log" >&2; echo "dependencies: the whole output is in $build.log" >&2; exit 1; }
  grep "tests passed" "$build.log"
done
