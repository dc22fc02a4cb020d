/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCollisionScene.h
 * \brief An arm among obstacles: what may touch what, and how near it is.
 */
#ifndef vpCollisionScene_h
#define vpCollisionScene_h

#include <visp3/avoidance/vpCollisionData.h>
#include <visp3/avoidance/vpCollisionObject.h>
#include <visp3/manipulator/vpArmModel.h>

#include <cstdint>
#include <utility>

BEGIN_VISP_NAMESPACE

struct vpCollisionCore;

/*!
 * \ingroup group_avoidance
 * \brief The ground: the side normal^T x < offset is forbidden. In the base frame.
 */
struct VISP_EXPORT vpHalfSpace {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(); //!< Points to the free side; of any length but 0.
  double offset = 0.;                                //!< m.
  int firstLink = 2; //!< Capsules of links below this one (1..n) stand on the ground and are not checked.
};

/*!
 * \ingroup group_avoidance
 * \brief A touch that is allowed: an object that a link carries or stands on.
 */
struct VISP_EXPORT vpAllowedContact {
  std::string object; //!< Name of an object.
  int link = 0;       //!< 1..n.
};

/*!
 * \ingroup group_avoidance
 * \brief What makes a scene. vpCollisionScene checks it.
 */
struct VISP_EXPORT vpCollisionSceneSpec {
  std::string source;                            //!< File it came from, for messages; may be empty.
  std::vector<vpCollisionObject> objects;        //!< Obstacles.
  std::optional<vpHalfSpace> ground;             //!< None: no ground.
  bool allowAdjacent = true;                     //!< Adjacent links may touch, see vpCollisionScene.
  std::vector<std::pair<int, int>> allowedLinks; //!< More pairs of links (0..n) that may touch.
  std::vector<vpAllowedContact> allowedContacts; //!< Links that may touch an object.
};

/*!
 * \ingroup group_avoidance
 * \brief Two capsules of the arm that must not touch.
 */
struct VISP_EXPORT vpSelfPair {
  int first = 0;  //!< Capsule on the link nearer to the base.
  int second = 0; //!< Capsule on the link farther out.
};

/*!
 * \class vpCollisionScene
 * \ingroup group_avoidance
 * \brief Arm and obstacles; the queries are const, do not allocate, throw or lock, and leave their scratch in a
 * vpCollisionData (one a thread).
 *
 * Set-up (constructor, add(), remove()) allocates and throws; moveObject(), setVelocity() and advance() belong to the
 * control cycle. No query may run while another thread changes the scene: give that thread its own copy.
 *
 * The arm is its capsules (vpArmSpec::capsules). Checked are: capsules of moving links against all objects, against the
 * ground, and against each other (3.48). Two links are adjacent when no link between them carries a capsule: with
 * capsules on links 1, 3, 5 and 7 the pairs (1, 3), (3, 5) and (5, 7). Capsules of the base (link 0) are checked
 * against the arm only, since no motion frees the base from an obstacle.
 */
class VISP_EXPORT vpCollisionScene
{
public:
  /*!
   * \throw vpException (badValue) naming the source, the element and the value: an arm without capsules or with more
   * than 32, an object without a name or with a duplicate name, a pose that is none, lengths that are not finite,
   * negative or above vpLargestLength, velocities above 1000 m/s or rad/s, a ground without normal, links or objects that
   * do not exist.
   */
  explicit vpCollisionScene(const vpArmModel &arm, const vpCollisionSceneSpec &spec = {});
  vpCollisionScene(const vpCollisionScene &other);                //!< Copies.
  vpCollisionScene(vpCollisionScene &&other) noexcept;            //!< Moves.
  vpCollisionScene &operator=(const vpCollisionScene &other);     //!< Copies.
  vpCollisionScene &operator=(vpCollisionScene &&other) noexcept; //!< Moves.
  ~vpCollisionScene();

  //! The arm.
  [[nodiscard]] const vpArmModel &arm() const noexcept { return m_arm; }
  //! Number of capsules of the arm.
  [[nodiscard]] int capsuleCount() const noexcept { return static_cast<int>(m_capsules.size()); }
  //! Capsule \e i in the moving frame of its joint (vpArmData::joint), link 0: in the base.
  [[nodiscard]] const vpArmCapsule &capsule(int i) const noexcept { return m_capsules[static_cast<std::size_t>(i)]; }
  //! Pairs of capsules that must not touch.
  [[nodiscard]] const std::vector<vpSelfPair> &selfPairs() const noexcept { return m_selfPairs; }
  //! The ground with a unit normal, if there is one.
  [[nodiscard]] const std::optional<vpHalfSpace> &ground() const noexcept { return m_ground; }
  //! Number of objects.
  [[nodiscard]] int objectCount() const noexcept { return static_cast<int>(m_objects.size()); }
  //! Object \e i, 0..objectCount()-1, where it stands now.
  [[nodiscard]] const vpCollisionObject &object(int i) const noexcept { return m_objects[static_cast<std::size_t>(i)]; }
  //! Index of an object, -1 when there is none of that name.
  [[nodiscard]] int find(const std::string &name) const noexcept;
  //! True when capsule \e capsule must not touch object \e object.
  [[nodiscard]] bool isChecked(int capsule, int object) const noexcept;
  //! True when capsule \e capsule must not touch the ground.
  [[nodiscard]] bool isCheckedWithGround(int capsule) const noexcept;

  //! Another number after every add() and remove(), unique among all scenes but copies: lists of pairs made for it hold.
  [[nodiscard]] unsigned long revision() const noexcept { return m_revision; }

  //! Adds an object and returns its index. Allocates. \throw vpException (badValue) as the constructor.
  int add(const vpCollisionObject &object);
  //! Removes object \e i; those behind it move up. \throw vpException (badValue) naming the index.
  void remove(int i);

  /*!
   * Puts object \e i to a new place. Does not allocate.
   * \return False, and nothing changes, when there is no such object, or the pose is no rigid transform within
   * vpLargestLength.
   */
  bool moveObject(int i, const vpRigidTransform &pose) noexcept;
  //! Sets the velocity of object \e i (axes of the base). False, and nothing changes, for a bad index or number.
  bool setVelocity(int i, const vpTwist &velocity) noexcept;
  //! Sets the inflation of object \e i, m, >= 0. False, and nothing changes, for a bad index or number.
  bool setInflation(int i, double inflation) noexcept;
  //! Moves every object on by its velocity for \e dt seconds. Does not allocate. False when one had to stay where it is,
  //! see moveObject().
  bool advance(double dt) noexcept;

  //! Places the arm in configuration \e q for the queries below. A configuration of another size, not finite or beyond
  //! vpLargestCoordinate is none (vpCollisionData::placed): then every query says that the arm is in collision.
  void place(const vpJointVector &q, vpCollisionData &data) const noexcept;
  /*!
   * True when a pair that must not touch has a clearance <= margin. Stops at the first.
   * \param data : After place().
   * \param margin : m, added to every pair.
   * \param time : s from now; objects count as moved on by their velocities. NaN, or beyond 1e6 s: in collision.
   */
  [[nodiscard]] bool inCollision(const vpCollisionData &data, double margin = 0., double time = 0.) const noexcept;
  /*!
   * The pair with the least clearance below \e cutoff (m); kind None and an infinite distance when there is none. A small
   * cutoff saves time. Parameters as inCollision(); what cannot be told is kind Unknown at -infinity.
   */
  [[nodiscard]] vpClearance clearance(const vpCollisionData &data,
                                      double cutoff = std::numeric_limits<double>::infinity(),
                                      double time = 0.) const noexcept;
  //! All pairs with a clearance below \e cutoff (m). Parameters as inCollision(); what cannot be told is an empty list
  //! with \e dropped set.
  void near(const vpCollisionData &data, double cutoff, vpNearPairs &result, double time = 0.) const noexcept;
  //! Clearance of capsule \e capsule from object \e object, whether they may touch or not. After place().
  [[nodiscard]] vpClearance pair(const vpCollisionData &data, int capsule, int object, double time = 0.) const noexcept;
  //! Clearance of two capsules. After place().
  [[nodiscard]] vpClearance selfPair(const vpCollisionData &data, int first, int second) const noexcept;
  //! Clearance of a capsule from the ground, which there must be. After place().
  [[nodiscard]] vpClearance groundPair(const vpCollisionData &data, int capsule) const noexcept;
  //! What a pair is, for messages: "link 5 and object pillar". Allocates.
  [[nodiscard]] std::string describe(const vpClearance &pair) const;

  //! For this module's own use.
  [[nodiscard]] const vpCollisionCore &core(int i) const noexcept;

private:
  template <class Visit> void visit(const vpCollisionData &data, double time, Visit &visitor) const noexcept;
  template <class Visit>
  bool visitObject(const vpCollisionData &data, int j, const vpCollisionCore &core, Visit &visitor) const noexcept;

  vpArmModel m_arm;
  std::string m_source;
  std::vector<vpArmCapsule> m_capsules;
  std::vector<vpSelfPair> m_selfPairs;
  std::optional<vpHalfSpace> m_ground;
  std::vector<vpAllowedContact> m_contacts;
  std::vector<vpCollisionObject> m_objects;
  std::vector<vpCollisionCore> m_cores;
  unsigned long m_revision = 0;
  std::vector<std::uint32_t> m_checked; // Bit i: capsule i must not touch the object.
};

END_VISP_NAMESPACE
#endif
