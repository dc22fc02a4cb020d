# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Report of visp-arm: what was understood of a robot, and the robot itself in 3D."""
from .page import Page, counted, number
from .view3d import arm_of, scene


JOINTS = [
    "joint = name; type; lower; upper; from = from.position; velocity; from = from.velocity; acceleration; from = from.acceleration; torque; "
    "home"
]
FOLLOWERS = ["follower = name; type; follows; ratio; offset (rad or m) = offset"]
LINKS = [
    "body = name",
    ("on link", lambda link: "base" if link["link"] == 0 else int(link["link"])),
    "checked as = geometry",
    ("capsules", lambda link: link["covers"] or None),
    "overhang (mm) = 1000 overhang_m; of radius (mm) = 1000 radius_m; volume / hull = volume_ratio",
]


def grouped(pairs):
    """Pairs as "body: others"."""
    groups = {}
    for first, second, *_ in pairs:
        groups.setdefault(first, []).append(second)
    return [f"{body}: {', '.join(others)}" for body, others in groups.items()]


def add_robot(page, result, robot):
    page.section(f"Joints of {robot['name']}")
    says = "rad or m, and s, Nm or N. From: which file or option gave the limit. –: none, or unknown."
    page.records(robot["joints"], JOINTS, says)
    if robot["followers"]:
        says = "Joints that move with another one: their coordinate is ratio times its coordinate, plus offset."
        page.records(robot["followers"], FOLLOWERS, says)
    page.section("What collision checks see")
    page.records(
        robot["links"],
        LINKS,
        "cover: capsules; mesh: known, not covered; none: no shape is known. Overhang: how far the capsules reach beyond the shape.",
    )
    page.section("Pairs of bodies")
    page.paragraph(f"{counted(len(robot['checked_pairs']), 'pair')} checked against each other, {len(robot['skipped_pairs'])} not.")
    page.items(*grouped(robot["checked_pairs"]))
    page.table(["body", "and", "not checked, because"], robot["skipped_pairs"])
    if robot.get("pose"):
        page.section("Tool in the base")
        says = "Columns of the rotation, and the position, of the configuration asked for."
        page.table(["x", "y", "z", "position (m)"], robot["pose"][:3], says)
    if "touches" in robot:
        page.section("What touches")
        page.items(*[f"{a} and {b}" for a, b in robot["touches"]] or ["Nothing."])


def page(results):
    robots = [result.json("robot.json") for result in results]
    page = Page("Robot" if len(robots) == 1 else "Robots", ", ".join(robot["name"] for robot in robots))
    for robot in robots:
        mass = "masses unknown" if robot["mass_kg"] is None else f"moving mass {number(robot['mass_kg'])} kg"
        page.answers(f"{robot['name']}: {counted(len(robot['joints']), 'joint')}, reach {number(robot['reach_m'])} m, {mass}.")
        warned = f"with {counted(len(robot['warnings']), 'warning')}" if robot["warnings"] else "without a warning"
        page.answers(*(robot["problems"] or [f"{robot['name']} is usable, {warned}."]))
    page.section("The robot")
    for result in results:
        data = result.json("arm.json")
        arm, missing = arm_of(data, result.folder)
        has_shapes = any(link["shapes"] for link in arm["links"])
        shown = "Colours change from link to link." if has_shapes else "Blue: the capsules of the collision check; there are no shapes."
        page.view(
            scene([arm]),
            f"{data['name']} at home: drag to turn, the wheel or two fingers to zoom, the sliders move the joints. {shown} "
            "The grid has squares of 10 cm.",
        )
        page.items(*data["missing"], *missing)
    for result, robot in zip(results, robots):
        if robot["warnings"]:
            page.section(f"Warnings about {robot['name']}")
            page.items(*robot["warnings"])
        add_robot(page, result, robot)
    page.section("How it was made")
    page.facts([(result.name, result.summary["command"]) for result in results])
    return page
