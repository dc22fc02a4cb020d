# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Report of visp-track-pattern: what was found, how the product moved, and how well that is known."""
import itertools
import math

import numpy as np

from .page import Page, counted, number
from .plots import Figure, colour, figure, legend_above, marks

STATUSES = {"Acquiring": "#f0a030", "Tracking": "#3fa34d", "Degraded": "#e6d13a", "Lost": "#c8322b"}
STATUSES_SAY = (
    "Acquiring: looking for the lattice, or learning what a cell looks like; cells are measured by their edges meanwhile. Tracking: all "
    "holds. Degraded: fewer cells than there should be, or restarted identities. Lost: nothing in that image is valid."
)
MANY = 400  # images: points become lines


@figure(1, 1.0)
def status_figure(axes, motion):
    """A bar for each stretch of one status."""
    statuses, begin = motion["status"], 0
    for status, stretch in itertools.groupby(statuses):
        count = len(list(stretch))
        axes.barh(0, count, left=begin, color=STATUSES[status], height=1)
        begin += count
    for status, shade in STATUSES.items():
        axes.barh(0, 0, color=shade, label=f"{status}: {statuses.count(status)}")
    ticks = np.unique(np.linspace(0, len(statuses) - 1, 6).astype(int))
    axes.set_xticks(ticks + 0.5, [f"{motion['frame'][k]:.0f}" for k in ticks])
    axes.grid(False)
    legend_above(axes, yticks=[], xlabel="image", xlim=(0, len(statuses)))


@figure(2, 1.7)
def motion_figure(panels, motion):
    style = "-" if len(motion["frame"]) > MANY else "."
    for i, (axes, axis) in enumerate(zip(panels, "xy")):
        if np.isfinite(motion[f"true_d{axis}"]).any():
            axes.plot(motion["frame"], motion[f"true_d{axis}"], color="#9aa5b1", label=f"true, {axis}")
        axes.plot(motion["frame"], motion[f"d{axis}"], style, color=colour(i), markersize=3, label=f"found, {axis}")
        legend_above(axes, ylabel=f"d{axis} (px)")
    panels[-1].set_xlabel("image")


@figure()
def error_figure(axes, motion):
    for i, axis in enumerate("xy"):
        error = np.array(motion[f"d{axis}"]) - np.array(motion[f"true_d{axis}"])
        axes.plot(motion["frame"], error, color=colour(i), linewidth=1, label=axis)
    legend_above(axes, xlabel="image", ylabel="found − true (px)")


@figure()
def sigma_figure(axes, motion):
    """After learning."""
    shown = np.array([status != "Acquiring" for status in motion["status"]])
    shown = shown if shown.any() else ~shown
    frame, *sigmas = (np.array(motion[key])[shown] for key in ("frame", "sigma_x", "sigma_dx", "sigma_y", "sigma_dy"))
    for i, axis in enumerate("xy"):
        axes.plot(frame, sigmas[2 * i], color=colour(i), label=f"a cell, {axis} (median)")
        axes.plot(frame, sigmas[2 * i + 1], "--", color=colour(i), linewidth=1, label=f"displacement, {axis}")
    legend_above(axes, xlabel="image", ylabel="standard deviation (px)", ylim=(0, None))


@figure()
def time_figure(axes, times):
    end = 1.2 * max(np.quantile(times, 0.98), 1e-3)
    axes.hist(times, bins=60, range=(0, end), color=colour(5), edgecolor=colour(0), linewidth=0.5, label="images")
    marks(axes, [np.median(times)], f"median {number(float(np.median(times)))} µs")
    legend_above(axes, xlabel="time of the tracker (µs)", ylabel="images", xlim=(0, end))


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
        arrows = np.stack([places, ends, np.full_like(ends, np.nan)], axis=1).reshape(-1, 2)
        axes.plot(*arrows.T, color=colour(0), linewidth=0.8)
        label = f"cells, deviations {number(float(factor))} times as long"
        axes.plot(*ends.T, ".", color=colour(0), markersize=4, label=label)
        sample = round_below(np.ptp(places[:, 0]) / 8 / factor) if np.ptp(places[:, 0]) > 0 else 0
        if sample > 0:  # below the map
            x, y = places[:, 0].min(), places[:, 1].max() + 0.08 * np.ptp(places, axis=0).max()
            axes.plot([x, x + factor * sample], [y, y], color="#000000", linewidth=2, label=f"{number(float(sample))} px")
        axes.set_aspect("equal", "datalim")
        axes.invert_yaxis()
        legend_above(axes, xlabel="along the rows (px)", ylabel="across (px)")

    width, height = np.maximum(np.ptp(places, axis=0), 1)
    return Figure(draw, 1, float(np.clip(8 * height / width + 1, 2, 5)))


ERRORS = [
    "status = name; centres = x.number; mean x (px) = x.mean_px; mean y = y.mean_px; sigma x (px) = x.sigma_px; sigma y = y.sigma_px; "
    "error / reported sigma, x = x.rms_over_told_sigma; y = y.rms_over_told_sigma",
    ("displacements", lambda errors: (errors["dx"] or {}).get("number", 0)),
    "sigma x (px) = dx.sigma_px; sigma y = dy.sigma_px; 2 px off = two_px_off; no cell there = no_cell_there; other name = other_name",
]


def add_accuracy(page, result, motion):
    errors = result.summary.get("errors", {})
    errors = [{"name": name.capitalize(), **errors[name]} for name in errors if errors[name]["x"]]
    if errors or np.isfinite(motion["sigma_x"]).any():
        page.section("Accuracy")
    if errors:
        page.records(
            errors,
            ERRORS,
            "Found against true. The errors over the standard deviations that the tracker reports are 1 (rms) when these are right. 2 px "
            "off: centres that are not in the other figures; no cell there: where there is none; other name: cells that had another row "
            "and column before.",
        )
    if np.isfinite(motion["sigma_x"]).any():
        page.figure(
            sigma_figure(motion).named(f"sigma-{result.name}", "Standard deviations per image"),
            "What the tracker expects its errors to be, from the noise of each image, after learning. It knows nothing of errors that all "
            "images share, such as those of the lens.",
        )


def add_result(page, result):
    summary, motion = result.summary, result.table("motion.csv")
    page.picture(
        result.bytes("picture.png"),
        "image/png",
        "An image with the cells that were found",
        "One of the images, enlarged. Green crosses: centres of cells that were measured. Red: cells that are there by the lattice but were "
        "not measured, because of dirt or because the pattern ends there.",
    )
    page.section("Status")
    page.figure(status_figure(motion).named(f"status-{result.name}", "Status of every image"), STATUSES_SAY)
    if np.isfinite(motion["dx"]).any():
        page.section("Motion")
        page.figure(
            motion_figure(motion).named(f"motion-{result.name}", "Displacement of every image"),
            "How far the product moved since the image before: x to the right, y down. A gap in the curve: not known, as where images are "
            "missing. Between two images it must move by less than half a pitch: more looks like less, and a multiple of the pitch cannot "
            "be seen.",
        )
        if "errors" in summary:
            page.figure(error_figure(motion).named(f"error-{result.name}", "Error of the displacement"), "The same, minus the truth.")
    add_accuracy(page, result, motion)
    deviations = deviation_map(result.table("deviations.csv"), summary["lattice"])
    if deviations:
        rms = [number(float(x)) for x in np.sqrt((deviations[1] ** 2).mean(axis=0))]
        page.section("How regular the product is")
        page.figure(
            map_figure(*deviations).named(f"deviations-{result.name}", "Map of the deviations from the lattice"),
            f"Where the {len(deviations[0])} cells lie off the regular lattice, as on the product, not turned. Root mean square: {rms[0]} px "
            f"along the rows, {rms[1]} px across.",
        )
    page.section("Time")
    page.figure(
        time_figure(motion["microseconds"]).named(f"time-{result.name}", "Histogram of the time per image"),
        "Time of the tracker alone, without reading and drawing, under the load that this machine had. The slow images are those in which it "
        "searches or learns; the two per cent that took longest may lie outside.",
    )


def settings(summary):
    roi, calibration = summary["roi"], summary.get("calibration")
    facts = [
        ("Command", summary["command"]),
        ("Input", summary["input"]),
        ("Image size", f"{summary['image']['width']} × {summary['image']['height']} px"),
        ("Method, threshold", f"{summary['method']}, {summary['threshold']}"),
    ]
    facts += [("Looked only at", f"{roi[2]} × {roi[3]} px from ({roi[0]}, {roi[1]})")] if roi else []
    if calibration is not None:
        facts.append(("Calibration", f"{calibration['file']}, {number(calibration['um_per_px'])} µm a pixel"))
    return facts


def page(results):
    first = results[0].summary
    ending = "" if first.get("status", "complete") == "complete" else f" ({first['status']})"
    size = f"{first['image']['width']} × {first['image']['height']} px"
    page = Page("Tracking of a repetitive product", f"{counted(first['images'], 'image')} of {size}, {first['input']}{ending}", results)
    for result in results:
        page.section("What was found", f"What was found by {result.name}")
        add_result(page, result)
        if result is results[0] and (result.folder / "overlay.mp4").is_file():
            page.section("All images")
            page.video("overlay.mp4", "The file overlay.mp4 beside this page.")
    page.section("What was asked for")
    page.paragraph("Beside this page: cells.csv (every cell of every image), motion.csv (every image), deviations.csv, summary.json.")
    for result in results:
        page.facts(settings(result.summary), page.name(result))
    return page
