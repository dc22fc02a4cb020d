#!/usr/bin/env bash
# Makes the small pictures of tutorial/README.md: beside the figure NAME.png of each tutorial NAME-small.png, with thicker lines.
# Needs ImageMagick.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../tutorial"
rm -f -- */*-small.png
for figure in */*.png; do
  convert "$figure" -statistic Minimum 3x3 -resize 200x120 -dither None -colors 32 -strip "PNG8:${figure%.png}-small.png"
done
