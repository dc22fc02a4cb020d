/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpPoseSensor_h
#define vpPoseSensor_h

#include "lab/avoidance/vpObstacleSensor.h"

#include <optional>
#include <random>

BEGIN_VISP_NAMESPACE

/*!
 * \brief How good a vpPoseSensor is.
 */
struct vpPoseSensorSpec {
  double positionNoise = 0.002;       //!< Standard deviation of each coordinate, m, > 0; told in the sightings.
  double angleNoise = 0.01;           //!< Of each component of the rotation, rad, > 0; told in the sightings.
  double range = 2.;                  //!< Objects whose origin is farther from the eye are not seen, m, > 0.
  double missed = 0.;                 //!< Part of the sightings in range that fail, at random, 0..1.
  std::optional<Eigen::Vector3d> eye; //!< Fixed place in the base, m; none: the camera in the hand.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \class vpPoseSensor
 * \brief Poses of the objects with noise, as a vision system reports them that finds an object wherever it looks: there
 * is a range, but nothing hides behind anything. Knows the objects' shapes and tells them apart.
 */
class vpPoseSensor : public vpObstacleSensor
{
public:
  /*!
   * \param names : Objects that can be seen; all others are taken for known. \param seed : Of noise and failures. Each
   * object has its own stream, one draw an exposure, whether it is seen or not.
   * \param spec : Range, noise and failures.
   * \throw vpException (badValue), see vpPoseSensorSpec::validate().
   */
  vpPoseSensor(const std::vector<std::string> &names, const vpPoseSensorSpec &spec, unsigned int seed);

  void look(const vpCollisionScene &truth, const vpCollisionData &arm, double time,
            std::vector<vpObjectSighting> &result) VP_OVERRIDE;

private:
  struct Object {
    std::string name;
    std::mt19937_64 random;
  };

  vpPoseSensorSpec m_spec;
  std::vector<Object> m_objects;
};

END_VISP_NAMESPACE
#endif
