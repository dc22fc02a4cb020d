# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""show(): an arm, its scene and a motion in the browser."""
import pathlib
import tempfile
import webbrowser

import numpy as np

from . import _core as core

JOINT = {
    core.JointType.Revolute: "revolute",
    core.JointType.Continuous: "continuous",
    core.JointType.Prismatic: "prismatic",
}


def _arm(arm, missing):
    from .report.view3d import MOST_TRIANGLES, mesh_part

    spec, kinds = arm.spec(), core.ArmShapeKind
    most = MOST_TRIANGLES // max(1, sum(shape.kind == kinds.Mesh for shape in spec.shapes))
    links = [{"shapes": [], "capsules": []} for _ in range(arm.links() + 1)]
    for shape in spec.shapes:
        size = shape.size.tolist()
        if shape.kind == kinds.Mesh:
            try:
                mesh = core.TriangleMesh.load(shape.file)
            except (ValueError, OSError, NotImplementedError) as error:
                missing.append(str(error))
                continue
            part = mesh_part(mesh.vertices() * shape.size, mesh.triangles(), most)
        elif shape.kind == kinds.Sphere:
            part = {"kind": "sphere", "radius": size[0]}
        elif shape.kind == kinds.Cylinder:
            part = {"kind": "cylinder", "radius": size[0], "length": size[1]}
        else:
            part = {"kind": "box", "size": size}
        links[spec.bodies[shape.body].link]["shapes"].append({**part, "pose": shape.pose.tolist()})
    for capsule in spec.capsules:
        links[capsule.link]["capsules"].append(
            {"kind": "capsule", "from": capsule.from_.tolist(), "to": capsule.to.tolist(), "radius": capsule.radius}
        )
    joints = [
        {
            "name": joint.name,
            "type": JOINT[joint.type],
            "limits": None if joint.type == core.JointType.Continuous else [joint.lower, joint.upper],
        }
        for joint in spec.joints
    ]
    chain = [
        {
            "step": part.step.tolist(),
            "after": part.after.tolist(),
            "prismatic": part.isPrismatic,
            "joint": part.joint,
            "ratio": part.ratio,
            "offset": part.offset,
        }
        for part in map(arm.chain, range(arm.links()))
    ]
    return {
        "name": spec.name,
        "joints": joints,
        "chain": chain,
        "links": links,
        "tool_link": arm.toolLink(),
        "tool": spec.tool.tolist(),
        "home": arm.home().tolist(),
    }


def _object(item, seconds):
    from .report.view3d import MOST_TRIANGLES, cubes, mesh_part

    shape, types = item.shape, core.ShapeType
    if shape.type() == types.Sphere:
        part = {"kind": "sphere", "radius": shape.radius()}
    elif shape.type() == types.Box:
        part = {"kind": "box", "size": shape.size().tolist()}
    elif shape.type() == types.Cylinder:
        part = {"kind": "cylinder", "radius": shape.radius(), "length": shape.length()}
    elif shape.type() == types.Capsule:
        end = [0, 0, shape.length() / 2]
        part = {"kind": "capsule", "radius": shape.radius(), "from": [-x for x in end], "to": end}
    elif shape.type() == types.Mesh:
        part = mesh_part(shape.triangles().vertices(), shape.triangles().triangles(), MOST_TRIANGLES // 4)
    else:
        part = mesh_part(*cubes(shape.cubes().cells()), MOST_TRIANGLES // 4)
    part["pose"] = item.pose.tolist()
    if np.any(item.velocity) and seconds > 0:
        times = np.linspace(0, seconds, 100)
        part["track"] = {"t": times.tolist(), "pose": [item.poseAt(t).tolist() for t in times]}
    return part


def _motion(arm, path):
    """Times and configurations of a plan, a timed path, a path, or an array of configurations; without times one second each."""
    if isinstance(path, core.TrajectoryPlan):
        t = np.linspace(0, path.duration(), 300)
        q = np.stack([path.sample(i, t)[:, 0] for i in range(path.axes())], axis=1)
    elif isinstance(path, core.TimedPath):
        t = np.linspace(0, path.duration(), 300)
        q = np.array([[path.at(i, x)[0] for i in range(arm.size())] for x in t])
    else:
        q = np.asarray(path.points if isinstance(path, core.JointPath) else path, float)
        t = np.arange(len(q), dtype=float)
    if q.ndim != 2 or len(q) == 0 or q.shape[1] != arm.size() or not np.isfinite(q).all():
        raise ValueError(f"a path of shape {q.shape} was given, must be n x {arm.size()} finite numbers, n > 0")
    return t, q


def show(arm, scene=None, path=None, file=None):
    """Shows an arm in 3D, in a page that needs no network.

    arm: an ArmModel. scene: a CollisionScene whose objects and ground are shown, moving with their velocities. path: a TrajectoryPlan,
    TimedPath, JointPath or n configurations, run by a time slider; None: sliders for the joints. file: where the page is written;
    None: a temporary file, opened in the browser. Returns the path of the file."""
    from .report.page import Page
    from .report.view3d import scene as view

    missing, runs, seconds = [], [], 0.0
    if path is not None:
        t, q = _motion(arm, path)
        runs, seconds = [{"name": "motion", "colour": "#0072b2", "arm": 0, "t": t.tolist(), "q": q.tolist()}], t[-1]
    objects = [] if scene is None else [_object(scene.object(i), seconds) for i in range(scene.objectCount())]
    ground = None if scene is None or scene.ground() is None else scene.ground().offset
    page = Page(arm.spec().name, "Drag to turn, the wheel or two fingers to zoom. The grid has squares of 10 cm.")
    page.section("The arm")
    page.view(
        view([_arm(arm, missing)], runs, objects, ground),
        "Covers: the capsules of collision checks.",
    )
    page.items(*missing)
    target = pathlib.Path(file or tempfile.mkstemp(suffix=".html")[1])
    target.write_text(page.html(), encoding="utf-8")
    if file is None:
        webbrowser.open(target.as_uri())
    return target
