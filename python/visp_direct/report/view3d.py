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
KNOWN, SEEN = "#9aa7b4", "#c46a4a"


def scripts():
    """three.js, its mouse control, camera3d.js and view3d.js as script elements."""
    folder = pathlib.Path(os.environ.get("VISP_DIRECT_THREE", "/usr/share/javascript/three"))
    files = [folder / "three.min.js", folder / "examples/js/controls/OrbitControls.js", HERE / "camera3d.js", HERE / "view3d.js"]
    missing = [file for file in files if not file.is_file()]
    if missing:
        raise OSError(f"{missing[0]}: the 3D view needs three.js; Debian has it as libjs-three, or VISP_DIRECT_THREE names its folder")
    return "\n".join(
        f"<script>\n{file.read_text(encoding='utf-8').replace('</script', '<' + chr(92) + '/script')}\n</script>" for file in files
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
    sizes = {"size": size} if shape["kind"] == "box" else dict(zip(("radius", "length")[: 1 + (shape["kind"] == "cylinder")], size))
    return {"kind": shape["kind"], **sizes}


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
        links[capsule["link"]]["capsules"].append({"kind": "capsule", **{k: capsule[k] for k in ("from", "to", "radius")}})
    return {key: data[key] for key in ("name", "joints", "chain", "tool_link", "tool", "home")} | {"links": links}, missing


def objects_of(data, folder, shift=None):
    """Obstacles for view3d.js from scene.json of a program: grey what was known from the start. shift: of all, m. Also sentences."""
    parts, missing = [], []
    for item in data["objects"]:
        try:
            parts.append(shifted({**object_of(item, folder), "colour": KNOWN if item["known"] else SEEN}, shift))
        except (OSError, ValueError) as error:
            missing.append(f"{item['name']}: is not shown: {error}")
    return parts, missing


def object_of(item, folder):
    part = {"pose": item["pose"], "kind": item["kind"]} | {key: item[key] for key in ("size", "radius", "length", "track") if key in item}
    if "there_s" in item:
        part["there"] = item["there_s"]
    if item["kind"] == "capsule":
        part |= {"from": [0, 0, -item["length"] / 2], "to": [0, 0, item["length"] / 2]}
    elif item["kind"] == "mesh":
        part |= mesh_part(*read_stl((folder / item["file"]).read_bytes()), MOST_TRIANGLES // 8)
    elif item["kind"] == "octree":
        part |= mesh_part(*cubes(item["cells"]), MOST_TRIANGLES // 4)
    return part


def cubes(cells):
    """A mesh of cubes, each given by its centre and the length of its edges."""
    cells = np.asarray(cells, float).reshape(-1, 4)
    corners = np.stack(np.meshgrid(*3 * [[-0.5, 0.5]], indexing="ij"), axis=-1).reshape(-1, 3)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = np.array([triangle for a, b, c, d in quads for triangle in ((a, b, c), (a, c, d))])
    vertices = cells[:, None, :3] + cells[:, None, 3:] * corners
    return vertices.reshape(-1, 3), (8 * np.arange(len(cells))[:, None, None] + triangles).reshape(-1, 3)


def shifted(part, shift):
    """A copy elsewhere; shift None: the same."""
    if shift is None:
        return part
    moved = {**part, "pose": [[*row[:3], row[3] + d] for row, d in zip(part["pose"], [*shift, 0])]}
    if "track" in part:
        moved["track"] = {"t": part["track"]["t"], "p": [[x + d for x, d in zip(p, shift)] for p in part["track"]["p"]]}
    return moved


def ball(place, radius, colour, track=None):
    """A mark."""
    pose = np.eye(4)
    pose[:3, 3] = place
    return {"kind": "sphere", "radius": radius, "colour": colour, "pose": pose.tolist()} | ({"track": track} if track else {})


def base_at(shift):
    """Base of a run that stands elsewhere, or None."""
    return None if shift is None else [[1, 0, 0, shift[0]], [0, 1, 0, shift[1]], [0, 0, 1, shift[2]], [0, 0, 0, 1]]


def beside(distance):
    """A shift to the right of the first picture."""
    return [0.785 * distance, 0.62 * distance, 0.0]


def scene(arms, runs=(), objects=(), ground=None, **more):
    """What vispView() gets.

    runs: name, colour, arm (index), t, q, base, states ([[time, text]...]). objects: kind and its numbers, pose, colour, wire, there (from, until),
    track (t, and pose or p). more: sides ([{base, run}, ...]: one run on each, chosen by the reader), pictures (t and uri: what a camera sees).
    """
    return {"arms": list(arms), "runs": list(runs), "objects": list(objects), "ground": ground} | more
