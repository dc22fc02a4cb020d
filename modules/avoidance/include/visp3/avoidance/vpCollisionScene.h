/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCollisionScene.h
 * \brief An arm among obstacles: allowed contacts, collision and distance queries.
 */
#ifndef vpCollisionScene_h
#define vpCollisionScene_h

#include <visp3/avoidance/vpCollisionData.h>
#include <visp3/avoidance/vpCollisionObject.h>
#include <visp3/avoidance/vpReachBounds.h>

#include <cstdint>
#include <memory>
#include <utility>

BEGIN_VISP_NAMESPACE

struct vpCollisionCore;
struct vpObjectNode;
struct vpPartMotions;
struct vpLinkHull;
struct vpLinkPair;
class vpExactShapes;

/*!
 * \ingroup group_avoidance
 * \brief Ground plane: the side normal^T x < offset is forbidden. In the base frame.
 */
struct VISP_EXPORT vpHalfSpace {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(); //!< Normal towards the free side; any length but 0.
  double offset = 0.;                                //!< Offset along the normal, m.
  int firstLink = 2; //!< Capsules of links below this one (1..n) rest on the ground and are not checked.
};

/*!
 * \ingroup group_avoidance
 * \brief Allowed contact: an object that a link carries or rests on.
 */
struct VISP_EXPORT vpAllowedContact {
  std::string object; //!< Name of the object.
  int link = 0;       //!< Index of the link, 1..n.
};

/*!
 * \ingroup group_avoidance
 * \brief Specification of a scene; validated by vpCollisionScene.
 */
struct VISP_EXPORT vpCollisionSceneSpec {
  std::string source;                            //!< Source file, for messages; may be empty.
  std::vector<vpCollisionObject> objects;        //!< Obstacles.
  std::optional<vpHalfSpace> ground;             //!< Ground plane, optional.
  bool allowAdjacent = true;                     //!< Neighbouring links may touch, see vpCollisionScene.
  std::vector<std::pair<int, int>> allowedLinks; //!< Further pairs of links (0..n) that may touch.
  std::vector<vpAllowedContact> allowedContacts; //!< Links that may touch an object.
  std::vector<std::string> ignoredBodies;        //!< Bodies of vpArmSpec::uncovered that are not checked.
  //! Exact shapes of the arm's bodies, which decide offline where capsules do not; none: capsules decide alone.
  std::shared_ptr<const vpExactShapes> exact;
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
 * \brief Arm and obstacles for collision queries; these are const, do not allocate, throw or lock, and use a
 * vpCollisionData (one per thread) as scratch memory.
 *
 * Set-up (constructor, add(), remove()) allocates and throws; moveObject(), setVelocity() and advance() are for the
 * control cycle. No query may run while another thread changes the scene: give that thread its own copy.
 *
 * The arm is modelled by its capsules (vpArmSpec::capsules). Capsules of moving links are checked against all objects,
 * the ground, and each other (3.48). Two capsules are not checked against each other if they are
 * - on the same link, or on neighbouring ones (allowAdjacent): no link between them has a capsule, a vpArmShape, or a
 *   body of vpArmSpec::uncovered, ignored or not. With capsules on links 1, 3, 5 and 7 and nothing on the others these
 *   are the links (1, 3), (3, 5) and (5, 7);
 * - on links of vpCollisionSceneSpec::allowedLinks, or of two bodies of vpArmSpec::allowedBodies.
 *
 * Capsules of the base (link 0) are checked against the arm only, since no motion frees the base from an obstacle.
 *
 * All queries are about capsules. Where these enclose the arm's true shape they may touch while the shape does not; so
 * a vpStopSupervisor may brake early. vpExactChecker and vpCertifiedMotion use the exact shapes where the scene has
 * them. Capsules that touch in most configurations need an allowed pair, see vpSelfCollisionStatistics.
 *
 * \code
 * const vpArmModel amor = vpLoadArmJson("data/robot/amor.json");
 * vpCollisionSceneSpec spec;
 * spec.ground = vpHalfSpace(); // the table, z = 0
 * vpCollisionScene table(amor, spec);
 * vpCollisionObject pillar;
 * pillar.name = "pillar";
 * pillar.shape = vpCollisionShape::cylinder(0.05, 0.8); // m
 * pillar.pose.p << 0.4, 0.3, 0.4;
 * table.add(pillar);
 * vpCollisionData data; // one for each thread
 * table.place(amor.home(), data);
 * const vpClearance nearest = table.clearance(data);
 * if (nearest.distance < 0.01) { // m; -infinity where the configuration is invalid
 *   std::cerr << table.describe(nearest) << ": " << nearest.distance << " m" << std::endl;
 * }
 * \endcode
 */
class VISP_EXPORT vpCollisionScene
{
public:
  /*!
   * \throw vpException (badValue) naming the source, the element and the value: an arm without capsules or with more
   * than vpArmMaxCapsules, a body of vpArmSpec::uncovered that is not ignored, an ignored one that is not among them,
   * exact shapes of another arm, an object without a name or with a duplicate name, an invalid pose, lengths that are
   * not finite, negative or above vpLargestLength, velocities above 1000 m/s or rad/s, a ground without normal, links
   * or objects that do not exist.
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
  //! Exact shapes of the arm's bodies; null if there are none.
  [[nodiscard]] const std::shared_ptr<const vpExactShapes> &exact() const noexcept { return m_exact; }
  //! Reach bounds, computed once for all copies of the arm (vpArmModel::derived()). Allocates and locks.
  [[nodiscard]] std::shared_ptr<const vpReachBounds> reach() const;
  //! Pairs of capsules that must not touch, sorted by their links.
  [[nodiscard]] const std::vector<vpSelfPair> &selfPairs() const noexcept { return m_selfPairs; }
  //! The ground with a unit normal, if there is one.
  [[nodiscard]] const std::optional<vpHalfSpace> &ground() const noexcept { return m_ground; }
  //! Number of objects.
  [[nodiscard]] int objectCount() const noexcept { return static_cast<int>(m_objects.size()); }
  //! Object \e i, 0..objectCount()-1, at its current pose.
  [[nodiscard]] const vpCollisionObject &object(int i) const noexcept { return m_objects[static_cast<std::size_t>(i)]; }
  //! Index of an object, -1 when there is none of that name.
  [[nodiscard]] int find(const std::string &name) const noexcept;
  //! True if capsule \e capsule must not touch object \e object.
  [[nodiscard]] bool isChecked(int capsule, int object) const noexcept;
  //! True if capsule \e capsule must not touch the ground.
  [[nodiscard]] bool isCheckedWithGround(int capsule) const noexcept;

  //! Revision number, new after every add() and remove() and unique among all scenes except copies: pair lists made for
  //! the same number remain valid.
  [[nodiscard]] unsigned long revision() const noexcept { return m_revision; }

  //! Adds an object and returns its index. Allocates. \throw vpException (badValue) as the constructor.
  int add(const vpCollisionObject &object);
  //! Removes object \e i; those behind it move up. \throw vpException (badValue) naming the index.
  void remove(int i);

  /*!
   * Moves object \e i to a new pose. Does not allocate.
   * \return False, and nothing changes, if there is no such object, or the pose is not a rigid transform within
   * vpLargestLength.
   */
  bool moveObject(int i, const vpRigidTransform &pose) noexcept;
  //! Sets the velocity of object \e i (axes of the base). False, and nothing changes, for an invalid index or number.
  bool setVelocity(int i, const vpTwist &velocity) noexcept;
  //! Sets the inflation of object \e i, m, >= 0. False, and nothing changes, for an invalid index or number.
  bool setInflation(int i, double inflation) noexcept;
  //! Moves every object by its velocity for \e dt seconds. Does not allocate. False if one could not be moved, see
  //! moveObject().
  bool advance(double dt) noexcept;

  //! Places the arm in configuration \e q for the queries below. A configuration of the wrong size, not finite or
  //! beyond vpLargestCoordinate is invalid (vpCollisionData::placed): every query then reports a collision.
  void place(const vpJointVector &q, vpCollisionData &data) const noexcept;
  /*!
   * True if a checked pair has a clearance <= margin. Stops at the first.
   * \param data : After place().
   * \param margin : Margin for every pair, m.
   * \param time : s from now; objects are extrapolated by their velocities. NaN, or beyond 1e6 s: in collision.
   */
  [[nodiscard]] bool inCollision(const vpCollisionData &data, double margin = 0., double time = 0.) const noexcept;
  /*!
   * The pair with the least clearance below \e cutoff (m); kind None and infinite distance if there is none. A small
   * cutoff saves time. Parameters as for inCollision(); invalid input gives kind Unknown at -infinity.
   */
  [[nodiscard]] vpClearance clearance(const vpCollisionData &data,
                                      double cutoff = std::numeric_limits<double>::infinity(),
                                      double time = 0.) const noexcept;
  //! The nearest pairs (see vpNearPairs) with a clearance below \e cutoff (m). Parameters as for inCollision(); invalid
  //! input gives an empty list with \e dropped set.
  void near(const vpCollisionData &data, double cutoff, vpNearPairs &result, double time = 0.) const noexcept;
  //! Clearance of capsule \e capsule from object \e object, even if contact is allowed. After place().
  [[nodiscard]] vpClearance pair(const vpCollisionData &data, int capsule, int object, double time = 0.) const noexcept;
  //! Clearance of two capsules. After place().
  [[nodiscard]] vpClearance selfPair(const vpCollisionData &data, int first, int second) const noexcept;
  //! Clearance of a capsule from the ground, which must exist. After place().
  [[nodiscard]] vpClearance groundPair(const vpCollisionData &data, int capsule) const noexcept;
  //! Describes a pair for messages: "link 5 and object pillar", with the names of bodies where they are known.
  //! Allocates.
  [[nodiscard]] std::string describe(const vpClearance &pair) const;

  //! For this module's own use.
  [[nodiscard]] const vpCollisionCore &core(int i) const noexcept;
  //! For this module's own use.
  [[nodiscard]] const std::vector<vpObjectNode> &tree() const noexcept;
  //! For this module's own use: near() with a cutoff that is enlarged for each pair by the motions of its parts.
  void near(const vpCollisionData &data, double cutoff, const vpPartMotions *motions, vpNearPairs &result,
            double time) const noexcept;
  //! For this module's own use.
  [[nodiscard]] const std::vector<vpLinkHull> &hulls() const noexcept;
  //! For this module's own use.
  [[nodiscard]] const std::vector<vpLinkPair> &linkPairs() const noexcept;

private:
  struct Links;
  void append(const vpCollisionObject &object);
  template <class Visit> void visit(const vpCollisionData &data, double time, Visit &visitor) const noexcept;
  template <class Visit>
  bool visitObjects(const vpCollisionData &data, const vpLinkHull &hull, double time, Visit &visitor) const noexcept;
  template <class Visit>
  bool visitObject(const vpCollisionData &data, const vpLinkHull &hull, int j, const vpCollisionCore &core,
                   Visit &visitor) const noexcept;

  vpArmModel m_arm;
  std::string m_source;
  std::vector<vpArmCapsule> m_capsules;
  std::shared_ptr<const Links> m_links;
  std::shared_ptr<const vpExactShapes> m_exact;
  std::vector<vpSelfPair> m_selfPairs;
  std::optional<vpHalfSpace> m_ground;
  std::vector<vpAllowedContact> m_contacts;
  std::vector<vpCollisionObject> m_objects;
  std::vector<vpCollisionCore> m_cores;
  std::vector<vpObjectNode> m_tree;
  unsigned long m_revision = 0;
  std::vector<std::uint32_t> m_checked; // Bit i: link i must not touch the object.
};

END_VISP_NAMESPACE
#endif
