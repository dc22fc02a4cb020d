/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpReferenceHypotheses.h
 * \brief Internal: the images that are kept, and the planes that explain them.
 */
#ifndef vpReferenceHypotheses_h
#define vpReferenceHypotheses_h

#include "vpReferenceBatch.h"

#include <visp3/servoing/vpReferencePose.h>

BEGIN_VISP_NAMESPACE

/*!
 * Keeps at most 24 key images, between which the camera has moved, and the last 8; refines all hypotheses with each
 * image, drops those that became unlikely or equal to a likelier one, and proposes new ones from the homography of a
 * key image while few have been seen.
 *
 * Without odometry only the last image is in the batch. What was learnt of the normal then passes on as a prior, and
 * the cost as a sum; both decay by a tenth an image, because the reference's noise is the same in all.
 */
class vpReferenceHypotheses
{
public:
  //! \param reference : Must outlive this. \param sigma, spec : See vpReferencePose.
  vpReferenceHypotheses(const std::vector<Eigen::Vector2d> &reference, double sigma, const vpReferencePoseSpec &spec);

  //! See vpReferencePose; for the images from now on.
  void setNormalPrior(const Eigen::Vector3d &normal, double sigma);
  //! Forgets all.
  void clear();
  //! Adds an image; false if nothing explains it.
  bool add(const vpReferenceView &view, bool hasOdometry);

  [[nodiscard]] unsigned int count() const { return static_cast<unsigned int>(m_planes.size()); }
  [[nodiscard]] unsigned int images() const { return static_cast<unsigned int>(m_views.size()); }
  [[nodiscard]] const vpReferenceHypothesis &best() const { return m_planes.front().h; } //!< The likeliest.
  [[nodiscard]] bool hasOdometry() const { return m_hasOdometry && !m_planes.empty(); }
  //! Largest angle between the best camera orientation and another one, rad; 0 when there is one.
  [[nodiscard]] double disagreement() const;
  //! Variance of the best 1 / d, with the chance that another plane is the true one, 1/m^2.
  [[nodiscard]] double alphaVariance() const;
  [[nodiscard]] double misfit() const;                                    //!< See vpReferencePoseResult.
  [[nodiscard]] const vpReferencePrior &prior() const { return m_prior; } //!< Before any image.
  [[nodiscard]] bool onlyTurned() const; //!< True if there was no translation that could tell plane and distance.

private:
  struct Plane {
    vpReferenceHypothesis h;
    vpReferencePrior prior;
    double past = 0.; // cost of the images that are not in the batch
    double cost = 0.; // of all images
  };
  void predict(const vpRigidTransform &fMc);
  void keep(const vpReferenceView &view);
  void makeRoom();
  void propose();
  void consider(const Eigen::Matrix3d &R, const Eigen::Vector3d &tau, const Eigen::Vector3d &normal);
  [[nodiscard]] bool refine(Plane &plane, int steps);
  void prune();
  [[nodiscard]] bool fits() const;
  void learn();
  [[nodiscard]] double moved(const vpRigidTransform &from, const vpRigidTransform &to) const;

  const std::vector<Eigen::Vector2d> &m_reference;
  vpReferencePrior m_prior;
  vpReferenceBatch m_batch;
  std::vector<vpReferenceView> m_views; // oldest first
  std::vector<Plane> m_planes;          // likeliest first
  vpRigidTransform m_last;              // camera to which the planes' poses belong
  bool m_hasOdometry = false;
  unsigned int m_proposals = 0;
};

END_VISP_NAMESPACE
#endif
