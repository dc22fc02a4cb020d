# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Report of visp-arm: what was understood of a robot, and the robot itself in 3D."""
from .page import Page, counted, number
from .view3d import arm_of, scene


def joint_rows(robot):
    for joint in robot["joints"]:
        source = joint["from"]
        yield [
            joint["name"],
            joint["type"],
            joint["lower"],
            joint["upper"],
            source["position"],
            joint["velocity"],
            source["velocity"],
            joint["acceleration"],
            source["acceleration"],
            joint["torque"],
            joint["home"],
        ]


def link_rows(robot):
    for link in robot["links"]:
        yield [
            link["name"],
            "base" if link["link"] == 0 else int(link["link"]),
            link["geometry"],
            link["covers"] or None,
            *(1000 * link[key] if key in link else None for key in ("overhang_m", "radius_m")),
            link.get("volume_ratio"),
        ]


def grouped(pairs):
    """Pairs as "body: others"."""
    groups = {}
    for first, second, *_ in pairs:
        groups.setdefault(first, []).append(second)
    return [f"{body}: {', '.join(others)}" for body, others in groups.items()]


def add_robot(page, result, robot):
    page.section(f"Joints of {robot['name']}")
    page.table(
        ["joint", "type", "lower", "upper", "from", "velocity", "from", "acceleration", "from", "torque", "home"],
        joint_rows(robot),
        "rad or m, and s, Nm or N. From: which file or option gave the limit. –: none, or unknown.",
    )
    if robot["followers"]:
        page.table(
            ["follower", "type", "follows", "ratio", "offset (rad or m)"],
            [[f["name"], f["type"], f["follows"], f["ratio"], f["offset"]] for f in robot["followers"]],
            "Joints that move with another one: their coordinate is ratio times its coordinate, plus offset.",
        )
    page.section("What collision checks see")
    page.table(
        ["body", "on link", "checked as", "capsules", "overhang (mm)", "of radius (mm)", "volume / hull"],
        link_rows(robot),
        "cover: capsules; mesh: known, not covered; none: no shape is known. Overhang: how far the capsules reach beyond the shape.",
    )
    page.section("Pairs of bodies")
    page.paragraph(
        f"{counted(len(robot['checked_pairs']), 'pair')} checked against each other, {len(robot['skipped_pairs'])} not."
    )
    page.items(grouped(robot["checked_pairs"]))
    page.table(["body", "and", "not checked, because"], robot["skipped_pairs"])
    if robot.get("pose"):
        page.section("Tool in the base")
        page.table(
            ["x", "y", "z", "position (m)"],
            robot["pose"][:3],
            "Columns of the rotation, and the position, of the configuration asked for.",
        )
    if "touches" in robot:
        page.section("What touches")
        page.items([f"{a} and {b}" for a, b in robot["touches"]] or ["Nothing."])


def page(results):
    robots = [result.json("robot.json") for result in results]
    page = Page("Robot" if len(robots) == 1 else "Robots", ", ".join(robot["name"] for robot in robots))
    for robot in robots:
        mass = "masses unknown" if robot["mass_kg"] is None else f"moving mass {number(robot['mass_kg'])} kg"
        page.answers(
            f"{robot['name']}: {counted(len(robot['joints']), 'joint')}, reach {number(robot['reach_m'])} m, {mass}."
        )
        page.answers(
            *(
                robot["problems"]
                or [
                    f"{robot['name']} is usable, with {counted(len(robot['warnings']), 'warning')}."
                    if robot["warnings"]
                    else f"{robot['name']} is usable, without a warning."
                ]
            )
        )
    page.section("The robot")
    for result in results:
        data = result.json("arm.json")
        arm, missing = arm_of(data, result.folder)
        has_shapes = any(link["shapes"] for link in arm["links"])
        page.view(
            scene([arm]),
            f"{data['name']} at home: drag to turn, the wheel or two fingers to zoom, the sliders move the joints. "
            + (
                "Colours change from link to link."
                if has_shapes
                else "Blue: the capsules of the collision check; there are no shapes."
            )
            + " The grid has squares of 10 cm.",
        )
        page.items([*data["missing"], *missing])
    for result, robot in zip(results, robots):
        if robot["warnings"]:
            page.section(f"Warnings about {robot['name']}")
            page.items(robot["warnings"])
        add_robot(page, result, robot)
    page.section("How it was made")
    page.facts([(result.name, result.summary["command"]) for result in results])
    return page
