# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Parameters name what is wrong in them; outputs have a sentence."""
import inspect
import re

import numpy as np
import pytest
import visp_direct as vd
import visp_direct._core as core

OPTIONAL = {  # fields of which NaN means the usual value, or that matter with another value of an enum only
    "MicroscopeCalibrationSpec": {"u0", "v0"},
    "TsaiCalibrationSpec": {"u0", "v0"},
    "PoseTrajectorySpec": {"arrivalTime"},
    "SelfMotionIndex": {"range"},
}
ARGUMENTS = {"ClosedLoopSpec": lambda arm: [0.01], "RedundancySpec": lambda arm: [arm], "SelfMotionIndex": lambda arm: [arm]}
# Not complete without numbers for each joint, or a pitch.
INCOMPLETE = {"JointFriction", "JointPositionControlSpec", "JointVelocityControlSpec", "ArmDriveSpec", "SimulatedArmSpec", "CalibrationPitch"}


def structs(method):
    """Structs that have the method and can be made without arguments."""
    for name, thing in vars(core).items():
        if inspect.isclass(thing) and hasattr(thing, "_fields") and callable(getattr(thing, method, None)):
            try:
                yield name, thing, thing()
            except TypeError:
                pass


@pytest.mark.parametrize("method", ["validate", "check"])
def test_parameters_refuse_nan(arm, method):
    checked = 0
    for name, thing, usual in structs(method):
        if name in INCOMPLETE:
            continue
        arguments = ARGUMENTS.get(name, lambda arm: [])(arm)
        getattr(usual, method)(*arguments)
        for field in thing._fields:
            if isinstance(getattr(usual, field), float) and field not in OPTIONAL.get(name, ()):
                with pytest.raises(ValueError) as error:
                    getattr(thing(**{field: np.nan}), method)(*arguments)
                assert re.findall("[A-Z]?[a-z]+", field)[-1].lower() in str(error.value).lower()
                checked += 1
    assert checked > 5


def test_outputs_have_a_sentence(arm):
    sentences = [made.message() for name, _, made in structs("message") if name not in ("FitTest", "JointShortfall")]
    scene = vd.CollisionScene(arm)
    path = vd.JointPath(points=np.array([arm.home(), arm.home() + 0.1]))
    sentences.append(vd.TimedPath(scene, path, vd.TimedPathSpec()).message(scene))
    assert len(sentences) > 8 and all(" " in sentence for sentence in sentences)


def test_laws_know_their_names():
    for law in ("pbvs1", "ff-lookat-pi", "ff-dtg"):
        assert vd.ServoLaw.create(law).id() == law
