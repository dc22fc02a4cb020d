#!/usr/bin/env bash
# Install what is missing, build visp-servo-compare and run it. Arguments go to the program: ./demo.sh --help
set -euo pipefail
from=$PWD # relative paths in the arguments mean the caller's folder
# shellcheck source=scripts/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/scripts/setup.sh"

# The report goes to out/ of the repository unless the arguments name a folder.
out=$root/out/servo-compare
arguments=(--out "$out" "$@")
for ((i = 1; i <= $#; i++)); do
  case ${!i} in
    --out) next=$((i + 1)) out=${!next:-} arguments=("$@") ;;
    --out=*) out=${!i#--out=} arguments=("$@") ;;
  esac
done

install_packages "${packages[@]}"
build_tree visp-servo-compare

cd "$from"
began=$(mktemp)
trap 'rm -f "$began"' EXIT
status=0
"$build/bin/visp-servo-compare" "${arguments[@]}" || status=$?
if [ "$status" -ne 0 ]; then
  echo "demo.sh: visp-servo-compare ended with status $status, $SECONDS s in all" >&2
elif [ "$out/report.html" -nt "$began" ]; then
  echo "demo.sh: the report is in $(realpath "$out/report.html"), $SECONDS s in all"
fi
exit "$status"
