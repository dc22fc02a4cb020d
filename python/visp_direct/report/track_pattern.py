# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Report of visp-track-pattern: what was found, how the product moved, and how well that is known."""
import math

import numpy as np

from .page import Page, counted, number
from .plots import Figure, colour, legend_above, marks

STATUSES = {"Acquiring": "#f0a030", "Tracking": "#3fa34d", "Degraded": "#e6d13a", "Lost": "#c8322b"}
STATUSES_SAY = (
    "Acquiring: looking for the lattice, or learning what a cell looks like; cells are measured by their edges "
    "meanwhile. Tracking: all holds. "
    "Degraded: fewer cells than there should be, or restarted identities. Lost: nothing in that image is valid."
)
MANY = 400  # images: points become lines


def status_figure(motion):
    frames, statuses = motion["frame"], motion["status"]

    def draw(panels):
        axes, i = panels[0], 0
        while i < len(statuses):  # a bar for each stretch of one status
            end = i
            while end < len(statuses) and statuses[end] == statuses[i]:
                end += 1
            axes.barh(0, end - i, left=i, color=STATUSES[statuses[i]], height=1)
            i = end
        for status, shade in STATUSES.items():
            axes.barh(0, 0, color=shade, label=f"{status}: {statuses.count(status)}")
        ticks = np.unique(np.linspace(0, len(frames) - 1, 6).astype(int))
        axes.set_xticks(ticks + 0.5, [f"{frames[k]:.0f}" for k in ticks])
        axes.set(yticks=[], xlabel="image", xlim=(0, len(statuses)))
        axes.grid(False)
        legend_above(axes)

    return Figure(draw, 1, 1.0)


def motion_figure(motion):
    style = "-" if len(motion["frame"]) > MANY else "."

    def draw(panels):
        for axes, axis in zip(panels, "xy"):
            axes.plot(motion["frame"], motion[f"true_d{axis}"], color="#9aa5b1", label=f"true, {axis}")
            axes.plot(
                motion["frame"],
                motion[f"d{axis}"],
                style,
                color=colour("xy".index(axis)),
                markersize=3,
                label=f"found, {axis}",
            )
            axes.set_ylabel(f"d{axis} (px)")
            legend_above(axes)
        panels[-1].set_xlabel("image")

    return Figure(draw, 2, 1.7)


def error_figure(motion):
    def draw(panels):
        axes = panels[0]
        for i, axis in enumerate("xy"):
            error = np.array(motion[f"d{axis}"]) - np.array(motion[f"true_d{axis}"])
            axes.plot(motion["frame"], error, color=colour(i), linewidth=1, label=axis)
        axes.set(xlabel="image", ylabel="found − true (px)")
        legend_above(axes)

    return Figure(draw)


def sigma_figure(motion):
    """After learning."""
    shown = np.array([status != "Acquiring" for status in motion["status"]])
    shown = shown if shown.any() else ~shown

    def draw(panels):
        axes, frames = panels[0], np.array(motion["frame"])[shown]
        for i, axis in enumerate("xy"):
            axes.plot(
                frames, np.array(motion[f"sigma_{axis}"])[shown], color=colour(i), label=f"a cell, {axis} (median)"
            )
            axes.plot(
                frames,
                np.array(motion[f"sigma_d{axis}"])[shown],
                "--",
                color=colour(i),
                linewidth=1,
                label=f"displacement, {axis}",
            )
        axes.set(xlabel="image", ylabel="standard deviation (px)", ylim=(0, None))
        legend_above(axes)

    return Figure(draw)


def time_figure(times):
    def draw(panels):
        axes, end = panels[0], 1.2 * max(np.quantile(times, 0.98), 1e-3)
        axes.hist(times, bins=60, range=(0, end), color=colour(5), edgecolor=colour(0), linewidth=0.5, label="images")
        marks(axes, [np.median(times)], f"median {number(float(np.median(times)))} µs")
        axes.set(xlabel="time of the tracker (µs)", ylabel="images", xlim=(0, end))
        legend_above(axes)

    return Figure(draw)


def round_below(value):
    """The largest of 1, 2, 5 times a power of ten that is not above the value."""
    power = 10.0 ** math.floor(math.log10(value))
    return next(k * power for k in (5, 2, 1) if value >= k * power)


def deviation_map(table, lattice):
    """Places on the regular lattice, not turned, deviations there, and how long to draw these; of the epoch with the most cells. None without."""
    epochs, counts = np.unique(table["epoch"], return_counts=True)
    if not len(epochs) or not lattice["column_pitch_px"] > 0:
        return None
    kept = np.array(table["epoch"]) == epochs[counts.argmax()]
    pitch = np.array([lattice["column_pitch_px"], lattice["row_pitch_px"]])
    places = np.stack([table["column"], table["row"]], axis=1)[kept] * pitch
    c, s = math.cos(math.radians(lattice["angle_deg"])), math.sin(math.radians(lattice["angle_deg"]))
    deviations = np.stack([table["x_px"], table["y_px"]], axis=1)[kept] @ np.array([[c, -s], [s, c]])
    # The longest arrows nearly reach the neighbour.
    factor = round_below(0.8 * min(pitch / np.maximum(np.quantile(np.abs(deviations), 0.95, axis=0), 1e-6)))
    return places, deviations, factor


def map_figure(places, deviations, factor):
    def draw(panels):
        axes = panels[0]
        axes.plot(*places.T, ".", color="#9aa5b1", markersize=2, label="regular lattice")
        ends = places + factor * deviations
        axes.plot(
            *np.stack([places, ends, np.full_like(ends, np.nan)], axis=1).reshape(-1, 2).T,
            color=colour(0),
            linewidth=0.8,
        )
        axes.plot(
            *ends.T,
            ".",
            color=colour(0),
            markersize=4,
            label=f"cells, deviations {number(float(factor))} times as long",
        )
        sample = round_below(np.ptp(places[:, 0]) / 8 / factor) if np.ptp(places[:, 0]) > 0 else 0
        if sample > 0:  # below the map
            x, y = places[:, 0].min(), places[:, 1].max() + 0.08 * np.ptp(places, axis=0).max()
            axes.plot(
                [x, x + factor * sample], [y, y], color="#000000", linewidth=2, label=f"{number(float(sample))} px"
            )
        axes.set(xlabel="along the rows (px)", ylabel="across (px)")
        axes.set_aspect("equal", "datalim")
        axes.invert_yaxis()
        legend_above(axes)

    width, height = np.maximum(np.ptp(places, axis=0), 1)
    return Figure(draw, 1, float(np.clip(8 * height / width + 1, 2, 5)))


def errors_row(name, e):
    x, y, dx, dy = (e[key] or {} for key in ("x", "y", "dx", "dy"))
    return [
        name,
        x["number"],
        *(axis.get(key) for key in ("mean_px", "sigma_px", "rms_over_told_sigma") for axis in (x, y)),
        dx.get("number", 0),
        dx.get("sigma_px"),
        dy.get("sigma_px"),
        e["two_px_off"],
        e["no_cell_there"],
        e["other_name"],
    ]


def add_accuracy(page, result, motion):
    errors = result.summary.get("errors", {})
    rows = [errors_row(name.capitalize(), errors[name]) for name in errors if errors[name]["x"]]
    if rows or np.isfinite(motion["sigma_x"]).any():
        page.section("Accuracy")
    if rows:
        page.table(
            [
                "status",
                "centres",
                "mean x (px)",
                "mean y",
                "sigma x (px)",
                "sigma y",
                "error / reported sigma, x",
                "y",
                "displacements",
                "sigma x (px)",
                "sigma y",
                "2 px off",
                "no cell there",
                "other name",
            ],
            rows,
            "Found against true. The errors over the standard deviations that the tracker reports are 1 (rms) when "
            "these are right. 2 px off: centres that are "
            "not in the other figures; no cell there: where there is none; other name: cells that had another row and "
            "column before.",
        )
    if np.isfinite(motion["sigma_x"]).any():
        page.figure(
            sigma_figure(motion),
            f"sigma-{result.name}",
            "Standard deviations per image",
            "What the tracker expects its errors to be, from the noise of each image, after learning. It knows nothing "
            "of errors that all images share, "
            "such as those of the lens.",
        )


def add_result(page, result):
    summary, motion = result.summary, result.table("motion.csv")
    page.picture(
        result.bytes("picture.png"),
        "image/png",
        "An image with the cells that were found",
        "One of the images, enlarged. Green crosses: centres of cells that were measured. Red: cells that are there by "
        "the lattice but were not measured, "
        "because of dirt or because the pattern ends there.",
    )
    page.section("Status")
    page.figure(status_figure(motion), f"status-{result.name}", "Status of every image", STATUSES_SAY)
    if np.isfinite(motion["dx"]).any():
        page.section("Motion")
        page.figure(
            motion_figure(motion),
            f"motion-{result.name}",
            "Displacement of every image",
            "How far the product moved since the image before: x to the right, y down. A gap in the curve: not known, "
            "as where images are missing.",
        )
        if "errors" in summary:
            page.figure(
                error_figure(motion), f"error-{result.name}", "Error of the displacement", "The same, minus the truth."
            )
    add_accuracy(page, result, motion)
    deviations = deviation_map(result.table("deviations.csv"), summary["lattice"])
    if deviations:
        rms = np.sqrt((deviations[1] ** 2).mean(axis=0))
        page.section("How regular the product is")
        page.figure(
            map_figure(*deviations),
            f"deviations-{result.name}",
            "Map of the deviations from the lattice",
            f"Where the {len(deviations[0])} cells lie off the regular lattice, as on the product, not turned. Root "
            f"mean square: {number(float(rms[0]))} px along "
            f"the rows, {number(float(rms[1]))} px across.",
        )
    page.section("Time")
    page.figure(
        time_figure(motion["microseconds"]),
        f"time-{result.name}",
        "Histogram of the time per image",
        "Time of the tracker alone, without reading and drawing, on this machine as busy as it was. The slow images "
        "are those in which it searches or "
        "learns; the two per cent that took longest may lie outside.",
    )


def settings(summary):
    roi = summary["roi"]
    return [
        ("Command", summary["command"]),
        ("Input", summary["input"]),
        ("Image size", f"{summary['image']['width']} × {summary['image']['height']} px"),
        ("Method, threshold", f"{summary['method']}, {summary['threshold']}"),
        *([("Looked only at", f"{roi[2]} × {roi[3]} px from ({roi[0]}, {roi[1]})")] if roi else []),
        *(
            [
                (
                    "Calibration",
                    f"{summary['calibration']['file']}, {number(summary['calibration']['um_per_px'])} µm a pixel",
                )
            ]
            if "calibration" in summary
            else []
        ),
    ]


def page(results):
    several, first = len(results) > 1, results[0].summary
    ending = "" if first.get("status", "complete") == "complete" else f" ({first['status']})"
    page = Page(
        "Tracking of a repetitive product",
        f"{counted(first['images'], 'image')} of {first['image']['width']} × {first['image']['height']} px, "
        f"{first['input']}{ending}",
    )
    for result in results:
        page.answers(
            *(f"{result.name}: {sentence}" if several else sentence for sentence in result.summary["findings"])
        )
    for result in results:
        page.section(f"What was found by {result.name}" if several else "What was found")
        add_result(page, result)
        if result is results[0] and (result.folder / "overlay.mp4").is_file():
            page.section("All images")
            page.video("overlay.mp4", "The file overlay.mp4 beside this page.")
    page.section("What was asked for")
    page.paragraph(
        "Beside this page: cells.csv (every cell of every image), motion.csv (every image), deviations.csv, "
        "summary.json."
    )
    for result in results:
        page.facts(settings(result.summary), result.name if several else "")
    return page
