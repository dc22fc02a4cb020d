/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// One level of a hierarchy of tasks B y = r in weighted joint coordinates: inverse, damping, and the remaining space
// for the next level.
#ifndef vpTaskLevel_h
#define vpTaskLevel_h

#include <visp3/manipulator/vpArmTypes.h>

BEGIN_VISP_NAMESPACE

namespace vpTaskLevel
{
// Matrices have the full capacity, padded with zeros: fixed sizes are several times faster than dynamic ones.
using Joints = Eigen::Matrix<double, vpArmMaxJoints, 1>;
using Square = Eigen::Matrix<double, vpArmMaxJoints, vpArmMaxJoints>;
using Rows = Eigen::Matrix<double, vpArmMaxJoints, 6>; // one column per row of the task
using Task = Eigen::Matrix<double, 6, 1>;

//! Orthonormal basis of the space already used.
struct Basis {
  Square vectors;
  int count = 0;
  //! Component of a vector in the free space.
  [[nodiscard]] Joints free(Joints z) const
  {
    // Twice suffices; once does not if the remainder is small.
    for (int pass = 0; pass < 2; ++pass) {
      for (int i = 0; i < count; ++i) {
        z -= vectors.col(i) * vectors.col(i).dot(z);
      }
    }
    return z;
  }
  //! Adds a unit vector, perpendicular to the others; a full basis is unchanged.
  void add(const Joints &unit)
  {
    if (count < vpArmMaxJoints) {
      vectors.col(count++) = unit;
    }
  }
};

struct Options {
  double singularRegion; // s0: damping acts on singular values below it
  double damping;        // lambda at a singular value of 0
};

struct Info {
  bool singular = false;    // a singular value was below s0
  double smallest = 0.;     // singular value; a lower bound when not singular
  Task lost = Task::Zero(); // its task direction, when singular
};

//! Adds to y the motion in the free space that brings B y nearest to r, and extends the basis by the space used.
Info solve(const Rows &B, const Task &r, int rows, const Options &options, Basis &basis, Joints &y);
} // namespace vpTaskLevel

END_VISP_NAMESPACE
#endif
