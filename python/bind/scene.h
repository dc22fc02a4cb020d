/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef scene_h
#define scene_h

#include "binding.h"

#include <visp3/avoidance/vpCollisionScene.h>

namespace visp_python
{
//! Tracks of objects, and maps from depth images.
void bindPerception(py::module_ &m);
//! The arm's capsules in a configuration; memory of this thread, valid until its next call. \throw ValueError for another
//! number of joints.
const vpCollisionData &placed(const vpCollisionScene &scene, const vpJointVector &q);
} // namespace visp_python
#endif
