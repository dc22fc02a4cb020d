#!/usr/bin/env bash
# Runs the commands of doc/gallery/README.md, all or those of the sections whose titles hold WORDS: scripts/gallery.sh [WORDS].
# They make its pictures again, and 3D views in out/gallery/live, which the target `doc` then shows instead of three of the pictures.
# Needs ffmpeg, ImageMagick, chromium and rsvg-convert.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
commands=$(awk -v words="${1:-}" '/^## / { here = index($0, words) } /^```$/ { code = 0 } code && here; /^```sh$/ { code = 1 }' doc/gallery/README.md)
[ -n "$commands" ] || { echo "gallery.sh: no section of doc/gallery/README.md has \"$1\" in its title" >&2; exit 2; }
mkdir -p out/gallery/live
bash -euxo pipefail -c "$commands"
