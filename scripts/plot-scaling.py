#!/usr/bin/env python3
# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""How times grow with obstacles, targets, pixels and axes (doc/scaling.svg), or of vpPatternTracker with cells in view alone."""
import argparse
import json
import pathlib
import re
import subprocess

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt

ROOT = pathlib.Path(__file__).resolve().parent.parent
NS = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}
UNITS = [("s", 1e9), ("ms", 1e6), ("us", 1e3), ("ns", 1.0)]


def name_value(run):
    """The last number in the name of a benchmark: its argument."""
    name = re.sub(r"/iterations:.*", "", run["name"])
    return float(re.findall(r"\d+", name)[-1])


def pattern_pixels(run):
    """Megapixels of a square image of the given side."""
    return name_value(run) ** 2 / 1e6


def frame_pixels(run):
    """Megapixels of a frame of the given height: 640x480 or 16:9."""
    height = name_value(run)
    return height * (640 if height == 480 else height * 16 / 9) / 1e6


# Title, label of x, and curves: label, program, benchmarks, x of a run.
PANELS = [
    (
        "obstacles",
        "obstacles",
        [
            ("free motion certified", "perfCollisionScene", "^motionAmong/free/", name_value),
            ("colliding motion", "perfCollisionScene", "^motionAmong/colliding/", name_value),
            ("collision or not", "perfCollisionScene", "^collisionAmong<vpSceneChecker>/", name_value),
        ],
    ),
    ("targets", "targets in the database", [("frame, one in view", "perfTargetDatabase", "^database/", name_value)]),
    (
        "pixels",
        "image (Mpx)",
        [
            ("vpPatternTracker", "perfPatternTracker", "^scaling/", pattern_pixels),
            ("vpPlanarTarget", "perfPlanarTarget", "^track/", frame_pixels),
        ],
    ),
    ("axes", "axes", [("retarget", "perfDirectTrajectory", "^retargetOf", name_value)]),
]


def measure(build, program, benchmarks):
    """Runs of Google Benchmark, each with its CPU time in ns."""
    command = [build / "bin" / program, "--benchmark_filter=" + benchmarks, "--benchmark_format=json"]
    runs = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout)["benchmarks"]
    if not runs:
        raise SystemExit(f"{program}: no benchmark matches {benchmarks}")
    for run in runs:
        run["cpu_ns"] = run["cpu_time"] * NS[run["time_unit"]]
    return runs


def save(figure, file):
    """An SVG that is the same in every run."""
    figure.savefig(file, metadata={"Date": None})


def draw_panel(axes, build, title, xlabel, curves):
    """Times of each curve over x, both logarithmic."""
    measured = []
    for label, program, benchmarks, x_of in curves:
        runs = sorted(measure(build, program, benchmarks), key=x_of)
        measured.append((label, [x_of(run) for run in runs], [run["cpu_ns"] for run in runs]))
    largest = max(max(times) for _, _, times in measured)
    unit, scale = next((name, scale) for name, scale in UNITS if largest >= scale or name == "ns")
    for label, x, times in measured:
        axes.loglog(x, [t / scale for t in times], "o-", label=label)
        for row in zip(x, times):
            print(f"{label}, {row[0]:g} {xlabel}: {row[1] / scale:.3g} {unit}")
    axes.set(xlabel=xlabel, ylabel=f"CPU time ({unit})", title=title)
    axes.grid(which="both", color="#dddddd")
    places = sorted({x for _, places, _ in measured for x in places})
    axes.set_xticks(places, [f"{round(x, 2):g}" for x in places], rotation=30 if len(places) > 5 else 0)
    axes.minorticks_off()
    axes.margins(y=0.25)
    axes.legend(loc="upper left")


def draw_all(build, file):
    """One panel for each kind of growth."""
    figure, grid = plt.subplots(2, 2, figsize=(9.6, 7.2), layout="constrained")
    for axes, (title, xlabel, curves) in zip(grid.flat, PANELS):
        draw_panel(axes, build, title, xlabel, curves)
    save(figure, file)


def draw_pattern(build, file):
    """vpPatternTracker over the cells in view, 128 x 128 to 2048 x 2048 px."""
    runs = measure(build, "perfPatternTracker", "^scaling")
    sizes = [run["name"].split("/")[1] for run in runs]
    cells = [run["cells"] for run in runs]
    times = [run["p50_us"] for run in runs]
    for row in zip(sizes, cells, times):
        print("%s px, %g cells: %.1f us" % row)
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
    save(figure, file)


def main():
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release", help="build folder with bin/perf*")
    parser.add_argument("--pattern", action="store_true", help="vpPatternTracker over the cells in view (doc/pattern-scaling.svg)")
    parser.add_argument("--out", type=pathlib.Path, help="file to write, SVG")
    options = parser.parse_args()
    plt.rcParams.update({"svg.hashsalt": "visp-direct", "font.size": 11})
    draw = draw_pattern if options.pattern else draw_all
    draw(options.build, options.out or ROOT / "doc" / ("pattern-scaling.svg" if options.pattern else "scaling.svg"))


main()
