# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""A result of visp-servo-compare with its laws, plants, measures and seeds, and what follows from it in sentences."""
import math
import statistics

from .page import number
from .plots import colour

# Name, colour and rotation gain of each law, near the goal and times the given one.
AS_GIVEN, DOUBLE, INTEGRAL, OWN = "×1", "×2", "×2, integral", "its own"
LOOKS = {
    "pbvs1": ("#1f77b4", AS_GIVEN),
    "pbvs1-rot2": ("#0b3c6f", DOUBLE),
    "pbvs2": ("#17becf", AS_GIVEN),
    "ibvs": ("#8c564b", AS_GIVEN),
    "hybrid25d": ("#7f7f7f", AS_GIVEN),
    "kyrki": ("#ff7f0e", AS_GIVEN),
    "kyrki-rot2": ("#a84300", DOUBLE),
    "kyrki-decoupled": ("#d4ac0d", AS_GIVEN),
    "ff-sum": ("#2ca02c", DOUBLE),
    "ff-lookat": ("#d62728", DOUBLE),
    "ff-lookat-pi": ("#9467bd", INTEGRAL),
    "dtg": ("#e377c2", INTEGRAL),
    "ff-dtg": ("#bcbd22", INTEGRAL),
}
ARRIVED = 0.2  # deg, at the end of every segment
FEW = 5  # distinguishable curves


def listed(items):
    """ "a, b and c"."""
    items = list(items)
    return ", ".join(items[:-1]) + (" and " if len(items) > 1 else "") + items[-1] if items else ""


def is_filtered(law):
    return law.endswith("+cbf")


def shown(value):
    """As it is displayed."""
    return float(f"{value:.3g}")


class Comparison:
    """Runs by law, plant (a name), measure and seed. A metric is a field of summary.json's runs."""

    def __init__(self, result):
        self.result, self.summary = result, result.summary
        self.laws = [law["id"] for law in self.summary["laws"]]
        self.plants = {plant["name"]: plant for plant in self.summary["plants"]}
        self.easy, self.hard = list(self.plants)[0], list(self.plants)[-1]
        self._own = [law for law in map(lambda law: law.removesuffix("+cbf"), self.laws) if law not in LOOKS]
        self.measures = [m for m in ("points", "image") if any(run["measure"] == m for run in self.summary["runs"])]
        self.measure = self.measures[0]
        self.segments = self.summary["task"]["segments"]
        self.ideal_yaw = self.summary["runs"][0]["ideal_yaw_range_deg"]  # depends only on the task
        self.on_arm = "robot" in self.summary
        self.shaped = "shape" in self.summary
        self._logs = {}

    def look(self, law):
        """Colour and gain."""
        base = law.removesuffix("+cbf")
        return LOOKS.get(base, (colour(self._own.index(base)) if base in self._own else "", OWN))

    def runs(self, law, plant, measure=None, shaped=False):
        wanted = (law, plant, measure or self.measure, shaped)
        return [run for run in self.summary["runs"] if tuple(run[k] for k in ("law", "plant", "measure", "shaped")) == wanted]

    def values(self, law, plant, metric, measure=None, shaped=False):
        """Of each seed; infinite where it is not known."""
        return [math.inf if run[metric] is None else run[metric] for run in self.runs(law, plant, measure, shaped)]

    def median(self, law, plant, metric, measure=None, shaped=False):
        """None without runs."""
        values = self.values(law, plant, metric, measure, shaped)
        return statistics.median(values) if values else None

    def log(self, law, plant, shaped=False):
        """Log of the first seed by the main measure; None without a run."""
        runs = self.runs(law, plant, shaped=shaped)
        if runs and runs[0]["log"] not in self._logs:
            self._logs[runs[0]["log"]] = self.result.table(runs[0]["log"])
        return self._logs[runs[0]["log"]] if runs else None

    def preferred(self, *laws):
        """Those of the laws that were run; where they are too few, the first few that were."""
        chosen = [law for law in laws if law in self.laws]
        return chosen if len(chosen) >= 2 and len(self.laws) > FEW else self.laws[:FEW]

    def plant_name(self, plant):
        friction = self.plants[plant]["deadband_radps"]
        times = "" if abs(friction - 0.1) < 1e-9 else f"{number(friction / 0.1)} times "  # of the file, see lab/servo/vpServoArm.h
        note = f"{times}the joint friction" if self.on_arm else f"friction {number(friction)} rad/s"
        return f"plant {plant} ({note})" if friction > 0 else f"plant {plant}"

    def per_law(self, laws, plant, metric):
        return listed(f"{law} {number(self.median(law, plant, metric))}" for law in laws if self.runs(law, plant))


class Medians:
    """The metrics of the sentences, of one law on one plant."""

    def __init__(self, c, law, plant, measure=None):
        self.law, self.c = law, c
        metrics = ("end_rotation_deg", "yaw_range_deg", "rms_image_error_px", "out_of_view_s")
        self.rotation, self.yaw, self.rms, self.out = (c.median(law, plant, metric, measure) for metric in metrics)

    def __bool__(self):
        return self.rotation is not None

    def with_rotation(self):
        return f"{self.law} ({number(self.rotation)}°)"

    def turning(self):
        return (
            f"{self.law} turns over {number(self.yaw)}° of {number(self.c.ideal_yaw)}° with {number(self.rms)} px rms image error and "
            f"ends {number(self.rotation)}° off"
        )

    def ties(self, other):
        """Practically equal: 2 deg of yaw, 2 px or a tenth of the image error, half a degree at the end."""
        return (
            abs(self.yaw - other.yaw) < 2
            and abs(self.rms - other.rms) < max(2, 0.1 * max(self.rms, other.rms))
            and abs(self.rotation - other.rotation) < 0.5
        )


def arrival(c):
    laws = sorted((m for m in (Medians(c, law, c.hard) for law in c.laws) if m), key=lambda m: m.rotation)
    arrived = [m for m in laws if m.rotation <= ARRIVED]
    where, goal, count = f"On {c.plant_name(c.hard)}, ", f" within {ARRIVED}° of every goal", len(laws)
    names = listed(m.with_rotation() for m in arrived)
    if not arrived:
        return f"{where}none of the {count} laws ends{goal}; the closest is {laws[0].with_rotation()}."
    if len(arrived) == count:
        return f"{where}{'the law ends' if count == 1 else f'all {count} laws end'}{goal}: {names}."
    some = "only 1" if len(arrived) == 1 else str(len(arrived))
    ends = "ends" if len(arrived) == 1 else "end"
    return f"{where}{some} of {count} laws {ends}{goal}: {names}; the next is {laws[len(arrived)].with_rotation()}."


def matched_rival(c):
    """ff-lookat and kyrki-rot2, at the same gain."""
    feedforward, rival, integral = (Medians(c, law, c.hard) for law in ("ff-lookat", "kyrki-rot2", "ff-lookat-pi"))
    if not feedforward or not rival:
        return None
    head = "At equal rotation gain and without integral, ff-lookat and kyrki-rot2"
    numbers = f"on {c.plant_name(c.hard)}: {feedforward.turning()}, {rival.turning()}"
    if not feedforward.ties(rival):
        return f"{head} differ {numbers}."
    better = bool(integral) and integral.rotation < 0.5 * min(feedforward.rotation, rival.rotation)
    cause = ", but the integral of ff-lookat-pi does" if better else ""
    return f"{head} tie {numbers}; at equal gain the form of the law makes no difference there{cause}."


def benefit(c):
    """The rotation gain can rise without the object leaving its image position."""
    errors = [c.median(law, c.easy, "max_image_error_px") for law in ("pbvs1-rot2", "ff-lookat")]
    if None in errors:
        return None
    return (
        f"The doubled rotation gain moves the object in the image by up to {number(errors[0])} px with pbvs1-rot2 and by up to "
        f"{number(errors[1])} px with ff-lookat on {c.plant_name(c.easy)}."
    )


def thesis_order(c):
    """The statement of the thesis, tested against the laws that it compares with."""
    own, pbvs, kyrki = (Medians(c, law, c.hard) for law in ("ff-sum", "pbvs1", "kyrki-decoupled"))
    if not (own and pbvs and kyrki):
        return None
    holds = all(own.yaw >= m.yaw and own.rms <= m.rms and own.out <= m.out and own.rotation <= m.rotation for m in (pbvs, kyrki))
    return (
        "The order of the thesis (its law at least as good as PBVS and Kyrki, figures 5.8 to 5.10) "
        f"{'holds' if holds else 'does not hold in all figures'} on {c.plant_name(c.hard)} against the rivals of the thesis: "
        f"{own.turning()}, {pbvs.turning()}, {kyrki.turning()}. These rivals have half its effective rotation gain; compare those of "
        f"gain {DOUBLE} in the table."
    )


def losing(c, laws):
    """Those that lose a corner on the hardest plant, and how long."""
    return [f"{m.law} ({number(m.out)} s)" for m in (Medians(c, law, c.hard) for law in laws) if m and m.out > 0]


def out_of_view(c):
    where, lost = f" on {c.plant_name(c.hard)}", losing(c, c.laws)
    if not lost:
        return f"No law lets a corner of the object leave the image{where}."
    return f"A corner of the object leaves the image{where} with {listed(lost)}."


def filter_against_friction(c):
    """The view filter's guarantee holds only for a robot that executes its commands exactly."""
    lost = losing(c, filter(is_filtered, c.laws))
    return lost and (
        f"The view filter takes the robot's obedience for granted; on {c.plant_name(c.hard)}, which does not execute all that is "
        f"commanded, a corner is lost in spite of it: {listed(lost)}."
    )


def image_against_points(c):
    pairs = []
    for law in c.laws:
        points, image = (Medians(c, law, c.hard, measure) for measure in ("points", "image"))
        if points and image:
            pairs.append(
                f"{law} {number(image.rotation)}° instead of {number(points.rotation)}° and {number(image.rms)} instead of "
                f"{number(points.rms)} px rms"
            )
    return pairs and (
        f"Measured in rendered views instead of by noisy points, the laws end on {c.plant_name(c.hard)} with: {listed(pairs)}."
    )


def unfinished(c):
    ended = []
    for run in c.summary["runs"]:
        arm = run.get("arm", {})
        status = arm["status"] if "missing_torque" in arm and arm["status"] != "ok" else run["status"]
        if status != "ok":
            shaped = ", shaped" if run["shaped"] else ""
            ended.append(f"{run['law']} on {run['plant']} by {run['measure']}{shaped} (seed {run['seed']}): {status}")
    return ended and f"Runs that did not end well: {listed(ended[:5])}" + (f" and {len(ended) - 5} more." if len(ended) > 5 else ".")


def answers(c):
    """One or two sentences: laws that arrive, and what differs at equal gain."""
    return [sentence for sentence in (arrival(c), matched_rival(c)) if sentence]


def findings(c):
    makers = (benefit, thesis_order, out_of_view, filter_against_friction, image_against_points, unfinished)
    return [sentence for sentence in (make(c) for make in makers) if sentence]
