# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""visp-servo-compare --shape: every run raw and with a shaped command. What shaping brings and costs, and figure 6.1 of the thesis."""
import itertools
import math

import numpy as np

from .page import number
from .plots import Figure, legend_above
from .servo_figures import RAW, SHAPED, column
from .servo_laws import is_filtered, listed, shown

BEFORE, AFTER, HEADROOM = 0.1, 1.0, 2.5  # of figure 6.1: s around the start; range in limits, which the raw step exceeds by far
JUMPS = "Raw, the speed jumps within one cycle and then decays, as in the thesis; shaped, it rises along a ramp and joins the decay. "
STEP = [
    ("m/s²", "peak_linear_acceleration_mps2"),
    ("rad/s²", "peak_angular_acceleration_radps2"),
    ("max (px)", "max_image_error_px"),
    ("end (°)", "end_rotation_deg"),
    ("end (mm)", "end_translation_mm"),
    ("settle (s)", "settle_s"),
    ("out (s)", "out_of_view_s"),
]


def _rise(c, plant, metric, what, unit):
    """The law whose metric rises most by shaping."""
    pairs = [(law, c.median(law, plant, metric), c.median(law, plant, metric, shaped=True)) for law in c.laws]
    law, raw, shaped = max((pair for pair in pairs if pair[1] is not None), key=lambda pair: pair[2] - pair[1])
    if shown(raw) >= shown(shaped):
        return f"{what} rises with no law"
    return f"{what} rises most with {law}, from {number(raw)} to {number(shaped)}{unit}"


def cost(c, plant):
    metrics = [
        ("max_image_error_px", "the largest image error", " px"),
        ("end_rotation_deg", "the rotation error at the end", "°"),
        ("settle_s", "the time to settle", " s"),
        ("out_of_view_s", "the time out of view", " s"),
    ]
    return f"What it costs on plant {plant}: " + "; ".join(_rise(c, plant, *metric) for metric in metrics) + "."


def filter_behind_shaper(c):
    """The filter assumes that its twist is executed at once, which is not the case behind a shaper."""
    lost = []
    for law in filter(is_filtered, c.laws):
        for plant in c.plants:
            raw, shaped = (c.median(law, plant, "out_of_view_s", shaped=is_shaped) for is_shaped in (False, True))
            if raw is not None and shaped > raw:
                lost.append(f"{law} on plant {plant} ({number(raw)} s raw, {number(shaped)} s shaped)")
    return any(map(is_filtered, c.laws)) and (
        "The view filter comes before the shaper and relies on its twist being executed at once; shaped, it promises nothing. "
        + (f"Longer out of view for that: {listed(lost)}." if lost else "In these runs no filtered law is longer out of view for that.")
    )


def step_findings(c):
    """Benefit and cost of shaping."""
    metrics = ("peak_linear_acceleration_mps2", "peak_angular_acceleration_radps2")
    each = ([run for run in c.summary["runs"] if run["shaped"] == is_shaped] for is_shaped in (False, True))
    raw, shaped = ([number(max((run[metric] for run in runs), default=0.0)) for metric in metrics] for runs in each)
    sentences = [
        f"Over all laws and plants the command asks for accelerations of up to {raw[0]} m/s² and {raw[1]} rad/s² raw, and of up to "
        f"{shaped[0]} m/s² and {shaped[1]} rad/s² shaped.",
        cost(c, c.easy),
        c.hard != c.easy and cost(c, c.hard),
        filter_behind_shaper(c),
        "Translation and rotation ramp up apart. Where one of the two is shaped longer than the other, the object swings in the image "
        "meanwhile; angular limits of about 1 / Z times the linear ones (Z: distance of the object in m) keep that small.",
    ]
    return [sentence for sentence in sentences if sentence]


class Start:
    """The first second of a run: speeds and accelerations of the command."""

    def __init__(self, log, cycle, kind, unit):
        v = np.array([column(log, f"commanded_{kind}{axis}_{unit}") for axis in "xyz"])
        self.t, self.cycle = column(log, "time_s"), cycle
        self.speed = np.linalg.norm(v, axis=0)
        self.acceleration = np.linalg.norm(np.diff(v, axis=1, prepend=0), axis=0) / cycle

    def begin(self):
        moving = np.flatnonzero(self.speed > 0)
        return self.t[moving[0]] if len(moving) else math.inf


def add_step(page, c):
    law = "pbvs1" if "pbvs1" in c.laws else c.laws[0]
    plant, limits = c.plants[c.easy], c.summary["shape"]
    logs, cycle = [c.log(law, c.easy, shaped) for shaped in (False, True)], 1 / plant["loop_rate_hz"]
    parts = [
        ("linear", "m/s", "m/s²", limits["linear_acceleration_mps2"], [Start(log, cycle, "v", "mps") for log in logs]),
        ("angular", "rad/s", "rad/s²", limits["angular_acceleration_radps2"], [Start(log, cycle, "w", "radps") for log in logs]),
    ]
    begin = min(min(starts[0].begin() for *_, starts in parts), logs[0]["time_s"][-1])
    largest = [[float(start.acceleration[start.t <= begin + AFTER].max()) for start in starts] for *_, starts in parts]

    def draw(panels):
        for (speed_axes, axes), (name, unit, per, limit, starts), peaks in zip((panels[:2], panels[2:]), parts, largest):
            for start, paint, label in zip(starts, (RAW, SHAPED), ("raw", "shaped")):
                t = np.concatenate([[begin - BEFORE, -start.cycle], start.t])
                speed_axes.step(t, np.concatenate([[0, 0], start.speed]), where="post", color=paint, label=label)
                axes.plot(t, np.concatenate([[0, 0], np.minimum(start.acceleration, HEADROOM * limit)]), color=paint, label=label)
            axes.axhline(limit, color="#555555", linestyle=":", label="limit")
            if peaks[0] > HEADROOM * limit:
                text = f"raw: up to {number(peaks[0])} {per}, far off the scale"
                axes.annotate(text, (begin, HEADROOM * limit), xytext=(6, -8), textcoords="offset points", fontsize=8)
            speed_axes.set(ylabel=f"{name} speed ({unit})", ylim=(0, None))
            axes.set(ylabel=f"acceleration ({per})", ylim=(0, None))
        panels[-1].set(xlabel="time (s)", xlim=(begin - BEFORE, begin + AFTER))
        legend_above(panels[0])
        legend_above(panels[1])

    jumps = largest[0][0] > 2 * parts[0][3]
    page.figure(
        Figure(draw, 4, 1.6).named("figure-6.1", f"What {law} commands in its first second on plant {c.easy}"),
        f"Figure 6.1, its first second: what {law} commands on plant {c.easy}. "
        + (JUMPS if jumps else "")
        + f"In this second the raw command asks for accelerations of up to {number(largest[0][0])} m/s² and {number(largest[1][0])} rad/s² at "
        f"{number(plant['loop_rate_hz'])} cycles a second (a jump counts for twice as much at twice as many), the shaped one for up to "
        f"{number(largest[0][1])} m/s² and {number(largest[1][1])} rad/s².",
    )


def add_shaped(page, c):
    limits = c.summary["shape"]
    page.paragraph(
        "A servo law answers an error with a velocity in proportion to it. At t = 0, and whenever the goal changes, the robot is asked to "
        "jump to that velocity within one cycle; section 6.1.1 of the thesis calls it an infinite acceleration. A shaper (vpTwistShaper) "
        f"behind any law makes a ramp of the jump. Here its limits are {number(limits['linear_acceleration_mps2'])} m/s² and "
        f"{number(limits['angular_acceleration_radps2'])} rad/s², with a jerk of at most {number(limits['linear_jerk_mps3'])} m/s³ and "
        f"{number(limits['angular_jerk_radps3'])} rad/s³. Every run was made twice, with the law's own twist (raw) and with the shaper "
        "(shaped). Only this section describes the shaped runs."
    )
    page.items(*step_findings(c))
    add_step(page, c)
    rows = []
    for measure, plant, law in itertools.product(c.measures, c.plants, c.laws):
        if c.runs(law, plant, measure):
            pairs = [c.median(law, plant, metric, measure, is_shaped) for _, metric in STEP for is_shaped in (False, True)]
            rows.append([law, plant, *([measure] if len(c.measures) > 1 else []), *pairs])
    page.table(
        [
            "law",
            "plant",
            *(["measure"] if len(c.measures) > 1 else []),
            *(f"{title} {kind}" for title, _ in STEP for kind in ("raw", "shaped")),
        ],
        rows,
        "Raw and shaped. m/s², rad/s²: largest change of the commanded twist from one cycle to the next, divided by the cycle; the others "
        "as in the tables above." + (" Medians over the seeds." if c.summary["repetitions"] > 1 else ""),
    )
