/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpArmDriveGains.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double naturalFrequency = 12.;   // rad/s, at least
constexpr double coulombError = 1. / 300.; // rad or m, at most, at rest
constexpr double viscousLag = 1. / 200.;   // s, at most: position error over velocity
constexpr double mostOfInertia = 0.5;      // see stableShare()
constexpr int inertiaSamples = 200;
constexpr int mostPasses = 20;

// Inertia matrices of random configurations.
std::vector<vpJointMatrix> inertiasOf(const vpArmModel &model)
{
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> share(0., 1.);
  vpArmDynamics dynamics(model);
  std::vector<vpJointMatrix> all(inertiaSamples);
  for (vpJointMatrix &M : all) {
    vpJointVector q(model.size());
    for (int i = 0; i < model.size(); ++i) {
      const double lower = model.isContinuous(i) ? -M_PI : model.lower()(i);
      const double upper = model.isContinuous(i) ? M_PI : model.upper()(i);
      q(i) = lower + share(rng) * (upper - lower);
    }
    dynamics.inertia(q, M);
  }
  return all;
}

// The plant integrates M v' = -K x - D v by semi-implicit steps h: with central differences the mass is M - h D / 2,
// and all modes are stable if it exceeds h^2 K / 4. Thus S = h D / 2 + h^2 K / 4 may take this share of M. An estimated
// velocity lags by 2 / bandwidth and needs D / M below half of the bandwidth.
double stableShare(const vpArmDriveSpec &spec)
{
  const double estimated = 0.25 * spec.period * vpDriveEstimatorBandwidth;
  return spec.encoderNoise > 0. ? std::min(mostOfInertia, estimated) : mostOfInertia;
}

// Stiffness k with S = most, where D = 2 sqrt(k inertia).
double stiffestOf(double most, double inertia, double period)
{
  const double root = 2. / period * (std::sqrt(inertia + most) - std::sqrt(inertia));
  return root * root;
}

// Reduces the joints of the mode with the largest S / M until all modes of all samples are within the share.
void reduce(vpJointVector &S, const std::vector<vpJointMatrix> &all, double share)
{
  for (int pass = 0; pass < mostPasses; ++pass) {
    double largest = 0.;
    vpJointVector part;
    for (const vpJointMatrix &M : all) {
      const Eigen::GeneralizedSelfAdjointEigenSolver<vpJointMatrix> solver(vpJointMatrix(S.asDiagonal()), M);
      const double here = solver.eigenvalues().maxCoeff();
      if (here > largest) {
        largest = here;
        part = S.cwiseProduct(solver.eigenvectors().rightCols<1>().cwiseAbs2()); // the sum is the eigenvalue
      }
    }
    if (!(largest > share * (1. + 1e-9))) {
      return;
    }
    const double mean = part.sum() / static_cast<double>(S.size());
    for (Eigen::Index i = 0; i < S.size(); ++i) {
      S(i) *= part(i) >= mean ? share / largest : 1.;
    }
  }
}

vpJointVector stiffnessOf(const vpArmModel &model, const vpArmDriveSpec &spec, const std::vector<vpJointMatrix> &all,
                          const vpJointVector &inertia)
{
  const int n = model.size();
  const double share = stableShare(spec), h = spec.period;
  vpJointVector most = share * inertia, stiffness(n);
  for (const vpJointMatrix &M : all) { // 1 / (M^-1)_ii: inertia of a joint if the others give way
    most = most.cwiseMin(share * M.llt().solve(vpJointMatrix::Identity(n, n)).diagonal().cwiseInverse());
  }
  vpJointVector S(n);
  for (int i = 0; i < n; ++i) {
    const vpArmJointSpec &joint = model.spec().joints[static_cast<std::size_t>(i)];
    stiffness(i) = std::max(
        {inertia(i) * naturalFrequency * naturalFrequency, joint.coulomb / coulombError, joint.viscous / viscousLag});
    stiffness(i) = std::min(stiffness(i), stiffestOf(most(i), inertia(i), h));
    S(i) = h * std::sqrt(stiffness(i) * inertia(i)) + 0.25 * h * h * stiffness(i);
  }
  reduce(S, all, share);
  for (int i = 0; i < n; ++i) {
    stiffness(i) = std::min(stiffness(i), stiffestOf(S(i), inertia(i), h));
  }
  return stiffness;
}
} // namespace

vpJointPositionControlSpec vpDriveControlOf(const vpArmModel &model, const vpArmDriveSpec &spec)
{
  const int n = model.size();
  const std::vector<vpArmJointSpec> &joints = model.spec().joints;
  vpJointPositionControlSpec control;
  control.kp.setZero(n);
  control.kd.setZero(n);
  const auto given = [](const vpArmJointSpec &joint) { return joint.kp > 0.; };
  if (!std::all_of(joints.begin(), joints.end(), given)) {
    const std::vector<vpJointMatrix> all = inertiasOf(model);
    vpJointVector inertia = vpJointVector::Zero(n);
    for (const vpJointMatrix &M : all) {
      inertia = inertia.cwiseMax(M.diagonal());
    }
    control.kp = stiffnessOf(model, spec, all, inertia);
    control.kd = 2. * control.kp.cwiseProduct(inertia).cwiseSqrt();
  }
  for (int i = 0; i < n; ++i) {
    const vpArmJointSpec &joint = joints[static_cast<std::size_t>(i)];
    control.kp(i) = given(joint) ? joint.kp : control.kp(i);
    control.kd(i) = given(joint) ? joint.kd : control.kd(i);
  }
  control.kp = spec.kp.size() > 0 ? spec.kp : control.kp;
  control.kd = spec.kd.size() > 0 ? spec.kd : control.kd;
  control.maxTorque = model.torque();
  control.compensateFriction = spec.compensateFriction;
  control.friction = vpJointFriction::of(model);
  return control;
}

END_VISP_NAMESPACE
