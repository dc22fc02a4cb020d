#!/usr/bin/env bash
# Build visp-direct inside a ViSP source tree, as its users with a ViSP of their own do, and run its tests there.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: test/contrib/run.sh [--fetch] VISP_SOURCE_DIR [BUILD_DIR]

  VISP_SOURCE_DIR   an unpacked ViSP (3.5 is the reference), outside this repository
  BUILD_DIR         where to build; by default VISP_SOURCE_DIR-build. Kept: a second run is incremental.
  --fetch           first unpack Debian's source package of ViSP in VISP_SOURCE_DIR and use it; the apt lists of the
                    system are read, not changed

Only the ViSP modules that ours need are built, with -O1. Two ways of naming this repository are tried, each configured
afresh: VISP_CONTRIB_MODULES_PATH=<repository> (modules and applications) and <repository>/modules (modules only).
JOBS=N sets the number of compilers at work.
TEXT
}

die() { echo "contrib: $*" >&2; exit 2; }

# Debian's source package into $1, with package lists of its own. The mirror is the one this system uses.
fetch() {
  local into=$1 apt keyring=/usr/share/keyrings/debian-archive-keyring.gpg options=
  command -v dpkg-source >/dev/null || die "--fetch needs dpkg-source (Debian package dpkg-dev)"
  mkdir -p "$into" "$into/.apt/lists/partial" "$into/.apt/cache/archives/partial"
  into=$(cd "$into" && pwd)
  [ ! -f "$keyring" ] || options="[signed-by=$keyring] "
  # shellcheck disable=SC2016 # apt expands these, not the shell
  apt-get indextargets --format '$(ORIGIN)|$(REPO_URI) $(CODENAME) $(COMPONENT)' 'Created-By: Packages' |
    sed -n "s#^Debian|#deb-src $options#p" | sort -u >"$into/.apt/sources.list"
  [ -s "$into/.apt/sources.list" ] || die "--fetch found no Debian archive in this system's apt lists; run apt-get update"
  apt=(apt-get -q -o "Dir::Etc::SourceList=$into/.apt/sources.list" -o Dir::Etc::SourceParts=/dev/null
    -o "Dir::State::Lists=$into/.apt/lists" -o "Dir::Cache=$into/.apt/cache" -o APT::Sandbox::User=root)
  "${apt[@]}" update
  (cd "$into" && "${apt[@]}" source visp)
  rm -rf "$into/.apt"
}

fetch_first=false
case "${1:-}" in
  -h | --help) usage; exit 0 ;;
  --fetch) fetch_first=true; shift ;;
esac
if [ $# -lt 1 ] || [ $# -gt 2 ]; then
  usage >&2
  exit 2
fi

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
visp=$1
if $fetch_first; then
  fetch "$visp"
  set -- "$visp"/visp-*/ "${@:2}"
  visp=$1
  [ -d "$visp" ] || die "apt-get source left no folder visp-* in $1"
fi
[ -f "$visp/cmake/VISPModule.cmake" ] || die "$visp is not a ViSP source folder (no cmake/VISPModule.cmake)"
visp=$(cd "$visp" && pwd)
build=${2:-$visp-build}
case "$visp/" in "$root"/*) die "the ViSP sources must lie outside $root: ViSP would take them for one of our modules" ;; esac
stray=$(find "$root/build" -maxdepth 4 -name CMakeLists.txt -print -quit 2>/dev/null || true)
[ -z "$stray" ] || die "ViSP would take $stray for one of our modules; remove it first"
mkdir -p "$build"
build=$(cd "$build" && pwd)

# What our modules and their tests use; everything else of ViSP stays out.
needed='core detection gui imgproc io sensor visual_features vision vs robot'
switches=()
while read -r module; do
  case " $needed " in *" $module "*) state=ON ;; *) state=OFF ;; esac
  switches+=("-DBUILD_MODULE_visp_$module=$state")
done < <(find "$visp/modules" -name CMakeLists.txt -exec sed -nE 's/^ *vp_(add|define)_module\(([a-z_]+).*/\2/p' {} + | sort -u)
command -v ccache >/dev/null && switches+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DCMAKE_C_COMPILER_LAUNCHER=ccache)

modules=()
tests=()
for folder in "$root"/modules/*/; do
  [ -f "$folder/CMakeLists.txt" ] || continue
  modules+=("$(basename "$folder")")
  for source in "$folder"test/*.cpp; do
    [ -f "$source" ] && tests+=("$(basename "$source" .cpp)")
  done
done
apps=()
for folder in "$root"/apps/visp-*/; do
  [ -f "$folder/CMakeLists.txt" ] && apps+=("$(basename "$folder")")
done
tutorials=()
for source in "$root"/tutorial/*/tutorial-*.cpp; do
  [ -f "$source" ] && tutorials+=("$(basename "$source" .cpp)")
done
echo "contrib: ${#modules[@]} modules (${modules[*]}), ${#tests[@]} test programs, ${#apps[@]} applications," \
  "${#tutorials[@]} tutorials"

# $1: what VISP_CONTRIB_MODULES_PATH names; the rest: further targets to build. Those named tutorial-* are tests, too.
build_and_test() {
  local path=$1 log target run
  shift
  log=$build/contrib.log
  echo "contrib: configuring with VISP_CONTRIB_MODULES_PATH=$path"
  # Afresh: a second cmake run in one build folder finds modules that a first run would miss.
  # Since 3.7 ViSP leaves out programs and tutorials whose folders are in the build folder already.
  rm -rf "$build/CMakeCache.txt" "$build/apps" "$build/tutorial"
  cmake -S "$visp" -B "$build" -G Ninja -DVISP_CONTRIB_MODULES_PATH="$path" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_FLAGS_RELEASE='-O1 -DNDEBUG' -DBUILD_TESTS=ON -DBUILD_APPS=ON -DBUILD_EXAMPLES=OFF -DBUILD_DEMOS=OFF \
    -DBUILD_TUTORIALS=ON -DBUILD_JAVA=OFF "${switches[@]}" >"$log" 2>&1 || { tail -n 30 "$log" >&2; return 1; }
  grep -E 'visp-direct|disabled because' "$log" || true
  for target in "${modules[@]/#/visp_}" "${tests[@]}" "$@"; do
    ninja -C "$build" -t query "$target" >/dev/null 2>&1 || { echo "contrib: ViSP did not take up $target" >&2; return 1; }
  done
  ninja -C "$build" ${JOBS:+-j "$JOBS"} "${modules[@]/#/visp_}" "${tests[@]}" "$@" >>"$log" 2>&1 ||
    { tail -n 40 "$log" >&2; return 1; }
  run=("${tests[@]}")
  for target in "$@"; do
    [[ $target != tutorial-* ]] || run+=("$target")
  done
  (cd "$build" && ctest --output-on-failure --no-tests=error -R "^($(IFS='|'; echo "${run[*]}"))\$")
}

start=$SECONDS
build_and_test "$root" ${apps[@]+"${apps[@]}"} ${tutorials[@]+"${tutorials[@]}"}
build_and_test "$root/modules"
echo "contrib: both ways build and pass their tests, $((SECONDS - start)) s"
