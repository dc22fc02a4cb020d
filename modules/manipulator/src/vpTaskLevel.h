/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTaskLevel.h
 * \brief What the redundancy solver computes at one level of its hierarchy of tasks, and at a singularity.
 */
#ifndef vpTaskLevel_h
#define vpTaskLevel_h

#include <visp3/manipulator/vpArmKinematics.h>
#include <visp3/manipulator/vpArmTypes.h>

BEGIN_VISP_NAMESPACE

/*!
 * One level of a hierarchy of tasks B y = r in weighted joint coordinates: inverse, damping, and the remaining space
 * for the next level. For arms of up to N joints: matrices have this capacity, padded with zeros, because fixed sizes
 * are several times faster than dynamic ones. Compiled for 8 and for vpArmMaxJoints.
 */
template <int N> struct vpTaskLevel {
  using Joints = Eigen::Matrix<double, N, 1>;
  using Square = Eigen::Matrix<double, N, N>;
  using Rows = Eigen::Matrix<double, N, 6>; // one column per row of the task
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
      if (count < N) {
        vectors.col(count++) = unit;
      }
    }
  };

  struct Options {
    double singularRegion; // s0: damping acts on singular values below it
    double damping;        // lambda at a singular value of 0
    int lacking = 0;       // number of directions of the task for which the arm has no joints
  };

  struct Info {
    bool singular = false;    // a singular value was below s0
    double smallest = 0.;     // singular value; a lower bound when not singular
    Task lost = Task::Zero(); // its task direction, when singular
    // Directions of the task that the arm lacks, as many as Options::lacking; not counted as singular.
    Eigen::Matrix<double, 6, 6> lacking;
  };

  //! Adds to y the motion in the free space that brings B y nearest to r, and extends the basis by the space used.
  static Info solve(const Rows &B, const Task &r, int rows, const Options &options, Basis &basis, Joints &y);
};

//! Self-motion that leads out of a singularity.
template <int N> struct vpSingularityEscape {
  using Level = vpTaskLevel<N>;
  using Joints = typename Level::Joints;
  using Square = typename Level::Square;

  /*!
 * H(k, l) = lost . dJ_l/dq_k in weighted coordinates: after a time t of the motion y the task velocity in the lost
 * direction is t y^T H y, because lost . J is about zero.
 */
  static Square curvature(const vpArmModel &model, const vpArmData &data, vpArmFrame frame,
                          const Eigen::Matrix<double, 6, 1> &lost, const Joints &scale);

  //! Orthonormal basis of the usable self-motion: the first count columns.
  struct Room {
    Square vectors = Square::Zero();
    int count = 0;
  };

  //! Complement of a set of orthonormal vectors in the space of the movable joints.
  static Room room(const typename Level::Basis &taken, const Joints &mayMove);

  /*!
 * Unit vector z in the space that makes the lost direction reachable in the sense of the demand.
 * \param sense : +1 or -1, sign of the demand along the lost direction.
 * \param slope : Remaining reachability lost . J.
 * \param motion : Motion for the rest of the task.
 * \return False if there is none: the demand points out of the workspace.
 */
  static bool direction(const Room &space, const Square &H, double sense, const Joints &slope, const Joints &motion,
                        Joints &z);
};

END_VISP_NAMESPACE
#endif
