/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpArmCover.h
 * \brief Capsules for the bodies of an arm from their exact shapes.
 */
#ifndef vpArmCover_h
#define vpArmCover_h

#include <visp3/manipulator/vpArmModel.h>

BEGIN_VISP_NAMESPACE

//! \ingroup group_avoidance
//! \brief Options of vpCoverArm().
struct VISP_EXPORT vpArmCoverSpec {
  int capsules = 3; //!< Maximum number of fitted capsules of a body, 1..8.
  /*!
   * JSON file of covers, read before and written after fitting (data/robot/README.md has its fields); may be edited;
   * empty: none. Entries of other bodies stay, so several arms may share a file if their bodies' names differ.
   */
  std::string cacheFile;
  std::vector<std::string> ignored; //!< Names of bodies that get no capsules and stay in vpArmSpec::uncovered.
  unsigned int seed = 1;            //!< Seed of the fits: the same seed gives the same covers.
};

//! \ingroup group_avoidance
//! \brief Cover of one body.
struct VISP_EXPORT vpBodyCover {
  std::string body;     //!< Name of the body.
  int link = 0;         //!< Link that carries it, 1..n; 0: the base.
  int count = 0;        //!< Number of its capsules, exact ones of spheres included.
  double overhang = 0.; //!< Largest distance of the fitted cover's surface outside the shapes, m: see vpCapsuleCover.
  double volumeRatio =
      0.;                 //!< Volume of the fitted cover over that of the hull of the shapes; 0: flat, or spheres only.
  double radius = 0.;     //!< Half the least width of the shapes, m: see vpCapsuleCover.
  bool fromCache = false; //!< Read from the file, not fitted.
  bool edited = false;    //!< The capsules in the file are not those that were fitted.
  bool unchecked = false; //!< The file requires these capsules, although they are not proven to enclose the shapes.
};

//! \ingroup group_avoidance
//! \brief Result of vpCoverArm().
struct VISP_EXPORT vpArmCover {
  vpArmModel arm;                    //!< The arm with the capsules of the covers.
  std::vector<vpBodyCover> bodies;   //!< Bodies that are covered now, in the order of vpArmSpec::bodies.
  std::vector<std::string> warnings; //!< What remains uncovered or unchecked and why, one sentence each.
};

/*!
 * \ingroup group_avoidance
 * \brief Covers all bodies that have shapes by capsules that enclose them. A fit takes up to some seconds for each
 * body; a cover from the file takes milliseconds.
 *
 * A sphere is its own capsule; meshes, boxes and cylinders (as prisms of 48 sides about them) of a body together get a
 * cover by vpFitCapsules() in the frame of the link. It replaces the body's capsules, and the body leaves
 * vpArmSpec::uncovered. vpArmSpec::shapes are taken as all that the body has, at a place that does not change: the arm
 * must have no shape of a body that is known only in part or moves relative to its link. Bodies without shapes stay as
 * they are. A body of which a mesh cannot be read stays uncovered, with a warning.
 *
 * A cover from the file is verified by vpProveCover(). An unedited cover is fitted again when the shapes,
 * the number of capsules or the seed have changed. An edited or `unchecked` one is always used.
 *
 * \code
 * vpArmCoverSpec spec;
 * spec.cacheFile = "covers.json"; // fits only what has changed
 * const vpArmCover cover = vpCoverArm(arm, spec);
 * for (const vpBodyCover &body : cover.bodies) {
 *   std::cout << body.body << ": " << body.count << " capsules, at most " << body.overhang << " m too far out\n";
 * }
 * for (const std::string &warning : cover.warnings) {
 *   std::cerr << warning << std::endl; // what no check would see
 * }
 * const vpCollisionScene covered(cover.arm); // throws while a body is uncovered
 * \endcode
 * \throw vpException (badValue) naming the body: edited capsules that are not proven to enclose it, with the point
 * farthest outside, unless the file says `unchecked`; an ignored name that is no body. (badValue, ioError) naming the
 * file and the field if the file exists and cannot be read. A file that cannot be written is only a warning.
 */
[[nodiscard]] VISP_EXPORT vpArmCover vpCoverArm(const vpArmModel &arm, const vpArmCoverSpec &spec = {});

END_VISP_NAMESPACE
#endif
