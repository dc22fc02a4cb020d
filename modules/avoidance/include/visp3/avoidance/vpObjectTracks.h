/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpObjectTracks.h
 * \brief Tracks moving obstacles from sightings: current pose, velocity and uncertainty of each.
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
 * \brief One observation of an object by a sensor.
 */
struct VISP_EXPORT vpObjectSighting {
  std::string name;                                        //!< Identifier of the object; not empty.
  vpCollisionShape shape = vpCollisionShape::sphere(0.05); //!< Shape in the object's frame.
  vpRigidTransform pose;                                   //!< Pose fMo at #time: object in the arm's base, m.
  double time = 0.;                                        //!< Time of exposure, s, on the clock of vpObjectTracks.
  double positionSigma = 0.002;                            //!< Standard deviation of each position coordinate, m, > 0.
  double angleSigma = 0.01;                                //!< Standard deviation of each rotation component, rad, > 0.
};

/*!
 * \ingroup group_avoidance
 * \brief Parameters of vpObjectTracks.
 *
 * Random accelerations are white noise of density q = acceleration^2 persistence (m^2/s^3): after a time t the standard
 * deviation of the velocity change is sqrt(q t), that of the position sqrt(q t^3 / 3), at any rate of sightings.
 */
struct VISP_EXPORT vpObjectTrackSpec {
  double acceleration = 0.5;       //!< Sigma of random object accelerations, m/s^2, > 0. Large: fast, noisy.
  double angularAcceleration = 1.; //!< Sigma of random angular accelerations, rad/s^2, > 0.
  double persistence = 0.1;        //!< Typical duration of a random acceleration, s, > 0.
  double restAcceleration = 0.02;  //!< #acceleration of objects at rest that are currently unseen, m/s^2, >= 0.
  double startVelocity = 0.3;      //!< Initial sigma of each velocity component of a new track, m/s, > 0.
  double startTurn = 0.5;          //!< Initial sigma of each angular velocity component, rad/s, > 0.
  double gate = 5.;                //!< Gate in standard deviations; sightings outside are doubted, > 0.
  int doubts = 2;                  //!< Number of consecutive consistent doubted sightings that restart a track, >= 1.
  double restSigmas = 3.;          //!< A velocity below this number of its sigmas counts as rest, >= 0.
  double restSpeed = 0.03;     //!< Maximum speed that may count as rest, m/s, > 0: sets the number of sightings needed.
  double restTurn = 0.1;       //!< Maximum angular speed that may count as rest, rad/s, > 0.
  double inflationSigmas = 3.; //!< The shape is inflated by this number of position sigmas, >= 0.
  double maxInflation = 0.1;   //!< Maximum inflation, m, >= 0.
  double fresh = 0.15;         //!< Maximum time since the last sighting for vpTrackStatus::Tracked, s, >= 0.
  double coast = 0.5;          //!< Time for which an unseen object keeps moving, s, >= 0; then it stands.
  double forget = 5.;          //!< Time after which an unseen object is dropped, s, > 0; infinity: never.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

//! \ingroup group_avoidance
//! \brief Status of a track.
enum class vpTrackStatus {
  New,      //!< Seen once: no velocity yet.
  Tracked,  //!< Seen in the last frames.
  Coasting, //!< Not seen recently; extrapolated at its velocity.
  Lost      //!< Not seen for longer than vpObjectTrackSpec::coast; stays at its predicted pose.
};

//! \ingroup group_avoidance
//! \brief Status as a word ("Tracked"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *vpToString(vpTrackStatus status);

/*!
 * \ingroup group_avoidance
 * \brief One entry of the track table.
 */
struct VISP_EXPORT vpObjectTrack {
  std::string name;                                        //!< Name of the object.
  vpCollisionShape shape = vpCollisionShape::sphere(0.05); //!< Shape in the last sighting.
  vpRigidTransform pose;                                   //!< Current pose fMo, m.
  vpTwist velocity;          //!< Velocity of the origin, m/s, and angular, rad/s; axes of the base. Exactly 0 at rest.
  double positionSigma = 0.; //!< Current standard deviation of each position coordinate, m.
  double angleSigma = 0.;    //!< Current standard deviation of each rotation component, rad.
  double velocitySigma = 0.; //!< Standard deviation of each linear velocity component, m/s.
  double inflation = 0.;     //!< Inflation for vpCollisionObject, m: position and rotation, at the farthest point.
  double age = 0.;           //!< Time since the exposure of the last accepted sighting, s.
  int sightings = 0;         //!< Number of sightings since the track was started or restarted.
  int restarts = 0;          //!< Number of restarts because the object was seen at an implausible position.
  double confidence = 0.;    //!< 0..1: increases with sightings, decreases with age, doubts and restarts.
  bool resting = false;      //!< True if the sightings show no translation; it may rotate.
  vpTrackStatus status = vpTrackStatus::New; //!< Status of the track.
};

/*!
 * \class vpObjectTracks
 * \ingroup group_avoidance
 * \brief Track table: input sightings with noise, latency and gaps; output objects with velocity and uncertainty.
 *
 * Each object has a constant-velocity Kalman filter for position and one for rotation (on SO(3), error in the axes of
 * the base). Sightings are valid at their times of exposure; the output is predicted to now. Unseen objects grow with
 * their uncertainty and are kept for a while: a hidden obstacle still exists.
 *
 * A line is fitted to as many of the last sightings as distinguish vpObjectTrackSpec::restSpeed from rest. If its slope
 * and scatter are within noise, the object is at rest: its position is their mean, its velocity exactly 0.
 *
 * A sighting outside the gate is not used. If several consecutive ones agree with each other, the track is restarted
 * there, which vpObjectTrack::restarts counts and vpObjectTrack::confidence reflects. Four times as many consecutive
 * ones that disagree do the same.
 *
 * \code
 * vpObjectTracks tracks;
 * vpObjectSighting box; // of a vpObstacleDetector or any other sensor
 * box.name = "box";
 * box.shape = vpCollisionShape::box({0.16, 0.11, 0.06}); // m
 * for (int i = 0; i < 50; ++i) {
 *   box.time = 0.04 * i;                      // of the exposure, s
 *   box.pose.p << 0.5, 0.1 * box.time, 0.2;   // in the base; +- positionSigma
 *   if (!tracks.add(box)) {
 *     std::cerr << "not used: too old, or not where it can be" << std::endl;
 *   }
 *   tracks.advance(box.time + 0.03); // now
 *   tracks.applyTo(scene);
 * }
 * const vpObjectTrack *track = tracks.find("box");
 * if (track != nullptr) {
 *   std::cout << vpToString(track->status) << ": " << track->velocity[1] << " +- " << track->velocitySigma << " m/s\n";
 * }
 * \endcode
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
   * Adds a sighting. Ignored are sightings older than the last one of their track, a minute ahead of the last
   * advance(), doubted ones, and invalid ones: without a name, with a number that is not finite, a position beyond
   * vpLargestLength or a standard deviation outside 1e-9 to 1e3 m or rad. Allocates for a new name. Call advance()
   * after adding all current sightings.
   * \return True if it was used.
   */
  bool add(const vpObjectSighting &sighting);
  /*!
   * Predicts every track to \e now, s, and drops expired ones. No allocation.
   * \return False, and nothing changes, for a time that is not finite, goes backwards, or jumps ahead by a minute; a
   * jump is accepted once the next time continues from there.
   */
  bool advance(double now);
  //! All tracks, at the time of the last advance().
  [[nodiscard]] const std::vector<vpObjectTrack> &tracks() const noexcept { return m_tracks; }
  //! Track of that name; null if there is none.
  [[nodiscard]] const vpObjectTrack *find(const std::string &name) const noexcept;

  /*!
   * Updates a scene, always the same one, from the tracks: objects are added, moved, given velocity and inflation, and
   * removed when their track is dropped. An object of the same name already in the scene is taken over; since it is
   * known to exist, it stays at its last pose, at rest, when its track is dropped. All other objects are unchanged.
   * Allocates when an object is added, removed or changes its shape.
   * \return True if it did.
   */
  bool applyTo(vpCollisionScene &scene);

private:
  struct Applied {
    std::string name;
    bool brought; // added by applyTo()
  };
  void refresh(std::size_t i) noexcept;
  bool place(vpCollisionScene &scene, const vpObjectTrack &track);
  bool withdraw(vpCollisionScene &scene);

  vpObjectTrackSpec m_spec;
  std::vector<vpObjectTrack> m_tracks;
  std::vector<vpTrackFilter> m_filters; // one for each track
  std::vector<Applied> m_applied;
  double m_now = -std::numeric_limits<double>::infinity();
  double m_doubted = std::numeric_limits<double>::quiet_NaN(); // rejected time, too far ahead
};

END_VISP_NAMESPACE
#endif
