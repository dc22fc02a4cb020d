#!/usr/bin/env bash
# scripts/release.sh in a small repository of its own: every fault is told, and none otherwise.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir scripts
cp "$root/scripts/release.sh" scripts/
export GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=t GIT_AUTHOR_EMAIL=t@example.org GIT_COMMITTER_NAME=t GIT_COMMITTER_EMAIL=t@example.org
unset GIT_DIR GIT_WORK_TREE GIT_INDEX_FILE
git init -q .

# expect STATUS SENTENCE ARGUMENT...
expect() {
  local wanted=$1 sentence=$2 said status=0
  shift 2
  said=$(scripts/release.sh "$@" 2>&1) || status=$?
  if [ "$status" -ne "$wanted" ] || [[ $said != *"$sentence"* ]]; then
    printf 'release.sh %s ended with %s, not %s, without "%s":\n%s\n' "$*" "$status" "$wanted" "$sentence" "$said" >&2
    exit 1
  fi
}
# files VERSION CITED HEADING UNRELEASED
files() {
  echo "project(VispDirect VERSION $1 LANGUAGES CXX)" >CMakeLists.txt
  echo "version: $2" >CITATION.cff
  printf '# Changelog\n\n## [Unreleased]\n%s\n\n%s\n\n### Added\n- One thing.\n\n## [0.1.0] - 2025-01-01\n- Old.\n' "$4" "$3" >CHANGELOG.md
  git add -A
  git commit -qm files --allow-empty
}
good="## [0.2.0] - 2026-01-31"

files 0.2.0 0.2.0 "$good" ""
expect 0 "usage:" --help
expect 2 "usage:" 0.2
expect 2 "usage:"
expect 2 "usage:" --push 0.2.0
expect 0 "0.2.0 is ready" 0.2.0
expect 1 "CMakeLists.txt has version 0.2.0, not 0.3.0" 0.3.0
expect 1 "no heading" 0.3.0
touch left-over
expect 1 "not clean" 0.2.0
rm left-over
files 0.2.0 0.1.0 "$good" ""
expect 1 "CITATION.cff has version 0.1.0" 0.2.0
files 0.2.0 0.2.0 "$good" "- Something new."
expect 1 "[Unreleased]" 0.2.0
files 0.2.0 0.2.0 "## [0.2.0]" ""
expect 1 'but "## [0.2.0]"' 0.2.0
files 0.1.0 0.2.0 "$good" ""
expect 1 "CMakeLists.txt has version 0.1.0" 0.2.0
files 0.2.0 0.2.0 "$good" ""
expect 0 "tagged v0.2.0" --tag 0.2.0
[[ $(git tag -n9 v0.2.0) == *"One thing"* ]]
expect 1 "the tag v0.2.0 exists" 0.2.0
echo "release: all faults are told"
