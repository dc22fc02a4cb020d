# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Report of visp-print-pattern: where the drops landed, how the product moved, and the experiments of the thesis."""
import numpy as np

from .page import Page, counted, number
from .plots import COLOURS, figure, legend_above, marks

TOLERANCE = 10.0  # um, as in the thesis
FIRST_FRAMES = 160  # of the first velocity plot
SMALL = 0.3  # share of the tolerance below which it is not drawn: it would flatten the drops
CONTROLLERS = {"observer": "observer with preview control", "pid": "PID", "pid-ff": "PID with feedforward"}
SENSORS = {
    "image": "rendered pictures, measured by vpPatternTracker",
    "tracker": "true places with the errors of vpPatternTracker",
    "thesis": "true places with the errors of the thesis's sensor",
}
MOTION = ["frame", "row", "x", "y", "vx", "vy", "reference_x", "reference_vx", "measured_vx", "estimated_vx", "force", "cells", "dropped"]
IDENTIFIED = [
    ("mass", "mass"),
    ("viscous", "viscous friction, per px/frame"),
    ("coulomb", "Coulomb friction, px/frame²"),
    ("stiction", "stiction, px/frame²"),
]
EXPERIMENTS = [
    "figure; control = name; velocity error (px/frame) = rms_velocity_error; the thesis = thesis; ratio; at the centres (px/frame) = "
    "centre_velocity_error"
]


@figure()
def velocity_figure(axes, motion, rate, frames=None):
    t = np.array(motion["frame"][:frames]) / rate
    axes.plot(t, motion["measured_vx"][:frames], ".", color="#9ecae1", markersize=3, label="measured, before any filter")
    axes.plot(t, motion["vx"][:frames], color=COLOURS[1], label="true")
    axes.plot(t, motion["reference_vx"][:frames], "--", color="#000000", linewidth=1.1, label="reference")
    legend_above(axes, xlabel="time (s)", ylabel="velocity (px/frame)", xlim=(t[0], t[-1]))


@figure()
def landing_figure(axes, drops, worst):
    order = np.arange(1, len(drops["error_x_um"]) + 1)
    axes.plot(order, drops["error_x_um"], ".", color=COLOURS[0], label="along the row")
    axes.plot(order, drops["error_y_um"], ".", color=COLOURS[4], label="across")
    if worst >= SMALL * TOLERANCE:
        for limit, label in ((TOLERANCE, "tolerance"), (-TOLERANCE, None)):
            axes.axhline(limit, color=COLOURS[2], linestyle="--", linewidth=1, label=label)
    legend_above(axes, xlabel="drop", ylabel="landing place − centre (µm)")


@figure()
def histogram_figure(axes, errors):
    largest = max(errors, default=0)
    small = largest < SMALL * TOLERANCE
    top = 1.1 * largest + 0.01 if small else max(1.1 * TOLERANCE, largest)
    axes.hist(errors, bins=40, range=(0, top), color=COLOURS[5], edgecolor=COLOURS[0], linewidth=0.6, label="drops")
    if not small:
        marks(axes, [TOLERANCE], "tolerance")
    legend_above(axes, xlabel="distance from the centre of the cell (µm)", ylabel="drops", xlim=(0, top))


@figure()
def distortion_figure(axes, table):
    for i, share in enumerate(("1", "0.5", "0.2", "0.1")):
        axes.plot(table["distance_px"], table[f"mismatch_{share}_px"], color=COLOURS[i], label=f"{share} % at 200 px")
    axes.axvline(80, color="#999999", linewidth=0.9, label="edge of a 160 px image")
    legend_above(axes, 5, xlabel="distance from the middle of the image (px)", ylabel="mismatch (px)", xlim=(0, 200), ylim=(0, None))


def add_run(page, result):
    summary, spec, landing = result.summary, result.summary["spec"], result.summary["landing_error_um"]
    errors = {
        "velocity error as measured": "rms_velocity_error",
        "velocity error, true": "rms_true_velocity_error",
        "true velocity error at the centres": "centre_velocity_error",
    }
    page.table(
        ["", "rms (px/frame)"],
        [[text, summary[key]] for text, key in errors.items()],
        f"From frame {spec['evaluate_from_frame']} on. The first compares what the camera sees before any filter with the reference, "
        "as the thesis does.",
    )
    page.picture(
        result.bytes("product.png"),
        "image/png",
        "The product with the drops on it",
        "The printed product (first run): drops are circles of 50 µm, green within 10 µm of the centre, red beyond; the cross is the "
        "true centre of the cell.",
    )
    velocity = velocity_figure(result.table("motion.csv"), spec["frame_rate_hz"], FIRST_FRAMES)
    page.figure(
        velocity.named("velocity", "Reference, true and measured velocity of the product"),
        "The beginning of the first run. Slowest at the centres of the cells, where the drops land. The measured velocity is that of "
        "the last two frames that arrived, so it comes later than the true one.",
    )
    page.figure(
        landing_figure(result.table("drops.csv"), landing["max"]).named("landing", "Landing errors of the drops along and across the row"),
        "Each drop of the first run, in the order of landing. The tolerance of the thesis is 10 µm.",
    )
    errors = result.table("landing.csv")["error_um"]
    page.figure(
        histogram_figure(errors).named("landing-histogram", "Histogram of the landing errors"),
        f"{counted(len(errors), 'drop')} of all runs: median {number(landing['p50'])} µm, 99 % within {number(landing['p99'])} µm, "
        f"largest {number(landing['max'])} µm.",
    )
    if result.bytes("camera.mp4"):
        page.video("camera.mp4", "What the camera sees, 64 times slower than real; yellow marks: the nozzle.")


def add_identification(page, found):
    page.section("Mass and friction of the stage")
    page.table(
        ["", "found", "standard deviation", "true"],
        [[text, found[key]["found"], found[key]["sigma"], found[key]["true"]] for key, text in IDENTIFIED],
        f"{found['message']} From {found['frames']} frames of a force that swings with growing strength, open loop, watched by the camera; "
        "the run used what was found. The standard deviations know of noise only; smoothing leaves about 1 % of the mass. Stiction is "
        "what a fit of slow motion says, which is the hardest to see.",
    )


def add_thesis(page, result):
    experiments = result.summary["thesis"]
    page.section("The experiments of the thesis")
    page.records(
        experiments,
        EXPERIMENTS,
        "Root mean square over 8 seeds, as measured and before any filter. Stage and gains are one set that shows the thesis's figures: "
        "it was searched for, is not unique and not robust. Frames 60 to 119 count, in which the observer still learns how much the stage's "
        "friction has risen; over 40 cells its errors at the centres are half as large. With the thesis's sensor the measured error of any "
        "controller is mostly noise; what matters for a drop is the true velocity at the centre, in the last column.",
    )
    distortion = distortion_figure(result.table("thesis/figure-7.10.csv"))
    page.figure(
        distortion.named("figure-7.10", "Figure 7.10: mismatch of pixel locations for several radial distortions"),
        "Figure 7.10. It grows with the cube of the distance: 1 % at 200 px is 2 px there and 0.13 px at the edge of a 160 px image, 0.1 % is "
        "0.013 px there, less than the tracker's error of a cell. From the calibration's own model.",
    )
    page.picture(
        result.bytes("thesis/figure-7.11.png"),
        "image/png",
        "Threshold image and detected cells",
        "Figure 7.11: on the left the image after Otsu's threshold, on the right boxes and centres that algorithm 7.4 finds, as printed; "
        "crosses are the true centres. Its centres are half a pixel to the right.",
    )
    for i, e in enumerate(experiments):
        title = f"Figure {e['figure']}: {e['name']}" if e["figure"] else e["name"]
        speed = e["rms_velocity_error"] * e["mm_per_px"] * e["frame_rate_hz"]
        drawn = velocity_figure(result.table(e["file"], MOTION), e["frame_rate_hz"])
        page.figure(
            drawn.named(f"figure-{e['figure']}" if e["figure"] else f"run-{i + 1}", title),
            f"{title}. Velocity error from frame {e['evaluate_from_frame']} on, rms of {e['seeds']} runs: "
            f"{number(e['rms_velocity_error'])} px/frame = {number(speed)} mm/s as measured"
            + (f", {number(e['thesis'])} px/frame in the thesis" if "thesis" in e else "")
            + f"; at the centres of the cells {number(e['centre_velocity_error'])} px/frame. The first run is drawn.",
        )


def settings(summary):
    spec = summary["spec"]
    return [
        ("controller", CONTROLLERS.get(spec["controller"], spec["controller"])),
        ("sensor", SENSORS[spec["sensor"]]),
        ("reference", f"{spec['reference']}, {number(spec['drop_velocity_px_per_frame'])} px/frame at the centres"),
        ("trigger", "on a horizon, each cell once" if spec["trigger"] == "horizon" else "algorithm 7.5 as printed"),
        ("cells", f"{spec['rows']} × {spec['cells_per_row']}, pitch {' × '.join(map(number, spec['pitch_px']))} px"),
        ("flexible pitch", f"{number(spec['flex_px'])} px over {number(spec['flex_period_cells'])} cells"),
        (
            "camera",
            f"{number(spec['frame_rate_hz'])} frames a second, {number(spec['vision_delay_frames'])} frames late, noise {number(spec['noise'])}",
        ),
        ("runs", summary["runs"]),
        ("command", summary["command"]),
    ]


def page(results):
    page = Page("Printing on the fly", "Drops on a moving, flexible product, with the camera as the only encoder.", results)
    for result in results:
        page.section("The result", result)
        add_run(page, result)
        if "identification" in result.summary:
            add_identification(page, result.summary["identification"])
        if "thesis" in result.summary:
            add_thesis(page, result)
    page.section("What to know")
    page.items(
        "Stage, product, camera and drops are simulated; a drop flies straight and takes the same time always.",
        "The stage's friction is known to the observer but for the 30 % more beyond the fifth cell, which it estimates.",
        "The throughput counts from the first drop to the last and includes turning between rows.",
    )
    page.section("What was run")
    page.paragraph(
        "A product with repeated cells moves under a camera and a nozzle. There is no other encoder than the cells: each frame gives "
        "their places, the motion follows from it, and a drop is fired into each cell on the fly. Everything is simulated: the "
        "pictures are rendered, the stage has friction, stiction, lag and delay."
    )
    for result in results:
        page.facts(settings(result.summary), page.name(result))
    return page
