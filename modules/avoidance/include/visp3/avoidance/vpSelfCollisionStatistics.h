/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpSelfCollisionStatistics.h
 * \brief Finds the pairs of an arm's capsules that always or never touch.
 */
#ifndef vpSelfCollisionStatistics_h
#define vpSelfCollisionStatistics_h

#include <visp3/avoidance/vpCollisionScene.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief Contacts of two capsules in random configurations within the limits (continuous joints: within +-pi).
 */
struct VISP_EXPORT vpSelfPairStatistics {
  vpSelfPair pair;   //!< The capsules.
  int samples = 0;   //!< Number of configurations.
  int touching = 0;  //!< Number of configurations with a clearance <= 0.
  double least = 0.; //!< Least clearance seen, m.

  //! True if they touched in every sample: allow such a pair.
  [[nodiscard]] bool always() const noexcept { return touching == samples; }
  //! True if they never touched. An estimate, not a proof: keep checking the pair unless time is critical.
  [[nodiscard]] bool never() const noexcept { return touching == 0; }
};

/*!
 * \ingroup group_avoidance
 * \brief Statistics of all self pairs of a scene; with allowAdjacent = false, of all pairs on different links.
 * \param scene : Provides arm, capsules and allowed contacts; its objects are ignored.
 * \param samples : Number of configurations, > 0.
 * \param seed : The same seed gives the same configurations.
 * \throw vpException (badValue) naming samples and its value.
 */
[[nodiscard]] VISP_EXPORT std::vector<vpSelfPairStatistics>
vpSampleSelfPairs(const vpCollisionScene &scene, int samples = 10000, unsigned int seed = 1);

END_VISP_NAMESPACE
#endif
