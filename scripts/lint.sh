#!/usr/bin/env bash
# Style of the sources: scripts/lint.sh format | fix | tidy | spell [FILE...]. Exit status 1 when something must be fixed.
#   format  lists what clang-format would change      fix  applies the changes
#   tidy    runs clang-tidy with .clang-tidy on the files of the release build
#   spell   codespell, and phrases for which the field has a term, in all text that is under version control
set -euo pipefail
# shellcheck source=scripts/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

usage() {
  echo "usage: scripts/lint.sh format|fix|tidy|spell [FILE...]" >&2
  exit 2
}
[ $# -ge 1 ] || usage
what=$1
shift
cd "$root"

sources=("$@")
if [ $# -eq 0 ]; then
  mapfile -t sources < <(find modules apps lab support test tutorial python -name '*.cpp' -o -name '*.h' | sort)
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
  spell)
    install_packages codespell
    # Names, and the deliberate misspellings of the tests of error messages.
    names=nees,onother,atleast,homestate,positionof,ot,te,fro,lamda,positon,agin,bu,objekt,unser
    phrases='stands twice|hangs on|shall be seen|deviations thicker|in the mean of|a pose that is none'
    [ $# -gt 0 ] || mapfile -t sources < \
      <(git ls-files | grep -vE '\.(json|bib|svg|jpg|png|webp|pgm|xyz|stl|css)$|^scripts/lint.sh$|^test/abi/')
    status=0
    codespell -L "$names" "${sources[@]}" || status=1
    if grep -nE "$phrases" "${sources[@]}"; then status=1; fi
    [ "$status" -eq 0 ] && echo "spell: nothing to say about ${#sources[@]} files"
    exit "$status"
    ;;
  *) usage ;;
esac
