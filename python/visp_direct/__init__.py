# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Direct methods for vision-based robot control: trajectories, servo laws, planar targets, patterns, printing, arms and motion
among obstacles.

Names are those of C++ without vp: vpPoseTrajectory is PoseTrajectory, and its method setGoal is setGoal. So the reference of
the C++ library and its messages hold here, too. An output argument is the result; a field that is a keyword of Python has an
underscore (lambda_). Poses are 4 x 4 arrays, twists arrays of 6, images 2-D arrays of uint8 that are not copied. Fields of
structs are given by keyword: PoseTrajectorySpec(linearVelocity=0.1). Errors are exceptions with one sentence.
"""
try:
    from ._core import *  # noqa: F401,F403
    from ._core import __version__  # noqa: F401
    from .viewer import show  # noqa: F401
except ImportError as error:
    _missing = error

    def __getattr__(name):  # reports need no compiled part
        raise ImportError(f"visp_direct.{name} needs the compiled part of visp_direct: {_missing}"
                          "; cmake --build --preset release --target visp_direct_package builds it")
