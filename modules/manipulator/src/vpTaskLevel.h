/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// One level of a hierarchy of tasks B y = r in weighted joint coordinates: inverse, damping, and what is left for the
// next level.
#ifndef vpTaskLevel_h
#define vpTaskLevel_h

#include <visp3/manipulator/vpArmTypes.h>

BEGIN_VISP_NAMESPACE

namespace vpTaskLevel
{
// Everything has the full capacity and is padded with zeros: fixed sizes are several times faster than counted ones.
using Joints = Eigen::Matrix<double, vpArmMaxJoints, 1>;
using Square = Eigen::Matrix<double, vpArmMaxJoints, vpArmMaxJoints>;
using Rows = Eigen::Matrix<double, vpArmMaxJoints, 6>; // a column for each row of the task
using Task = Eigen::Matrix<double, 6, 1>;

//! Orthonormal vectors that are spoken for.
struct Basis {
  Square vectors;
  int count = 0;
  //! Part of a vector that is free.
  [[nodiscard]] Joints free(Joints z) const
  {
    // Twice is enough, once is not when little is left.
    for (int pass = 0; pass < 2; ++pass) {
      for (int i = 0; i < count; ++i) {
        z -= vectors.col(i) * vectors.col(i).dot(z);
      }
    }
    return z;
  }
  //! One more unit vector, perpendicular to the others; a full basis stays as it is.
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
  Task lost = Task::Zero(); // direction of the task that belongs to it, when singular
};

//! Adds to y the motion that brings B y nearest to r within what the basis leaves free, and to the basis what it takes.
Info solve(const Rows &B, const Task &r, int rows, const Options &options, Basis &basis, Joints &y);
} // namespace vpTaskLevel

END_VISP_NAMESPACE
#endif
