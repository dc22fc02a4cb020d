/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpAvoidanceMethods_h
#define vpAvoidanceMethods_h

#include <visp3/avoidance/vpAvoidanceMethod.h>

#include <memory>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief What all methods have in common, so that they are compared on equal terms.
 */
struct VISP_EXPORT vpAvoidanceMethodSpec {
  double period = 0.005;       //!< Of step(), s, > 0.
  double maxVelocity = 0.5;    //!< Of the end effector's origin, m/s, > 0 (thesis 8.3.4).
  double maxAcceleration = 1.; //!< Of the same, m/s^2, > 0.
  double margin = 0.01;        //!< Clearance that is kept, m, >= 0.
  unsigned int seed = 1;       //!< Of planners that sample, >= 1.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

//! Names for makeAvoidanceMethod(): potential, potential-corrected, dtg, dtg-via, planner, planner-dtg.
[[nodiscard]] VISP_EXPORT const std::vector<std::string> &avoidanceMethodNames();

/*!
 * A method by name, with its own parameters at their defaults.
 * \param scene : Must outlive the method.
 * \throw vpException (badValue) naming an unknown method with the known ones, or a field out of range;
 * (notImplementedError) for the planners where OMPL was missing.
 */
[[nodiscard]] VISP_EXPORT std::unique_ptr<vpAvoidanceMethod>
makeAvoidanceMethod(const std::string &name, const vpCollisionScene &scene, const vpAvoidanceMethodSpec &spec = {});

END_VISP_NAMESPACE
#endif
