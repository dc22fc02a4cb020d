# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Report of visp-plan-trajectory: each motion with its limits, goals, events, and the plans that were replaced."""
import numpy as np

from .page import Page, counted, number
from .plots import colour, figure, legend_above, logarithmic_if_flat, marks

DERIVATIVES = ("position (unit)", "velocity (unit/s)", "acceleration (unit/s²)", "jerk (unit/s³)")
LIMITS = (("min_position", "max_position"), ("max_velocity",), ("max_acceleration",), ("max_jerk",))
MOST_FIGURES = 20


def curve(segments, axis, derivative, end=None):
    """Times and values; a jump between two polynomials stays a jump. end: nothing before it, for a plan that was replaced."""
    times, values = [], []
    for segment in segments:
        p = np.polynomial.Polynomial(segment["coefficients"][axis])
        t = np.linspace(0, segment["duration_s"], 120)
        t = t if end is None else t[t + segment["t0_s"] >= end]
        times.append(segment["t0_s"] + t)
        values.append((p.deriv(derivative) if derivative else p)(t))
    return (np.concatenate(times), np.concatenate(values)) if times else (np.zeros(0), np.zeros(0))


def steps(inputs, value):
    """A value that is constant between events."""
    times, values = [], []
    for given in inputs:
        times += [given["begin_s"], given["end_s"]]
        values += [np.nan if value(given) is None else value(given)] * 2
    return times, values


def draw_limits(axes, motion, derivative):
    """Dashed; in black where all axes have the same."""
    count = len(motion["inputs"][0]["goal"])
    same = all(len(set(given[name])) == 1 for given in motion["inputs"] for name in LIMITS[derivative])
    label = "limit"
    for axis in range(1 if same else count):
        for sign, name in ((1, LIMITS[derivative][-1]), (1 if derivative == 0 else -1, LIMITS[derivative][0])):
            limit = lambda given: None if given[name][axis] is None else sign * given[name][axis]  # noqa: E731
            times, values = steps(motion["inputs"], limit)
            if np.isfinite(np.asarray(values, float)).any():
                axes.plot(times, values, "--", color="#333333" if same else colour(axis), linewidth=1, label=label)
                label = None


def draw_goals(axes, motion):
    """Goals and vias."""
    for axis in range(len(motion["inputs"][0]["goal"])):
        goal, label = steps(motion["inputs"], lambda given: given["goal"][axis]), "goal" if axis == 0 else None
        axes.plot(*goal, ":", color=colour(axis), linewidth=1.2, label=label)
        for i, via in enumerate(motion["vias"]):
            label = "via" if axis == i == 0 else None
            axes.plot([via["t_s"]], [via["q"][axis]], "o", color=colour(axis), markersize=4, label=label)


@figure(4, 1.7)
def motion_figure(panels, motion):
    count = len(motion["inputs"][0]["goal"])
    for derivative, axes in enumerate(panels):
        for axis in range(count):
            for i, former in enumerate(motion["former"]):
                label = "without the event" if axis == i == 0 else None
                replaced = curve(former["segments"], axis, derivative, former["end_s"])
                axes.plot(*replaced, color=colour(axis), linewidth=0.7, alpha=0.7, label=label)
        drawn = []
        for axis in range(count):
            times, values = curve(motion["segments"], axis, derivative)
            if not len(times):  # already at the goal
                times, values = [0, 1e-3], [motion["inputs"][-1]["goal"][axis] if derivative == 0 else 0] * 2
            axes.plot(times, values, color=colour(axis), label="executed" if count == 1 else f"axis {axis}")
            drawn.append(values)
        draw_limits(axes, motion, derivative)
        if derivative == 0:
            draw_goals(axes, motion)
        if derivative == 3:
            logarithmic_if_flat(axes, *drawn)
        marks(axes, motion["events_s"], "event" if derivative == 0 else None)
        axes.set_ylabel(DERIVATIVES[derivative])
    panels[0].set_xlim(0, max([motion["duration_s"], 1e-3, *motion["events_s"]]))
    panels[-1].set_xlabel("time (s)")
    legend_above(panels[0], 5)


def title_of(motion):
    return motion["place"] if motion["id"] is None else str(motion["id"])


def record_of(result, motion):
    """For COLUMNS; peaks are the largest over the axes."""
    names = ("velocity", "acceleration", "jerk")
    peaks = {name: max((peaks[name] for peaks in motion["peaks"]), default=0.0) for name in names}
    return {**motion, "result": result.name, "motion": title_of(motion), "peaks": peaks}


COLUMNS = [
    "result",
    "motion; duration (s) = duration_s; form; largest velocity (unit/s) = peaks.velocity; acceleration (unit/s²) = peaks.acceleration; "
    "jerk (unit/s³) = peaks.jerk; status",
]


def page(results):
    motions = [(result, motion) for result in results for motion in result.json("motions.json")]
    page = Page("Motions", "Direct trajectory generation: the fastest minimum-jerk motions within the limits.", results)
    count = sum(result.summary["problems"] for result in results)
    refused = sum(result.summary["refused"] for result in results)
    page.answers(f"{counted(count - refused, 'motion')} planned" + (f", {counted(refused, 'problem')} of {count} refused." if refused else "."))
    for result in results:
        if result.summary["refused"]:
            page.answers(f"{result.name}: the first refusal: {result.summary['first_refusal']}")
    if len(motions) == 1:
        page.answers(f"It takes {number(motions[0][1]['duration_s'])} s. {motions[0][1]['message']}")
    page.section("All motions")
    says = "Largest values are of the axis where they are largest, exact. A click on a heading sorts."
    page.records([record_of(*each) for each in motions], COLUMNS if page.several else COLUMNS[1:], says)
    for i, (result, motion) in enumerate(motions[:MOST_FIGURES]):
        page.section(title_of(motion), f"{result.name}: {title_of(motion)}")
        if motion["message"]:
            page.paragraph(motion["message"])
        page.figure(
            motion_figure(motion).named(f"motion-{i + 1}", f"Position, velocity, acceleration and jerk of {title_of(motion)}"),
            "Dashed: limits; dotted: goal; grey lines: events; thin: how a plan would have gone on without the next event."
            if motion["events_s"]
            else "Dashed: limits; dotted: goal; dots: vias.",
        )
    page.section("How it was made")
    if len(motions) > MOST_FIGURES:
        page.paragraph(f"The first {MOST_FIGURES} of {len(motions)} motions have a figure.")
    page.facts([(result.name, f"{result.summary['command']} (version {result.summary['version']})") for result in results])
    return page
