# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""The notebooks run from the first cell to the last; their own assertions check what they say. Jupyter is not needed."""
import json
import os
import pathlib

import pytest

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

NOTEBOOKS = sorted((pathlib.Path(__file__).parents[1] / "notebooks").glob("*.ipynb"))
OUT = pathlib.Path(os.environ.get("VISP_DIRECT_TEST_OUT", "."))
OUT.mkdir(parents=True, exist_ok=True)


def test_there_are_notebooks():
    assert len(NOTEBOOKS) == 3


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda file: file.stem)
def test_notebook_runs(notebook):
    plt.close("all")
    scope = {}
    for cell in json.loads(notebook.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] == "code":
            assert cell["outputs"] == [], "commit notebooks without outputs"
            exec(compile("".join(cell["source"]), f"{notebook.name}, {cell['id']}", "exec"), scope)
    assert plt.get_fignums()
    for number in plt.get_fignums():
        plt.figure(number).savefig(OUT / f"notebook-{notebook.stem}-{number}.png", dpi=80)
