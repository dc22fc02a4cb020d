#!/usr/bin/env bash
# Configure, build and test with each optional library switched off in turn, and see what a program says that wants it.
set -euo pipefail
usage() {
  cat <<'TEXT'
usage: test/dependencies/run.sh [NAME...]

Everything is built in build/with-all and, once for each NAME, in build/without-NAME: KDL, URDFDOM, OCTOMAP, ASSIMP, FCL, OMPL, DLIB,
ARAVIS, CLI11 or PYTHON (by default all of them). There all tests are run but those whose program and libraries are the same files as
in build/with-all, which ./test.sh has run. CTEST_ARGS="-R Servo" goes to ctest; JOBS=N sets the number of compilers and tests at work.
TEXT
}
case ${1:-} in -h | --help) usage; exit 0 ;; esac
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
[ $# -gt 0 ] || set -- KDL URDFDOM OCTOMAP ASSIMP FCL OMPL DLIB ARAVIS CLI11 PYTHON
jobs=${JOBS:-$(nproc)}
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

# build FOLDER OPTION...: configures and builds; binaries do not hold the folder's path, so that they can be compared.
build() {
  local folder=$1
  shift
  cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_BUILD_RPATH_USE_ORIGIN=ON -DVISP_DIRECT_BUILD_BENCHMARKS=OFF "$@" \
    "${launcher[@]}" >"$folder.log" 2>&1 || { cat "$folder.log" >&2; exit 1; }
  cp "$folder.log" "$folder.configured"
  cmake --build "$folder" -j "$jobs" >"$folder.log" 2>&1 || { tail -40 "$folder.log" >&2; exit 1; }
}

# unchanged FOLDER: tests whose program, and the libraries of this project that it loads, are those of build/with-all, as a|b|c.
unchanged() {
  local program library names=none
  for program in "$1"/bin/catch*; do
    cmp -s "$program" "build/with-all/bin/${program##*/}" || continue
    for library in $(ldd "$program" | sed -n "s|.* => .*/$1/\(lib/[^ ]*\) .*|\1|p"); do
      cmp -s "$1/$library" "build/with-all/$library" || continue 2
    done
    names+="|${program##*/}"
  done
  echo "$names"
}

mkdir -p build
echo "== with everything"
build build/with-all
for name; do
  build=build/without-$name
  out=$(mktemp -d)
  echo "== without $name"
  build "$build" "-DWITH_$name=OFF"
  grep -q "$name is switched off\|no programs are built" "$build.configured" || { echo "dependencies: no word about $name" >&2; exit 1; }
  bin=$build/bin
  [ "$name" = CLI11 ] || expect 0 "cells printed" "$bin/visp-print-pattern" --cells 3 --no-thesis --out "$out/print"
  case $name in
  KDL) expect 0 "report.html" "$bin/visp-servo-compare" --law pbvs1 --plant D --robot amor --out "$out/arm" ;;
  URDFDOM) expect 1 "urdfdom" "$bin/visp-servo-compare" --robot data/robot/generic-6r.urdf --out "$out/arm" ;;
  OMPL) expect 0 "report.html" "$bin/visp-avoid-obstacle" --method planner --out "$out/planner" ;;
  esac
  rm -rf "$out"
  same=$(unchanged "$build")
  # shellcheck disable=SC2086 # several arguments
  OMP_NUM_THREADS=1 ctest --test-dir "$build" -j "$jobs" -E "^($same)\$" --no-tests=error --output-on-failure ${CTEST_ARGS:-} >"$build.log" 2>&1 ||
    { grep -A 20 "tests passed" "$build.log" >&2; echo "dependencies: the whole output is in $build.log" >&2; exit 1; }
  echo "$(grep "tests passed" "$build.log"); $(tr -cd '|' <<<"$same" | wc -c) more are the same as with everything"
done
