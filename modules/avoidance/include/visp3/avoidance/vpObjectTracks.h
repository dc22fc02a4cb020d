/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpObjectTracks_h
#define vpObjectTracks_h

#include <visp3/avoidance/vpCollisionScene.h>

#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief One object as a sensor saw it once.
 */
struct VISP_EXPORT vpObjectSighting {
  std::string name;                                        //!< Which object: the same for the same one; not empty.
  vpCollisionShape shape = vpCollisionShape::sphere(0.05); //!< Its extent, in its own frame.
  vpRigidTransform pose;                                   //!< fMo at #time: object in the arm's base, m.
  double time = 0.;                                        //!< Of the exposure, s, on one clock with vpObjectTracks.
  double positionSigma = 0.002;                            //!< Standard deviation of each coordinate, m, > 0.
  double angleSigma = 0.01;                                //!< Of each component of the rotation, rad, > 0.
};

/*!
 * \ingroup group_avoidance
 * \brief Parameters of vpObjectTracks.
 */
struct VISP_EXPORT vpObjectTrackSpec {
  double acceleration = 0.5;       //!< Of objects, unforeseen: standard deviation, m/s^2, > 0. Large: quick, noisy.
  double angularAcceleration = 1.; //!< The same in rad/s^2, > 0.
  double gate = 5.;                //!< A sighting farther than so many standard deviations is doubted, > 0.
  int doubts = 2;                  //!< So many doubted sightings in a row start the track anew, >= 1.
  double restSigmas = 3.;          //!< A velocity below so many of its standard deviations counts as rest, >= 0.
  double inflationSigmas = 3.;     //!< The shape counts as so many standard deviations of its place thicker, >= 0.
  double maxInflation = 0.1;       //!< At most, m, >= 0.
  double coast = 0.5;              //!< Without a sighting an object moves on for so long, s, >= 0; then it stays.
  double forget = 5.;              //!< Without a sighting for so long it is dropped, s, > 0; infinity: never.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

//! \brief What is known of an object.
enum class vpTrackStatus {
  New,      //!< Seen once: no velocity yet.
  Tracked,  //!< Seen in the last frames.
  Coasting, //!< Not seen for a while; moves on as it did.
  Lost      //!< Not seen for longer than vpObjectTrackSpec::coast; stays where it was thought to be.
};

/*!
 * \ingroup group_avoidance
 * \brief One row of the table.
 */
struct VISP_EXPORT vpObjectTrack {
  std::string name;                          //!< Of the sightings.
  vpCollisionShape shape;                    //!< Of the last sighting.
  vpRigidTransform pose;                     //!< fMo now, m.
  vpTwist velocity;                          //!< Of the object's origin, and angular; axes of the base; m/s, rad/s.
  double positionSigma = 0.;                 //!< Standard deviation of each coordinate now, m.
  double velocitySigma = 0.;                 //!< Of each component of the linear velocity, m/s.
  double inflation = 0.;                     //!< For vpCollisionObject, m.
  double age = 0.;                           //!< Since the exposure of the last sighting, s.
  int sightings = 0;                         //!< How often it was seen.
  double confidence = 0.;                    //!< 0..1: grows with sightings, falls with age and with doubts.
  vpTrackStatus status = vpTrackStatus::New; //!< How good that is.
};

/*!
 * \class vpObjectTracks
 * \ingroup group_avoidance
 * \brief Track table: sightings with noise, latency and gaps in, objects with velocity and uncertainty out.
 *
 * Each object has a Kalman filter of constant velocity for position and one for rotation (on SO(3), error in the axes of
 * the base). Sightings count at their times of exposure; what is asked for is predicted to now. What is not seen any more
 * grows by its uncertainty and is not forgotten at once: an obstacle that hides is still there.
 */
class VISP_EXPORT vpObjectTracks
{
public:
  //! \throw vpException (badValue), see vpObjectTrackSpec::validate().
  explicit vpObjectTracks(const vpObjectTrackSpec &spec = {});

  /*!
   * A sensor saw an object. Sightings that are older than the last one of their track, or not finite, are left out.
   * \return True when it was used.
   */
  bool add(const vpObjectSighting &sighting);
  //! Predicts every track to \e now, s, and drops the forgotten ones. Times that go back are left out.
  void advance(double now);
  //! All tracks, at the time of the last advance().
  [[nodiscard]] const std::vector<vpObjectTrack> &tracks() const noexcept { return m_tracks; }
  //! Track of that name; null when there is none.
  [[nodiscard]] const vpObjectTrack *find(const std::string &name) const noexcept;

  /*!
   * Brings the tracks into a scene: objects are added, moved, given velocity and inflation, and removed when their track
   * is gone. Objects that never were a track (fixed ones) stay as they are. Allocates when an object comes, goes or
   * changes its shape.
   * \return True when it did.
   */
  bool applyTo(vpCollisionScene &scene);

private:
  struct Filter {
    double time = 0.; // of the last sighting
    Eigen::Vector3d position = Eigen::Vector3d::Zero(), linear = Eigen::Vector3d::Zero();
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    Eigen::Vector3d angular = Eigen::Vector3d::Zero();
    Eigen::Matrix2d P = Eigen::Matrix2d::Zero(), Q = Eigen::Matrix2d::Zero(); // the same for each axis
    int doubted = 0;
  };

  vpObjectTrackSpec m_spec;
  std::vector<vpObjectTrack> m_tracks;
  std::vector<Filter> m_filters;
  std::vector<std::string> m_applied; // names that applyTo() brought into the scene
  double m_now = 0.;
};

END_VISP_NAMESPACE
#endif
