# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""The interface as a whole: names, docstrings, stubs, every function tested, no crash on any argument, nothing leaks."""
import ast
import inspect
import json
import os
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest
import visp_direct as vd
import visp_direct._core as core
from conftest import longer, pose

HERE = pathlib.Path(__file__).parent


def public():
    """(name, thing) of all that the package offers, methods as "Class.method"."""
    for name, thing in vars(core).items():
        if name.startswith("_"):
            continue
        yield name, thing
        if inspect.isclass(thing):
            for key, member in vars(thing).items():
                if not key.startswith("_") and not hasattr(thing, "__members__"):
                    yield f"{name}.{key}", member


def test_everything_has_a_docstring():
    for name, thing in public():
        if callable(thing) or isinstance(thing, (property, staticmethod)):
            text = inspect.getdoc(thing.__func__ if isinstance(thing, staticmethod) else thing) or ""
            lines = [line for line in text.split("\n") if line and not re.match(r"(\d+\. )?\w+\(.*\) -> ", line)]
            assert [line for line in lines if line != "Overloaded function."], name
            assert "\\" not in text and not re.search(r"\bvp[A-Z]", text.replace("vpCameraParameters of ViSP", "")), (
                name,
                text,
            )


def test_stubs_have_the_same_names():
    tree = ast.parse((pathlib.Path(core.__file__).parent / "_core.pyi").read_text())
    stubbed = set()
    for node in tree.body:
        if isinstance(node, ast.AnnAssign):
            stubbed.add(node.target.id)
        elif isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            stubbed.add(node.name)
        if isinstance(node, ast.ClassDef) and not hasattr(getattr(core, node.name), "__members__"):
            members = [m.target.id if isinstance(m, ast.AnnAssign) else getattr(m, "name", "_") for m in node.body]
            stubbed |= {f"{node.name}.{key}" for key in members if not key.startswith("_")}
    assert stubbed == {name for name, _ in public()}
    text = (pathlib.Path(core.__file__).parent / "_core.pyi").read_text()
    assert "::" not in text and "*args: Any, **kwargs: Any" not in text  # C++ types, signatures that are no Python


@pytest.fixture(scope="module")
def calls(tmp_path_factory):
    """What calls.py writes of a run of the other tests."""
    files = [HERE / f"test_{name}.py" for name in "arm motion observers perception printing rendering servo simulation specs trajectory vision".split()]
    written = tmp_path_factory.mktemp("calls") / "calls.json"
    environment = {**os.environ, "VISP_DIRECT_CALLS": str(written), "VISP_DIRECT_SEED": "", "VISP_DIRECT_LONG_TESTS": "1"}
    environment["VISP_DIRECT_CHEAP"] = "0.03" if longer(1) > 1 else "0.0005"  # with the former it takes minutes
    environment["PYTHONPATH"] = f"{HERE}:{environment.get('PYTHONPATH', '')}"
    command = [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", "-p", "calls", *map(str, files)]
    run = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=1000)
    assert run.returncode == 0, run.stdout[-3000:] + run.stderr[-3000:]
    return json.loads(written.read_text())


def test_version():
    found = re.search(r"project\([^)]*VERSION ([0-9.]+)", (HERE.parents[1] / "CMakeLists.txt").read_text(), re.S)
    assert vd.__version__ == found[1]


def test_every_function_is_called_by_a_test(calls):
    """Every constructor, too, except those of structs, which test_fields_are_set_by_keyword_and_shown() calls."""
    functions = {name for name, thing in public() if (callable(thing) or isinstance(thing, staticmethod)) and not inspect.isclass(thing)}
    classes = {name for name, thing in public() if inspect.isclass(thing) and not hasattr(thing, "_fields")}
    made = {name for name in classes if "-> None" in (getattr(core, name).__init__.__doc__ or "")}
    assert sorted((functions | made) - set(calls)) == []


def test_nothing_leaks(calls):
    """More than 10^5 calls, right and wrong ones, of each function of which one takes at most 0.5 ms, in long tests 30 ms."""
    assert {name: said for name, (_, said) in calls.items() if said} == {}
    assert sum(count for count, _ in calls.values()) > 1e5
    assert sum(count > 0 for count, _ in calls.values()) > 0.9 * len(calls)


def test_fields_are_set_by_keyword_and_shown():
    gains = vd.ServoGains(lambda_=2.5, kappa=0)
    assert repr(gains).startswith("ServoGains(lambda_=2.5, rotation=1.0, kappa=0.0,")
    for name, thing in public():
        if inspect.isclass(thing) and hasattr(thing, "_fields"):
            try:
                made = thing()
            except TypeError:
                continue  # needs its number of axes, or is made by the library alone
            assert repr(made).startswith(name + "("), name
            for field in thing._fields:
                value = getattr(made, field)
                if getattr(thing, field).fset:
                    setattr(made, field, value)  # what can be read can be written
            with pytest.raises(TypeError, match=f"{name} has no field nonsense"):
                thing(nonsense=1)


FUZZ = """
import faulthandler, inspect, itertools, sys
import numpy as np
import visp_direct as vd, visp_direct._core as core
from conftest import pose, DATA
faulthandler.enable()
random = np.random.default_rng(int(sys.argv[1]))
arm = vd.loadArmJson(str(DATA / "robot/amor.json"))
scene = vd.CollisionScene(arm)
pool = [None, True, -1, 0, 1, 3, 2**31, -2**63, 2**70, 0.5, -1.0, 1e300, float("nan"), float("inf"), "", "dtg", "\\udc80", b"x", [], [[]],
        [1, 2, 3], [[1, 2], [3]], {}, object(), np.zeros(0), np.zeros(1), np.zeros(6), np.full(7, 0.1), np.zeros(17), np.zeros((3, 0)),
        np.full(6, np.nan), np.full(7, np.inf), np.zeros((4, 4)), np.eye(4), np.eye(4, dtype=np.float32), np.eye(4)[::2], np.full((4, 4), np.nan),
        np.zeros((2, 3)), np.zeros((5, 3, 2)), np.zeros((64, 64), np.uint8), np.zeros((64, 64), np.uint8)[::-1, ::3], np.zeros((64, 64), np.uint16),
        np.zeros((1, 1), np.uint8), np.array("x"), np.array([None]), np.ma.masked, np.zeros(3, vd.PatternCell), np.zeros(3, vd.CalibrationPoint),
        np.zeros((2, 2), vd.PatternCell), arm, scene, arm.home(), pose([0, 0, 0.4]), vd.CameraParameters(600, 600, 320, 240),
        np.full((48, 64), 0.5, np.float32), vd.Octree(np.ones((2, 4))), vd.ArmDynamics(arm),
        vd.TrajectoryInput(7), vd.TrajectoryInput(1, maxVelocity=[np.nan]), vd.ServoTarget.rectangle(0.1, 0.1), vd.ArmKinematics(arm, arm.home()),
        vd.ServoTarget.rectangle(0.1, 0.1).goal(pose([0, 0, 0.4])), vd.ServoTarget.rectangle(0.1, 0.1).measure(pose([0, 0, 0.5])),
        vd.CollisionShape.sphere(0.1), vd.JointPath(points=np.zeros((2, 7)))]
classes = [thing for _, thing in inspect.getmembers(core, inspect.isclass)]
for thing in classes:
    if hasattr(thing, "__members__"):
        pool += list(thing.__members__.values())[:2]
    else:
        try:
            pool.append(thing())
        except (TypeError, ValueError):
            pass
pool += [vd.DirectTrajectory(7), vd.PatternTracker(64, 64), vd.ServoController.create("pbvs1"), vd.ServoLaw.create("ibvs"), vd.TrajectoryPlan(7),
         vd.ArmMotion(arm), vd.RedundancySolver(arm), vd.StopSupervisor(scene), vd.CertifiedMotion(scene), vd.CertifiedTrajectory(scene),
         vd.VisualServo("pbvs1"), vd.VisualServo("pbvs1", arm=arm), vd.PathPlanner(scene, vd.PathPlannerSpec(timeLimit=0.01, shortenTime=0)), vd.PrintTrigger(), vd.PrintReference(),
         vd.makeAvoidanceMethod(vd.avoidanceMethodNames()[0], scene), vd.TriangleMesh(np.eye(3), [[0, 1, 2]]),
         vd.PlanarMicroscopeCalibration(64, 64), vd.TsaiCalibration(64, 64), vd.PlanarTargetDatabase(vd.CameraParameters(600, 600, 320, 240)),
         vd.ArmPlant(arm), vd.ArmDrives(arm), vd.SimulatedArm(arm), vd.XYStage(vd.XYStageSpec()), vd.VisionChannel(10, 0.1), vd.JointFriction.of(arm),
         vd.JointVelocityEstimator(7, 0.01, 50), vd.JointPositionControl(vd.JointPositionControlSpec(kp=[1], kd=[1], maxTorque=[1]))]
SLOW = {"coverArm", "setTimeLimit", "save"}  # or writes files
allowed = (TypeError, ValueError, IndexError, OSError, RuntimeError, NotImplementedError, OverflowError, AttributeError, UnicodeError)
def call(function, count):
    arguments = [pool[i] for i in random.integers(0, len(pool), count)]
    print(trial, function, [type(a).__name__ for a in arguments], file=sys.stderr)  # the last line names what crashed
    function(*arguments)
done = good = 0
functions = [f for n, f in inspect.getmembers(core, inspect.isbuiltin) if n not in SLOW]
for trial in range(int(sys.argv[2])):
    if trial % 4 == 0:
        function, count = functions[random.integers(len(functions))], random.integers(1, 4)
    else:
        owner = pool[random.integers(len(pool))] if trial % 4 < 3 else classes[random.integers(len(classes))]
        names = [n for n in dir(owner) if n not in SLOW and (not n.startswith("_") or n == "__init__")] if type(owner).__module__ == "visp_direct._core" or inspect.isclass(owner) else []
        if not names:
            continue
        name = names[random.integers(len(names))]
        if name == "__init__" and inspect.isclass(owner):
            function = owner
        else:
            try:
                function = getattr(owner, name)
            except allowed:
                continue
        if not callable(function):
            if inspect.isclass(owner):
                continue  # a class is no struct whose fields can be set
            try:
                setattr(owner, name, pool[random.integers(len(pool))])
            except allowed:
                pass
            continue
        count = random.integers(0, 5)
    done += 1
    try:
        call(function, count)
        good += 1
    except allowed as error:
        assert str(error), function
assert good > done / 100, (good, done)
print(done, good)
"""


def test_no_argument_crashes(seed):
    """Random calls with arguments of all kinds, in a process of its own: an exception is right, a crash is not."""
    environment = {"PYTHONPATH": f"{pathlib.Path(core.__file__).parents[1]}:{HERE}", "OMP_NUM_THREADS": "1"}
    run = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", FUZZ, str(seed), str(longer(4000))],
        env=environment,
        capture_output=True,
        text=True,
        timeout=1000,
    )
    assert run.returncode == 0, run.stderr[-3000:]
