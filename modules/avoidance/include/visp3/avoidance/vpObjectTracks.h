/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpObjectTracks.h
 * \brief From sightings of obstacles to obstacles that move: place, velocity and uncertainty of each, now.
 */
#ifndef vpObjectTracks_h
#define vpObjectTracks_h

#include <visp3/avoidance/vpCollisionScene.h>

#include <limits>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

class vpTrackFilter;

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
 *
 * Unforeseen accelerations are white noise of density q = acceleration^2 persistence (m^2/s^3): after a time t the
 * velocity has changed by sqrt(q t), one standard deviation, and the place by sqrt(q t^3 / 3), at any rate of sightings.
 */
struct VISP_EXPORT vpObjectTrackSpec {
  double acceleration = 0.5;       //!< Of objects, unforeseen: standard deviation, m/s^2, > 0. Large: quick, noisy.
  double angularAcceleration = 1.; //!< The same in rad/s^2, > 0.
  double persistence = 0.1;        //!< An unforeseen acceleration lasts about so long, s, > 0.
  double restAcceleration = 0.02;  //!< As #acceleration, for what is at rest and not seen now, m/s^2, >= 0.
  double startVelocity = 0.3;      //!< Of something just found: standard deviation of each component, m/s, > 0.
  double startTurn = 0.5;          //!< The same of its rotation, rad/s, > 0.
  double gate = 5.;                //!< A sighting farther than so many standard deviations is doubted, > 0.
  int doubts = 2;                  //!< So many doubted sightings in a row that agree start the track anew, >= 1.
  double restSigmas = 3.;          //!< A velocity below so many of its standard deviations counts as rest, >= 0.
  double restSpeed = 0.03;     //!< Nothing faster may count as rest, m/s, > 0: decides how many sightings that takes.
  double restTurn = 0.1;       //!< The same of the rotation, rad/s, > 0.
  double inflationSigmas = 3.; //!< The shape counts as so many standard deviations of its place thicker, >= 0.
  double maxInflation = 0.1;   //!< At most, m, >= 0.
  double fresh = 0.15;         //!< Seen within that time it is vpTrackStatus::Tracked, s, >= 0.
  double coast = 0.5;          //!< Without a sighting an object moves on for so long, s, >= 0; then it stays.
  double forget = 5.;          //!< Without a sighting for so long it is dropped, s, > 0; infinity: never.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

//! \ingroup group_avoidance
//! \brief What is known of an object.
enum class vpTrackStatus {
  New,      //!< Seen once: no velocity yet.
  Tracked,  //!< Seen in the last frames.
  Coasting, //!< Not seen for a while; moves on as it did.
  Lost      //!< Not seen for longer than vpObjectTrackSpec::coast; stays where it was thought to be.
};

//! \ingroup group_avoidance
//! \brief The status as a word ("Tracked"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *toString(vpTrackStatus status);

/*!
 * \ingroup group_avoidance
 * \brief One row of the table.
 */
struct VISP_EXPORT vpObjectTrack {
  std::string name;                                        //!< Of the sightings.
  vpCollisionShape shape = vpCollisionShape::sphere(0.05); //!< Of the last sighting.
  vpRigidTransform pose;                                   //!< fMo now, m.
  vpTwist velocity;          //!< Of the object's origin, and angular; axes of the base; m/s, rad/s. At rest exactly 0.
  double positionSigma = 0.; //!< Standard deviation of each coordinate now, m.
  double angleSigma = 0.;    //!< Of each component of the rotation now, rad.
  double velocitySigma = 0.; //!< Of each component of the linear velocity, m/s.
  double inflation = 0.;     //!< For vpCollisionObject, m: for place and rotation, at the point farthest out.
  double age = 0.;           //!< Since the exposure of the last sighting that was used, s.
  int sightings = 0;         //!< How often it was seen since it was found or started anew.
  int restarts = 0;          //!< How often it was found somewhere else than it could be and was started anew.
  double confidence = 0.;    //!< 0..1: grows with sightings, falls with age, doubts and restarts.
  bool resting = false;      //!< Does not move, as far as the sightings tell; it may turn.
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
 *
 * A line is fitted through as many of the last sightings as tell vpObjectTrackSpec::restSpeed from rest. When its slope
 * and its scatter are those of noise, the object is at rest: its place is their mean, its velocity exactly 0.
 *
 * A sighting outside the gate is not used. When several in a row agree with each other the object is there: the track is
 * started anew, which vpObjectTrack::restarts counts and vpObjectTrack::confidence shows. Four times as many in a row
 * that do not agree do the same.
 */
class VISP_EXPORT vpObjectTracks
{
public:
  //! \throw vpException (badValue), see vpObjectTrackSpec::validate().
  explicit vpObjectTracks(const vpObjectTrackSpec &spec = {});
  vpObjectTracks(const vpObjectTracks &other);                //!< Copies.
  vpObjectTracks(vpObjectTracks &&other) noexcept;            //!< Moves.
  vpObjectTracks &operator=(const vpObjectTracks &other);     //!< Copies.
  vpObjectTracks &operator=(vpObjectTracks &&other) noexcept; //!< Moves.
  ~vpObjectTracks();

  /*!
   * A sensor saw an object. Left out are sightings older than the last one of their track, a minute ahead of the last
   * advance(), doubted ones, and broken ones: without a name, with a number that is not finite, a place beyond
   * vpLargestLength or a standard deviation that is not within 1e-9 and 1e3 m or rad. Allocates for a new name. Call advance() when all sightings of the moment are in.
   * \return True when it was used.
   */
  bool add(const vpObjectSighting &sighting);
  /*!
   * Predicts every track to \e now, s, and drops the forgotten ones. No allocation.
   * \return False, and nothing changes, for a time that is not finite, goes back, or is a minute ahead of the last one, until
   * the next one goes on from there.
   */
  bool advance(double now);
  //! All tracks, at the time of the last advance().
  [[nodiscard]] const std::vector<vpObjectTrack> &tracks() const noexcept { return m_tracks; }
  //! Track of that name; null when there is none.
  [[nodiscard]] const vpObjectTrack *find(const std::string &name) const noexcept;

  /*!
   * Brings the tracks into a scene, always the same one: objects are added, moved, given velocity and inflation, and
   * removed when their track is gone. An object of that name that was in the scene before is taken over; it is known to
   * exist, so it stays, at rest, where it was last when its track is gone. All other objects stay as they are. Allocates
   * when an object comes, goes or changes its shape.
   * \return True when it did.
   */
  bool applyTo(vpCollisionScene &scene);

private:
  struct Applied {
    std::string name;
    bool brought; // by applyTo(), and not there before
  };
  void refresh(std::size_t i) noexcept;
  bool place(vpCollisionScene &scene, const vpObjectTrack &track);
  bool withdraw(vpCollisionScene &scene);

  vpObjectTrackSpec m_spec;
  std::vector<vpObjectTrack> m_tracks;
  std::vector<vpTrackFilter> m_filters; // one for each track
  std::vector<Applied> m_applied;
  double m_now = -std::numeric_limits<double>::infinity();
  double m_doubted = std::numeric_limits<double>::quiet_NaN(); // time that was too far ahead
};

END_VISP_NAMESPACE
#endif
