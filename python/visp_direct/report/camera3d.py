# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Cameras and flat targets in the 3D view, as camera3d.js draws them."""
import io

import numpy as np

from .page import data_uri

# For a camera that nothing carries: an arm without links, whose configuration is empty.
NO_ARM = {
    "name": "",
    "joints": [],
    "chain": [],
    "tool_link": 0,
    "tool": np.eye(4).tolist(),
    "home": [],
    "links": [{"shapes": [], "capsules": []}],
}
Z_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])  # a camera's first frame in a world whose z is up
PICTURE = 640  # px, largest side of a target's photograph in a page
POSES = 240  # at most, of a run


def matrices(translations, rotations):
    """n x 4 x 4 poses of n x 3 translations and n x 3 rotation vectors (theta u)."""
    t, r = np.asarray(translations, float), np.asarray(rotations, float)
    angle = np.linalg.norm(r, axis=1)[:, None, None]
    K = np.zeros((len(r), 3, 3))
    K[:, 2, 1], K[:, 0, 2], K[:, 1, 0] = r.T
    K[:, 1, 2], K[:, 2, 0], K[:, 0, 1] = -r.T
    M = np.tile(np.eye(4), (len(r), 1, 1))
    M[:, :3, :3] += np.sinc(angle / np.pi) * K + 0.5 * np.sinc(angle / (2 * np.pi)) ** 2 * K @ K
    M[:, :3, 3] = t
    return M


def columns(table, prefix="", kinds=("tx", "ty", "tz", "tux", "tuy", "tuz")):
    """Poses of six columns of a log."""
    six = np.array([table[prefix + kind] for kind in kinds])
    return matrices(six[:3].T, six[3:].T)


def chosen(count, most=POSES):
    """Indices of at most so many rows, evenly, with the first and the last."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))


def rows(poses):
    """Poses as camera3d.js takes them: 12 numbers each."""
    return np.asarray(poses)[:, :3, :].reshape(-1, 12).round(5).tolist()


def corners(size):
    """Of a plate, homogeneous, 4 x 4: a column each."""
    x, y = np.asarray(size) / 2
    return np.array([[-x, x, x, -x], [-y, -y, y, y], np.zeros(4), np.ones(4)])


def outline(cMo, size):
    """Corners of a plate in the image plane z = 1; none where one is behind the camera."""
    p = np.asarray(cMo) @ corners(size)
    return (p[:2] / p[2]).T.round(5).tolist() if (p[2] > 0).all() else []


def camera(intrinsics, poses, depth, goals):
    """A camera of a run. intrinsics: px, py, u0, v0, width, height, without distortion. goals: [[from when (s), outline], ...]."""
    lens = [
        (edge - 0.5 - intrinsics[centre]) / intrinsics[focal]  # left, right, top, bottom at z = 1
        for focal, centre, size in (("px", "u0", "width"), ("py", "v0", "height"))
        for edge in (0, intrinsics[size])
    ]
    return {"pose": rows(poses), "lens": lens, "depth": round(float(depth), 4), "goals": goals}


def plate(size, pose, picture=None, track=None):
    """A flat target. picture: as a data URI. track: {"t", "pose"} where it moves."""
    part = {"kind": "plate", "size": list(size), "pose": np.asarray(pose).tolist(), "colour": "#e9e2cf"}
    return part | ({"picture": picture} if picture else {}) | ({"track": track} if track else {})


def photograph(data):
    """A picture file as a data URI, smaller; None without data."""
    from PIL import Image

    if data is None:
        return None
    image = Image.open(io.BytesIO(data)).convert("L")
    image.thumbnail((PICTURE, PICTURE))
    buffer = io.BytesIO()
    image.save(buffer, "JPEG", quality=80)
    return data_uri(buffer.getvalue())
