/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpObstacleSensor.h
 * \brief What a simulated obstacle sensor gives, and the simplest one: noisy poses.
 */
#ifndef vpObstacleSensor_h
#define vpObstacleSensor_h

#include <visp3/avoidance/vpObjectTracks.h>

#include <optional>
#include <random>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpObstacleSensor
 * \brief Simulated obstacle sensor: gives the sightings of the true scene at one exposure.
 */
class vpObstacleSensor
{
public:
  virtual ~vpObstacleSensor() = default;

  /*!
   * \param truth : True scene at \e time. \param arm : True configuration at \e time, after place().
   * \param time : Time of exposure, s; becomes vpObjectSighting::time. \param result : Replaced by the sightings.
   */
  virtual void look(const vpCollisionScene &truth, const vpCollisionData &arm, double time,
                    std::vector<vpObjectSighting> &result) = 0;
};

/*!
 * \brief Parameters of vpPoseSensor.
 */
struct vpPoseSensorSpec {
  double positionNoise = 0.002; //!< Standard deviation of each coordinate, m, > 0; reported in the sightings.
  double angleNoise = 0.01;     //!< Sigma of each rotation component, rad, > 0; reported in the sightings.
  double range = 2.;            //!< Maximum distance of an object's origin from the viewpoint, m, > 0.
  double missed = 0.;           //!< Fraction of the sightings in range that are missed at random, 0..1.
  std::optional<Eigen::Vector3d> viewpoint; //!< Fixed position in the base, m; none: the camera in the hand.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \class vpPoseSensor
 * \brief Noisy object poses of an ideal vision system: limited range, but no occlusion and no field of view. Object
 * shapes and identities are known.
 */
class vpPoseSensor : public vpObstacleSensor
{
public:
  /*!
   * \param names : Objects that can be seen; all others are assumed known. \param seed : Seed of noise and misses. Each
   * object has its own stream with one draw per exposure, whether it is seen or not.
   * \param spec : Range, noise and misses.
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
