# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of an arm among obstacles, as visp-avoid-obstacle and visp-plan-compare log them: in 3D, over time, and in their planes."""
import numpy as np

from . import view3d
from .plots import figure, legend_above

VIEW_STEP, PLOT_POINTS = 0.04, 500  # s, of the 3D view; of a curve
CUT, FAR = 3.0, 300.0  # accelerations, in units of their bound, and clearances, mm: larger ones are drawn there
CUT_SAYS = "Accelerations above three times the bound and clearances above 300 mm are drawn there."
CLEARANCE_SAYS = "The clearance is the least of all pairs of parts that must not touch, the arm's own among them."


def joints_of(table, arm):
    """n x joints."""
    return np.stack([table[f"q_{joint['name']}"] for joint in arm["joints"]], axis=1)


def places_of(table, what="tool"):
    return np.stack([table[f"{what}_{axis}_m"] for axis in "xyz"], axis=1)


def states_of(table):
    """[[time, status], ...] at each change."""
    states = []
    for t, status, stopping in zip(table["time_s"], table["status"], table["stopping"]):
        text = ("protective stop, " if stopping else "") + status
        if not states or states[-1][1] != text:
            states.append([round(t, 3), text])
    return states


def run_of(table, arm, name, colour, index=0, shift=None):
    """A run for the 3D view."""
    t, q = np.array(table["time_s"]), joints_of(table, arm)
    step = max(1, round(VIEW_STEP / max(np.median(np.diff(t)), 1e-6))) if len(t) > 1 else 1
    kept = np.unique(np.append(np.arange(0, len(t), step), len(t) - 1))
    base = {} if shift is None else {"base": view3d.base_at(shift)}
    moves = {"t": t[kept].round(4).tolist(), "q": q[kept].round(4).tolist(), "states": states_of(table)}
    return {"name": name, "colour": colour, "arm": index} | moves | base


def marks_of(table, shift=None):
    """Start and goal as balls; the goal moves as it did."""
    start, goals, t = places_of(table)[0], places_of(table, "goal"), np.array(table["time_s"])
    kept = np.unique(np.linspace(0, len(t) - 1, min(200, len(t))).round().astype(int))
    moves = {"t": t[kept].tolist(), "p": goals[kept].round(5).tolist()} if np.ptp(goals, axis=0).max() > 1e-9 else None
    balls = view3d.ball(start, 0.012, "#888888"), view3d.ball(goals[0], 0.016, "#111111", moves)
    return [view3d.shifted(ball, shift) for ball in balls]


def room_of(tables, objects):
    """How far apart two of them stand side by side, m."""
    reaches = [np.linalg.norm(places_of(table), axis=1).max() for table in tables]
    reaches += [np.linalg.norm([row[3] for row in item["pose"][:3]]) for item in objects if item["kind"] != "mesh"]
    return 1.6 * max([0.5, *reaches])


def thinned(t, y, keep=np.max):
    """Curves of many points: the largest (or least) of each group, so that no peak is lost."""
    t, y = np.asarray(t, float), np.asarray(y, float)
    group = -(-len(t) // PLOT_POINTS)
    if group < 2:
        return t, y
    parts = range(0, len(t), group)
    return t[::group], np.array([keep(y[i : i + group]) for i in parts])


def level(axes, value, label):
    axes.axhline(value, color="#333333", linestyle="--", linewidth=1, label=label)


@figure(4, 1.6)
def times_figure(panels, curves, limits):
    """Speed, acceleration, clearance and distance from the goal. curves: (label, colour, table, speed, acceleration). limits: v, a."""
    for label, colour, table, speed, acceleration in curves:
        t = table["time_s"]
        panels[0].plot(*thinned(t, speed), color=colour, label=label)
        panels[1].plot(*thinned(t, np.minimum(acceleration, CUT * limits[1])), color=colour)
        panels[2].plot(*thinned(t, np.minimum(1000 * np.array(table["clearance_m"]), FAR), np.min), color=colour)
        panels[3].plot(*thinned(t, 1000 * np.array(table["goal_distance_m"])), color=colour)
    for axes, value, label in zip(panels, (*limits, 0), ("bound", None, None)):
        level(axes, value, label)
    for axes, name in zip(panels, ("tool (m/s)", "tool (m/s²)", "clearance (mm)", "to goal (mm)")):
        axes.set_ylabel(name)
    panels[-1].set_xlabel("time (s)")
    legend_above(panels[0])


def hull(points):
    """Convex hull of points in a plane, anticlockwise."""
    points = sorted(set(map(tuple, np.asarray(points).round(9).tolist())))

    def turn(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    def half(ordered):
        chain = []
        for p in ordered:
            while len(chain) > 1 and turn(chain[-2], chain[-1], p) <= 0:
                chain.pop()
            chain.append(p)
        return chain[:-1]

    return np.array(half(points) + half(points[::-1])) if len(points) > 2 else np.array(points)


def outlines(item, axes, folder):
    """Polygons that together are the view of an obstacle of scene.json along an axis. axes: the two that stay, (0, 1) from above."""
    turn = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    circle = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    pose = np.array(item["pose"], float)

    def project(points):
        return (np.asarray(points) @ pose[:3, :3].T + pose[:3, 3])[:, axes]

    if item["kind"] == "mesh":
        vertices, triangles = view3d.read_stl((folder / item["file"]).read_bytes())
        return list(project(vertices)[triangles])
    if item["kind"] == "octree":
        corners = view3d.cubes(item["cells"])[0]
        return [hull(cube) for cube in project(corners).reshape(-1, 8, 2)]
    if item["kind"] == "box":
        corners = np.stack(np.meshgrid(*([-s / 2, s / 2] for s in item["size"])), axis=-1).reshape(-1, 3)
        return [hull(project(corners))]
    radius, half = item["radius"], item.get("length", 0) / 2
    if item["kind"] == "cylinder":
        return [hull(project([[*(radius * c), z] for c in circle for z in (-half, half)]))]
    ends = project([[0, 0, -half], [0, 0, half]])
    return [hull(np.concatenate([end + radius * circle for end in ends]))]


@figure(2, 3.0, shared=False)
def way_figure(panels, ways, scene, folder, goal):
    """Ways of the tool from above and from the side, with the outlines of the obstacles at the start. ways: (label, colour, places)."""
    for axes, pair, names in zip(panels, ((0, 1), (1, 2)), (("x", "y"), ("y", "z"))):
        for item in scene["objects"]:
            for polygon in outlines(item, pair, folder):
                axes.fill(*polygon.T, color=view3d.KNOWN if item["known"] else view3d.SEEN, alpha=0.5, linewidth=0)
        for label, colour, places in ways:
            axes.plot(*places[:, pair].T, color=colour, label=label)
        start = ways[0][2][0]
        axes.plot(*np.stack([start, goal])[:, pair].T, ":", color="#777777", linewidth=1, label="straight on")
        axes.plot(*start[list(pair)], "o", color="#888888", markersize=5, label="start")
        axes.plot(*goal[list(pair)], "o", color="#111111", markersize=5, label="goal")
        axes.set(xlabel=f"{names[0]} (m)", ylabel=f"{names[1]} (m)")
        axes.set_aspect("equal", "datalim")
    legend_above(panels[0])


class Logged:
    """A run of arm.json among scene.json, as samples.csv has it."""

    def __init__(self, result):
        self.result, self.name = result, result.name
        self.arm, self.scene, self.table = result.json("arm.json"), result.json("scene.json"), result.table("samples.csv")

    def shown(self, colour, index=0, shift=None):
        """For the 3D view: arm, run, objects, and sentences about what is missing. shift: it stands elsewhere, m."""
        part, missing = view3d.arm_of(self.arm, self.result.folder)
        objects, gone = view3d.objects_of(self.scene, self.result.folder, shift)
        moves = run_of(self.table, self.arm, self.name, colour, index, shift)
        return part, moves, objects + marks_of(self.table, shift), missing + gone
