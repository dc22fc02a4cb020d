#!/usr/bin/env python3
# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""What a call from Python costs above the same one in C++ (timed.cpp), in one run. Prints a table; measure on an idle machine:
PYTHONPATH=build/release/python python3 python/benchmark/overhead.py"""
import time

import numpy as np
import visp_direct as vd
import visp_direct_timed as timed


def per_call(call, count=20000, rounds=15):
    """Least mean time of a call over some rounds, us."""
    best = float("inf")
    for _ in range(rounds):
        begin = time.perf_counter()
        for _ in range(count):
            call()
        best = min(best, (time.perf_counter() - begin) / count)
    return 1e6 * best


def trajectory_update():
    problem, trajectory = vd.TrajectoryInput(7), vd.DirectTrajectory(7)
    goal = np.linspace(0.1, 0.7, 7)
    problem.goal.q = goal
    trajectory.step(problem, 1e-9)

    def update():
        problem.goal.q = goal  # the goal as a camera or a joystick gives it, each cycle
        return trajectory.step(problem, 1e-9).state.q

    return per_call(update), timed.trajectory(problem, 20000)


def tracked_frame():
    v, u = np.mgrid[0:160, 0:240]
    image = (60 + 120 / (1 + np.exp((np.hypot(u % 22 - 11, v % 18 - 9) - 5.5) / 0.7))).astype(np.uint8)
    tracker = vd.PatternTracker(240, 160, vd.PatternTrackerSpec(refreshEvery=0))
    for _ in range(100):
        tracker.process(image)
    return per_call(lambda: tracker.process(image).cells, 300), timed.tracker(tracker, image, 300)


if __name__ == "__main__":
    print(f"{'':36}{'Python':>10}{'C++':>10}{'above':>10}  us")
    for name, measure in (
        ("trajectory update, 7 axes", trajectory_update),
        ("tracked frame of 240 x 160 px", tracked_frame),
    ):
        python, cpp = measure()
        print(f"{name:36}{python:10.2f}{cpp:10.2f}{python - cpp:10.2f}")
