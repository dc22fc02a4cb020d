#!/usr/bin/env python3
# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Time of vpPatternTracker over the cells in view, 128 x 128 to 2048 x 2048 px: scripts/plot-pattern-scaling.py [BUILD_DIR] [FILE.svg]"""
import json
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt

ROOT = pathlib.Path(__file__).resolve().parent.parent


def main():
    build = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build/release"
    file = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else ROOT / "doc/pattern-scaling.svg"
    command = [build / "bin/perfPatternTracker", "--benchmark_filter=^scaling", "--benchmark_format=json"]
    runs = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout)["benchmarks"]
    sizes = [run["name"].split("/")[1] for run in runs]
    cells = [run["cells"] for run in runs]
    times = [run["p50_us"] for run in runs]
    for row in zip(sizes, cells, times):
        print("%s px, %g cells: %.1f us" % row)
    plt.rcParams.update({"svg.hashsalt": "visp-direct", "font.size": 11})
    figure, axes = plt.subplots(figsize=(7.9, 4.4), layout="constrained")
    axes.loglog(cells, times, "o", color="#1f77b4", label="measured")
    per_cell = times[2] / cells[2]
    axes.loglog(cells, [n * per_cell for n in cells], "--", color="#888888", label="in proportion to the cells")
    for size, x, y in zip(sizes, cells, times):
        axes.annotate(f"{size} x {size} px", (x, y), xytext=(-8, 5), textcoords="offset points", ha="right")
    axes.margins(x=0.25, y=0.15)
    axes.set(xlabel="whole cells in view", ylabel="median time (us)", title="vpPatternTracker: time per image against cells in view")
    axes.grid(which="both", color="#dddddd")
    axes.legend(loc="lower right")
    figure.savefig(file, metadata={"Date": None})


main()
