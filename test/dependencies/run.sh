#!/usr/bin/env bash
# Configure, build and test with each optional library switched off in turn, and see what a program says that wants it.
set -euo pipefail
usage() {
  cat <<'TEXT'
usage: test/dependencies/run.sh [NAME...]

In build/dependencies everything is built, then once without each NAME: KDL, URDFDOM, OCTOMAP, ASSIMP, FCL, OMPL, DLIB, ARAVIS, CLI11 or
PYTHON (by default all of them). There all tests are run but those whose program is the same file as with everything, and so are the
programs and libraries of this project that it uses: ./test.sh runs these. CTEST_ARGS="-R Servo" goes to ctest; JOBS=N sets the number of
compilers and tests at work.
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

build=build/dependencies
# build OPTION...: configures afresh and builds what has changed since.
build() {
  rm -f "$build/CMakeCache.txt"
  cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DVISP_DIRECT_BUILD_BENCHMARKS=OFF "$@" "${launcher[@]}" >"$build.log" 2>&1 ||
    { cat "$build.log" >&2; exit 1; }
  ninja -C "$build" -t cleandead >/dev/null
  cp "$build.log" "$build/configured.log"
  cmake --build "$build" -j "$jobs" >"$build.log" 2>&1 || { tail -40 "$build.log" >&2; exit 1; }
}

# binaries: "SUM FILE" of each program and library.
binaries() { (cd "$build" && find bin lib -type f -exec sha256sum {} + | sort -k 2); }

# named FILE...: files of the build that these load, or whose paths are compiled into them.
named() {
  { for file; do ldd "$file" | sed 's/ (.*//'; strings "$file"; done; printf '%s\n' "$@"; } |
    sed -n "s|.*\($PWD/$build/[^ \"']*\).*|\1|p" | sort -u | xargs -r realpath -m
}

# unchanged: tests all of whose files are as with everything, as none|a|b|c.
unchanged() {
  local test names=none changed programs
  changed=$(comm -13 <(binaries | sort) <(sort "$build/everything.txt") | sed "s|.* |$PWD/$build/|")
  for test in "$PWD/$build"/bin/catch*; do
    mapfile -t programs < <(named "$test" | grep "/bin/" | xargs -r ls -d 2>/dev/null)
    named "$test" "${programs[@]}" | grep -qxF "$changed" || names+="|${test##*/}"
  done
  echo "$names"
}

mkdir -p build
echo "== with everything"
build
binaries >"$build/everything.txt"
for name; do
  out=$(mktemp -d)
  echo "== without $name"
  build "-DWITH_$name=OFF"
  grep -q "$name is switched off\|no programs are built" "$build/configured.log" || { echo "dependencies: no word about $name" >&2; exit 1; }
  bin=$build/bin
  [ "$name" = CLI11 ] || expect 0 "cells printed" "$bin/visp-print-pattern" --cells 3 --no-thesis --out "$out/print"
  case $name in
  KDL) expect 0 "report.html" "$bin/visp-servo-compare" --law pbvs1 --plant D --robot amor --out "$out/arm" ;;
  URDFDOM) expect 1 "urdfdom" "$bin/visp-servo-compare" --robot data/robot/generic-6r.urdf --out "$out/arm" ;;
  OMPL) expect 0 "report.html" "$bin/visp-avoid-obstacle" --method planner --out "$out/planner" ;;
  esac
  rm -rf "$out"
  same=$(unchanged)
  # shellcheck disable=SC2086 # several arguments
  OMP_NUM_THREADS=1 ctest --test-dir "$build" -j "$jobs" -E "^($same)\$" --no-tests=error --output-on-failure ${CTEST_ARGS:-} >"$build.log" 2>&1 ||
    { grep -A 20 "tests passed" "$build.log" >&2; echo "dependencies: the whole output is in $build.log" >&2; exit 1; }
  echo "$(grep "tests passed" "$build.log"); $(tr -cd '|' <<<"$same" | wc -c) more are the same as with everything"
done
