# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""The 3D view: what view3d.js draws, from the data of a program or from objects of visp_direct. three.js is in the page, so it
needs no network."""
import base64
import os
import pathlib

import numpy as np

HERE = pathlib.Path(__file__).parent
MOST_TRIANGLES = 80000  # of all meshes of a page: about 2.5 MB


def scripts():
    """three.js, its mouse control and view3d.js as script elements."""
    folder = pathlib.Path(os.environ.get("VISP_DIRECT_THREE", "/usr/share/javascript/three"))
    files = [folder / "three.min.js", folder / "examples/js/controls/OrbitControls.js", HERE / "view3d.js"]
    missing = [file for file in files if not file.is_file()]
    if missing:
        raise OSError(
            f"{missing[0]}: the 3D view needs three.js; Debian has it as libjs-three, or VISP_DIRECT_THREE names its folder"
        )
    return "\n".join(
        f"<script>\n{file.read_text(encoding='utf-8').replace('</script', '<' + chr(92) + '/script')}\n</script>"
        for file in files
    )


def _packed(array, kind):
    return base64.b64encode(np.ascontiguousarray(array, kind).tobytes()).decode()


def clustered(vertices, triangles, most):
    """The mesh with at most `most` triangles, as far as a grid of 4 cells goes: vertices in one cell become one, their mean."""
    vertices, triangles = np.asarray(vertices, float), np.asarray(triangles)
    merged, kept, cells = vertices, triangles, 256
    while len(kept) > most and cells >= 4:
        grid = np.floor((vertices - vertices.min(axis=0)) / np.ptp(vertices, axis=0).max() * cells).astype(int)
        index = np.unique(grid, axis=0, return_inverse=True)[1].ravel()
        count = np.bincount(index)
        merged = np.stack([np.bincount(index, vertices[:, k]) / count for k in range(3)], axis=1)
        kept = index[triangles]
        kept = kept[(kept[:, 0] != kept[:, 1]) & (kept[:, 1] != kept[:, 2]) & (kept[:, 0] != kept[:, 2])]
        cells = int(cells * 0.8)
    return merged, kept


def mesh_part(vertices, triangles, most):
    vertices, triangles = clustered(vertices, triangles, most)
    return {"kind": "mesh", "vertices": _packed(vertices, "<f4"), "triangles": _packed(triangles, "<u4")}


def read_stl(data):
    """Vertices and triangles of a binary STL file, equal vertices merged."""
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    count = int(np.frombuffer(data, "<u4", 1, 80)[0]) if len(data) >= 84 else -1
    if len(data) != 84 + 50 * count:
        raise ValueError("is no binary STL file")
    corners = np.frombuffer(data, record, count, 84)["corners"].reshape(-1, 3)
    vertices, index = np.unique(corners, axis=0, return_inverse=True)
    return vertices, index.reshape(-1, 3)


def _shape_part(shape, folder, most):
    size = shape["size"]
    if shape["kind"] == "mesh":
        return mesh_part(*read_stl((folder / shape["file"]).read_bytes()), most)
    return {
        "kind": shape["kind"],
        **{"sphere": {"radius": size[0]}, "cylinder": {"radius": size[0], "length": size[1]}, "box": {"size": size}}[
            shape["kind"]
        ],
    }


def arm_of(data, folder):
    """An arm for view3d.js from arm.json of a program; its meshes are in the folder. Also sentences about what is missing."""
    most = MOST_TRIANGLES // max(1, sum(shape["kind"] == "mesh" for shape in data["shapes"]))
    links, missing = [{"shapes": [], "capsules": []} for _ in range(len(data["chain"]) + 1)], []
    for shape in data["shapes"]:
        try:
            links[shape["link"]]["shapes"].append({**_shape_part(shape, folder, most), "pose": shape["pose"]})
        except (OSError, ValueError) as error:
            missing.append(f"{shape['file']}: is not shown: {error}")
    for capsule in data["capsules"]:
        links[capsule["link"]]["capsules"].append(
            {"kind": "capsule", **{k: capsule[k] for k in ("from", "to", "radius")}}
        )
    return {key: data[key] for key in ("name", "joints", "chain", "tool_link", "tool", "home")} | {
        "links": links
    }, missing


def scene(arms, runs=(), objects=(), ground=None):
    """What vispView() gets. runs: name, colour, arm (index), t, q, base. objects: kind and its numbers, pose, colour, track."""
    return {"arms": list(arms), "runs": list(runs), "objects": list(objects), "ground": ground}
