#!/usr/bin/env bash
# Style of the C++ sources: scripts/lint.sh format | fix | tidy [FILE...]. Exit status 1 when something must be fixed.
#   format  lists what clang-format would change      fix  applies the changes
#   tidy    runs clang-tidy with .clang-tidy on the files of the release build
set -euo pipefail
# shellcheck source=scripts/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

usage() {
  echo "usage: scripts/lint.sh format|fix|tidy [FILE...]" >&2
  exit 2
}
[ $# -ge 1 ] || usage
what=$1
shift
cd "$root"

sources=("$@")
if [ $# -eq 0 ]; then
  mapfile -t sources < <(find modules apps support test tutorial python -name '*.cpp' -o -name '*.h' 2>/dev/null | sort)
fi

case $what in
  format)
    install_packages clang-format
    clang-format --dry-run --Werror "${sources[@]}"
    echo "format: ${#sources[@]} files are as .clang-format wants them"
    ;;
  fix)
    install_packages clang-format
    clang-format -i "${sources[@]}"
    ;;
  tidy)
    install_packages "${packages[@]}" clang-tidy
    [ -f "$build/compile_commands.json" ] || build_tree all
    # Headers are checked through the files that include them; a file outside the build has no compile command.
    compiled=()
    for file in "${sources[@]}"; do
      [[ $file != */benchmark/* ]] || continue # Google Benchmark's macros cannot be fixed here
      if [[ $file == *.cpp ]] && grep -qF "\"file\": \"$(realpath "$file")\"" "$build/compile_commands.json"; then
        compiled+=("$file")
      fi
    done
    [ ${#compiled[@]} -gt 0 ] || { echo "tidy: none of these files is part of the release build" >&2; exit 1; }
    # clang does not know GCC's own warning options.
    printf '%s\0' "${compiled[@]}" |
      xargs -0 -n 1 -P "$(job_count)" clang-tidy --quiet -p "$build" --extra-arg=-Wno-unknown-warning-option \
        2> >(grep -v -E 'warnings? generated|Suppressed|^Use -header-filter' >&2)
    echo "tidy: nothing to say about ${#compiled[@]} files"
    ;;
  *) usage ;;
esac
