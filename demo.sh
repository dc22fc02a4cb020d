#!/usr/bin/env bash
# Install what is missing, build a program and run it: visp-servo-compare unless the first argument names another one
# (./demo.sh visp-print-pattern). The other arguments go to the program: ./demo.sh --help
set -euo pipefail
from=$PWD # relative paths in the arguments refer to the caller's folder
# shellcheck source=scripts/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/scripts/setup.sh"

program=visp-servo-compare
if [[ ${1:-} == visp-* ]]; then
  program=$1
  shift
  if [ ! -d "$root/apps/$program" ]; then
    echo "demo.sh: there is no program $program, only $(cd "$root/apps" && echo visp-*)" >&2
    exit 2
  fi
fi

# The result goes to out/ of the repository unless the arguments name a folder.
out=$root/out/${program#visp-}
arguments=(--out "$out" "$@")
for ((i = 1; i <= $#; i++)); do
  case ${!i} in
    --out) next=$((i + 1)) out=${!next:-} arguments=("$@") ;;
    --out=*) out=${!i#--out=} arguments=("$@") ;;
  esac
done

install_packages "${packages[@]}"
build_tree "$program"

cd "$from"
began=$(mktemp)
trap 'rm -f "$began"' EXIT
status=0
"$build/bin/$program" "${arguments[@]}" || status=$?
if [ "$status" -ne 0 ]; then
  echo "demo.sh: $program ended with status $status, $SECONDS s in all" >&2
elif [ "$out/report.html" -nt "$began" ]; then
  echo "demo.sh: the report is in $(realpath "$out/report.html"), $SECONDS s in all"
fi
exit "$status"
