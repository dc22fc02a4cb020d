# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""The code of python/README.md as it stands there; its law in the comparison of the programs."""
import json
import os
import pathlib
import re
import subprocess

import numpy as np
import pytest
import visp_direct as vd
import visp_direct._core as core
from conftest import pose
from test_servo import plate

README = (pathlib.Path(__file__).parents[1] / "README.md").read_text()
BLOCKS = re.findall(r"```python\n(.*?)```", README, re.S)
BIN = pathlib.Path(os.environ.get("VISP_DIRECT_BIN", "."))


def test_motion_of_the_readme():
    names = {}
    exec(BLOCKS[0], names)
    assert names["output"].status.result == vd.TrajectoryResult.Finished
    np.testing.assert_array_equal(names["output"].state.q, [0.5, 0.2, -0.1])


def test_arm_of_the_readme(monkeypatch):
    monkeypatch.chdir(pathlib.Path(__file__).parents[2])
    names = {"np": np, "vd": vd}
    exec(BLOCKS[2], names)
    assert names["timed"].isFree() and names["output"].status == vd.AvoidanceStatus.Arrived
    reached = vd.ArmKinematics(names["arm"], names["q"]).tool[:3, 3]
    np.testing.assert_allclose(reached, vd.ArmKinematics(names["arm"], names["task"].goal).tool[:3, 3], atol=2e-3)


def test_law_of_the_readme_in_the_comparison(tmp_path):
    program, plugin = BIN / "visp-servo-compare", pathlib.Path(core.__file__).parent / "laws.so"
    if os.environ.get("VISP_DIRECT_RUNS_LAWS") != "1" and not (program.is_file() and plugin.is_file()):
        pytest.skip("visp-servo-compare or the plug-in is not built")
    (tmp_path / "mine.py").write_text("import numpy as np\nimport visp_direct as vd\n\n" + BLOCKS[1])
    call = [
        program,
        "--plugin",
        plugin,
        "--law",
        "pbvs1,straight",
        "--plant",
        "A",
        "--measure",
        "points",
        "--out",
        tmp_path / "out",
    ]
    environment = {**os.environ, "VISP_DIRECT_LAWS": str(tmp_path / "mine.py")}
    done = subprocess.run(call, capture_output=True, text=True, env=environment)
    assert done.returncode == 0, done.stderr
    runs = json.loads((tmp_path / "out/summary.json").read_text())["runs"]
    ends = {run["law"]: run["end_rotation_deg"] for run in runs}
    assert ends["straight"] == pytest.approx(ends["pbvs1"], abs=1e-6)  # the same law
    page = (tmp_path / "out/report.html").read_text()
    for law in ("straight", "pbvs1"):  # rows of one table
        assert f'<tr><td class="text">{law}</td><td class="text">A</td><td class="text">' in page
    for text, sentence in (("raise ValueError('no')", "has not run to its end"), (None, "set VISP_DIRECT_LAWS to one")):
        bad = tmp_path / "bad.py"
        if text is None:
            bad.unlink()
        else:
            bad.write_text(text)
        done = subprocess.run(call, capture_output=True, text=True, env={**environment, "VISP_DIRECT_LAWS": str(bad)})
        assert done.returncode != 0 and sentence in done.stderr, done.stderr


def test_law_of_the_readme_is_that_of_the_library():
    names = {"vd": vd, "np": np}
    exec(BLOCKS[1], names)
    law, library = vd.ServoLaw.create("straight"), vd.ServoLaw.create("pbvs1")
    seen = plate().measure(pose([0.05, -0.02, 0.5], [0.2, 0.1, -0.3]))
    for each in (law, library):
        each.setGoal(plate().goal(pose([0, 0, 0.4])))
    np.testing.assert_allclose(law.step(seen, 0.01).v, library.step(seen, 0.01).v, atol=1e-9)
