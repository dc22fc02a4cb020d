/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpSelfCollisionStatistics.h
 * \brief Finds the pairs of an arm's bodies that always or never touch.
 */
#ifndef vpSelfCollisionStatistics_h
#define vpSelfCollisionStatistics_h

#include <visp3/avoidance/vpCollisionScene.h>

#include <limits>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_avoidance
//! \brief Verdict of the statistics on a pair of bodies.
enum class vpContactRule {
  Checked, //!< Touches in some configurations: must be checked.
  Always,  //!< Touches in at least 95 % of the samples: a check would refuse nearly every configuration.
  Default, //!< Touches where all joints are at 0 (or at the limit next to it): an intended contact, as in MoveIt.
  Never    //!< Touched in no sample.
};

/*!
 * \ingroup group_avoidance
 * \brief Contacts of two bodies in the samples of a vpSelfCollisionStatistics.
 */
struct VISP_EXPORT vpBodyPairStatistics {
  std::string first;   //!< Name of the body nearer to the base.
  std::string second;  //!< Name of the other body.
  int touching = 0;    //!< Number of samples in which they touched.
  bool atZero = false; //!< They touch where all joints are at 0, or at the limit next to it.
  bool exact = false;  //!< By exact shapes; false: by capsules, which may touch where the bodies do not.
  //! Least clearance of their capsules in the samples, m.
  double least = std::numeric_limits<double>::infinity();
};

/*!
 * \ingroup group_avoidance
 * \brief How often the bodies of an arm touch each other in random configurations within the limits (continuous joints:
 * within +-pi); value type.
 *
 * An estimate, not a proof: a pair that never touched in N samples is in contact in less than 3/N of the
 * configurations, with 95 % confidence. Some arms have pairs that touch in one of 2000 configurations: take 10,000
 * samples or more.
 */
struct VISP_EXPORT vpSelfCollisionStatistics {
  std::string arm;                         //!< Label of the arm.
  int samples = 0;                         //!< Number of configurations.
  unsigned int seed = 1;                   //!< Seed of the configurations.
  std::vector<vpBodyPairStatistics> pairs; //!< All pairs on links that are neither the same nor neighbours.

  //! Verdict of the samples on a pair, in the order Always, Default, Never, Checked.
  [[nodiscard]] vpContactRule rule(const vpBodyPairStatistics &pair) const noexcept;
  /*!
   * Pairs that need no check, for vpArmSpec::allowedBodies.
   * \param never : Include those that never touched, as MoveIt's setup assistant does.
   */
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> allowed(bool never = true) const;

  //! Writes a JSON file, see data/robot/README.md. \throw vpException (ioError) naming the file and the reason.
  void save(const std::string &file) const;
  //! Reads such a file. \throw vpException (ioError, badValue) naming the file and the field.
  [[nodiscard]] static vpSelfCollisionStatistics load(const std::string &file);
};

/*!
 * \ingroup group_avoidance
 * \brief Statistics of all pairs of named bodies that have capsules, whether vpArmSpec::allowedBodies has them or not.
 *
 * \code
 * const vpSelfCollisionStatistics found = vpSampleBodyPairs(arm); // 10,000 configurations
 * for (const vpBodyPairStatistics &pair : found.pairs) {
 *   std::cout << pair.first << ", " << pair.second << ": touch in " << pair.touching << " configurations\n";
 * }
 * vpArmSpec spec = arm.spec();
 * spec.allowedBodies = found.allowed(false); // pairs that always touch
 * const vpCollisionScene usable{vpArmModel(spec)};
 * \endcode
 * \param arm : The arm; vpArmSpec::uncovered bodies and capsules without a body take no part.
 * \param exact : Its exact shapes, which decide where capsules touch; may be null.
 * \param samples : Number of configurations, > 0.
 * \param seed : The same seed gives the same configurations.
 * \throw vpException (badValue) naming samples and its value; as vpCollisionScene.
 */
[[nodiscard]] VISP_EXPORT vpSelfCollisionStatistics
vpSampleBodyPairs(const vpArmModel &arm, const std::shared_ptr<const vpExactShapes> &exact = nullptr,
                  int samples = 10000, unsigned int seed = 1);

END_VISP_NAMESPACE
#endif
