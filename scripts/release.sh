#!/usr/bin/env bash
# Is this tree ready to be released? Checks only, unless --tag is given.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: scripts/release.sh [--tag] VERSION

Checks that VERSION (such as 0.2.0) is the version of the project in CMakeLists.txt and in CITATION.cff, that CHANGELOG.md has its
heading "## [VERSION] - YYYY-MM-DD" with text below it and nothing is left under [Unreleased], that the tree is clean and
that the tag vVERSION does not exist yet. All faults are listed; exit status 1 if there is one, 2 for a wrong command line.
  --tag   then makes the tag vVERSION, annotated with the text of the changelog; nothing is pushed
Run test.sh first: this script builds nothing.
TEXT
}

tag=false
version=
for argument; do
  case $argument in
  -h | --help) usage; exit 0 ;;
  --tag) tag=true ;;
  -*) usage >&2; exit 2 ;;
  *) [ -z "$version" ] || { usage >&2; exit 2; }; version=$argument ;;
  esac
done
if ! [[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]]; then
  usage >&2
  exit 2
fi
cd "$(dirname "${BASH_SOURCE[0]}")/.."

faults=0
fault() {
  echo "release.sh: $*" >&2
  faults=$((faults + 1))
}
# section NAME: the lines of the changelog between the heading [NAME] and the next one, without empty ones.
section() {
  awk -v name="[$1]" '/^## / { inside = ($2 == name); next } inside && NF' CHANGELOG.md
}

project=$(sed -nE 's/^project\(VispDirect VERSION ([0-9.]+).*/\1/p' CMakeLists.txt)
[ "$project" = "$version" ] || fault "CMakeLists.txt has version $project, not $version"
cited=$(sed -nE 's/^version: *"?([0-9.]+)"?$/\1/p' CITATION.cff)
[ "$cited" = "$version" ] || fault "CITATION.cff has version ${cited:-none}, not $version"

heading=$(grep -F "## [$version]" CHANGELOG.md || true)
if ! [[ $heading =~ ^"## [$version] - "[0-9]{4}-[0-9]{2}-[0-9]{2}$ ]]; then
  fault "CHANGELOG.md has no heading \"## [$version] - YYYY-MM-DD\"${heading:+, but \"$heading\"}"
elif [ -z "$(section "$version")" ]; then
  fault "CHANGELOG.md says nothing about $version"
fi
[ -z "$(section Unreleased)" ] || fault "CHANGELOG.md still has text under [Unreleased]"

changed=$(git status --porcelain)
[ -z "$changed" ] || fault "the tree is not clean: $(head -n 3 <<<"$changed" | tr '\n' ';')"
! git rev-parse -q --verify "refs/tags/v$version" >/dev/null || fault "the tag v$version exists already"

if [ "$faults" -gt 0 ]; then
  exit 1
fi
if $tag; then
  { echo "visp-direct $version"; echo; section "$version"; } | git tag -a "v$version" --cleanup=verbatim -F -
  echo "release.sh: tagged v$version; to publish it: git push origin v$version"
else
  echo "release.sh: $version is ready; to tag it: scripts/release.sh --tag $version"
fi
