/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlanarTargetDatabase.h
 * \brief Several planar targets at once, from a folder of photographs.
 */
#ifndef vpPlanarTargetDatabase_h
#define vpPlanarTargetDatabase_h

#include <visp3/planar_target/vpPlanarTarget.h>

#include <memory>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_planar_target
//! \brief One target of the database with its result in the last frame.
struct VISP_EXPORT vpPlanarTargetSighting {
  std::string name;            //!< Name in the database.
  double width = 0.;           //!< Width of the target, m.
  double height = 0.;          //!< Height of the target, m.
  double depth = 0.;           //!< Depth of the body whose front face is the target, m; 0: not known.
  vpPlanarTargetResult result; //!< Status, and pose if it was found.
};

/*!
 * \class vpPlanarTargetDatabase
 * \ingroup group_planar_target
 * \brief Searches for every target of a collection in each frame.
 *
 * A folder holds the reference photographs and a file targets.json that lists them:
 * \code{.json}
 * { "targets": [
 *   { "name": "box", "image": "box.png", "width_m": 0.16, "height_m": 0.11, "depth_m": 0.05 },
 *   { "name": "poster", "image": "poster.jpg", "width_m": 0.42 }
 * ] }
 * \endcode
 * Without height_m the height follows from the photograph's aspect ratio; depth_m is optional, for users who need the
 * body behind the picture, and 0 when not given. Nothing is skipped silently: an unusable file, an unknown field, or a
 * photograph in the folder that targets.json does not list is an error.
 *
 * The time of a frame is bounded by the number of targets in view, however many are lost. Each target that was seen in the
 * previous frame is tracked and needs no keypoints. The lost targets share one extraction of keypoints: in turn, as many of them
 * as a fixed number of comparisons allows, 25 or more, are compared with it by their most distinctive keypoints. The most likely
 * ones are then searched thoroughly, until the first search that fails. With more than three lost targets a frame either compares
 * or searches, except for targets that are probably in view. See vpPlanarTargetEffort.
 *
 * So a target that comes into view is usually found within three frames, and within a second at 30 Hz with 100 targets
 * (catchPlanarTargetSearch). A target that resembles no lost one at first is found after at most three times as many frames as there
 * are lost targets, and one that only the fallback detector finds, which searches one of nine parts of the frame in every third
 * frame, after 27 frames or more.
 *
 * \code
 * vpPlanarTargetDatabase targets = vpPlanarTargetDatabase::fromFolder("data/target", camera);
 * for (const vpPlanarTargetSighting &target : targets.process(image)) { // each frame
 *   if (target.result.found()) {
 *     std::cout << target.name << ": " << target.result.cMo.getTranslationVector().t() << " +- "
 *               << target.result.covariance.positionDeviation() << " m" << std::endl;
 *   }
 * }
 * \endcode
 */
class VISP_EXPORT vpPlanarTargetDatabase
{
public:
  //! An empty database. \param camera : As for vpPlanarTarget. \param spec : Settings of every target.
  explicit vpPlanarTargetDatabase(const vpCameraParameters &camera, const vpPlanarTargetSpec &spec = {});
  ~vpPlanarTargetDatabase();
  vpPlanarTargetDatabase(vpPlanarTargetDatabase &&) noexcept;            //!< Moves.
  vpPlanarTargetDatabase &operator=(vpPlanarTargetDatabase &&) noexcept; //!< Moves.

  /*!
   * All targets of a folder, in the order of its targets.json.
   * \throw vpException (ioError, badValue) naming the file, and the invalid field and its value.
   */
  [[nodiscard]] static vpPlanarTargetDatabase fromFolder(const std::string &folder, const vpCameraParameters &camera,
                                                         const vpPlanarTargetSpec &spec = {});
  /*!
   * Add a target.
   * \param name : Not empty, unique. \param reference, width, height : As for vpPlanarTarget.
   * \param depth : Value of vpPlanarTargetSighting::depth, m, >= 0.
   * \throw vpException (badValue) naming the target and the error.
   */
  void add(const std::string &name, const vpImage<unsigned char> &reference, double width, double height,
           double depth = 0.);

  //! Number of targets.
  [[nodiscard]] std::size_t size() const;
  //! Search for all targets. \return One entry per target, in the order in which they were added.
  const std::vector<vpPlanarTargetSighting> &process(const vpImage<unsigned char> &image);
  //! Effort of the last frame.
  [[nodiscard]] const vpPlanarTargetEffort &effort() const;
  //! Last result; all NoFrame before the first frame.
  [[nodiscard]] const std::vector<vpPlanarTargetSighting> &sightings() const;
  /*!
   * Set the predicted pose of a target in the next frame, so that a moving camera does not lose it. Ignored for a
   * target that was not found in the last frame.
   * \param i : 0..size()-1. \param cMo : Predicted pose in the camera. Ignored when it is not finite.
   */
  void predict(std::size_t i, const vpHomogeneousMatrix &cMo);
  //! Forget the poses of all targets.
  void reset();

private:
  class Store;
  std::unique_ptr<Store> m_store;
};

END_VISP_NAMESPACE
#endif
