#!/bin/sh
# Plots the time of vpPatternTracker over the number of cells in view, 128 x 128 to 2048 x 2048 px, as doc/pattern-scaling.svg.
# Usage: scripts/plot-pattern-scaling.sh [BUILD_DIR]     (build/release)
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=${1:-$root/build/release}
table=$(mktemp)
trap 'rm -f "$table" "$table.dat"' EXIT
"$build/bin/perfPatternTracker" --benchmark_filter='^scaling' --benchmark_format=csv 2>/dev/null >"$table"
# Columns by name, as Google Benchmark sorts the counters.
awk -F, '/^name,/ { for (i = 1; i <= NF; i++) { gsub(/"/, "", $i); column[$i] = i } next }
         /^"scaling/ { split($1, part, "/"); print part[2], $column["cells"], $column["p50_us"] }' "$table" >"$table.dat"
cat "$table.dat"
gnuplot <<PLOT
set terminal svg size 760,420 font "sans,13" background "white"
set output "$root/doc/pattern-scaling.svg"
set title "vpPatternTracker: time per image against cells in view"
set xlabel "whole cells in view"
set ylabel "median time (us)"
set logscale xy
set grid
set key top left
plot "$table.dat" using 2:3:(sprintf("%d x %d px", \$1, \$1)) with labels point pt 7 ps 0.8 lc rgb "#1f77b4" offset -5,0.8 \
       title "measured", \
     x * system("awk 'NR == 3 { print \$3 / \$2 }' '$table.dat'") with lines dt 2 lc rgb "#888888" title "in proportion to the cells"
PLOT
echo "doc/pattern-scaling.svg"
