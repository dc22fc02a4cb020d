/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpReferenceExperiment.h
 * \brief Servoing to where one reference image was taken, of a plane of unknown size: random starts, loop, figures.
 */
#ifndef vpReferenceExperiment_h
#define vpReferenceExperiment_h

#include <visp3/servoing/vpReferencePose.h>
#include <visp3/simulation/vpServoPlant.h>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \brief A flat object before the reference camera, which is the world frame, and the pose from which the servo starts.
 *
 * Camera: f = 800 px, 640x480. The object is 0.16 of its depth wide, with 30 points, and seen by both cameras.
 */
struct vpReferenceStart {
  double distance = 0.;                   //!< Distance d of the plane from the reference camera, m.
  Eigen::Vector3d normal;                 //!< Its normal, away from the camera.
  vpRigidTransform rMo;                   //!< Object, whose plane is z = 0, m.
  double size = 0.;                       //!< Side of the square object, m.
  std::vector<Eigen::Vector3d> points;    //!< Points of the object, m.
  std::array<Eigen::Vector3d, 4> corners; //!< Its corners, m.
  vpRigidTransform rMc;                   //!< Camera at the start, m.

  static constexpr double focal = 800., width = 640., height = 480.; //!< Of the camera, px.

  /*!
   * Draws d in about 0.2 to 1 m, a tilt up to 0.6 rad, rotations up to 60 deg, distances of 0.3 to 2 times the
   * reference's.
   * \param turned : The camera only turns: up to 1 rad of roll, 0.1 rad about the other axes.
   */
  [[nodiscard]] static vpReferenceStart draw(std::mt19937_64 &rng, bool turned = false);
};

//! \brief The vision: image of a camera at rMc, its pose by odometry, time of capture; gives a sight.
using vpReferenceEye =
    std::function<void(const vpRigidTransform &rMc, const vpRigidTransform &fMc, double time, vpServoSight &sight)>;

/*!
 * \brief Points with noise, matched with a taught reference image, through vpReferencePose.
 * \param start : Outlives the eye. \param pixelNoise : Standard deviation, px. \param taught : Number of images
 *   averaged for the reference.
 * \param spec : Of the estimator. \param seed : Of the noise. \param pose : Receives the estimator, for its figures.
 */
[[nodiscard]] vpReferenceEye seePoints(const vpReferenceStart &start, double pixelNoise, unsigned int taught,
                                       const vpReferencePoseSpec &spec, unsigned int seed,
                                       std::shared_ptr<const vpReferencePose> &pose);
/*!
 * \brief The same, but object and distance are known exactly; the goal is the pose measured in the taught images. The
 * best that the metric law can do: all images are used.
 */
[[nodiscard]] vpReferenceEye seeKnownPoints(const vpReferenceStart &start, double pixelNoise, unsigned int taught,
                                            unsigned int seed);

//! \brief Loop of a run.
struct vpReferenceRunSpec {
  vpServoPlant plant = vpServoPlant::byName("B"); //!< Plant that moves the camera.
  std::string law = "ff-lookat-pi";               //!< Id of the law.
  double duration = 15.;                          //!< Duration, s.
  double odometryScale = 1.;                      //!< Lengths that the odometry of the robot measures over true ones.
};

//! \brief Figures of a run. Errors at the end are means over the last second.
struct vpReferenceRun {
  static constexpr double never = std::numeric_limits<double>::infinity(); //!< Of times and errors that did not come.
  double endRotation = never;                                              //!< Rotation error at the end, rad.
  double endTranslation = never; //!< Translation error at the end, fraction of d.
  double outOfView = 0.;         //!< Time during which a corner of the object is out of the image, s.
  double settled = never;        //!< Time after which the errors stay below 2 deg and 2 % of d, s.
  double overshoot = 0.;         //!< Largest way beyond the goal, against the start, fraction of the way.
  double halfDistance = 0.;      //!< Distance estimated by the first image after half of the way, m; 0 before.
  double halfSigma = 0.;         //!< Its standard deviation, m.
  double endDistance = 0.;       //!< Distance estimated last, m.
  double endSigma = 0.;          //!< Its standard deviation, m.

  //! Within 3 deg and 5 % of d.
  [[nodiscard]] bool arrived() const { return endRotation < 3. * M_PI / 180. && endTranslation < 0.05; }
};

//! \brief Runs the loop: image -> latency -> odometry -> law -> limits -> plant. \throw vpException naming a bad field.
[[nodiscard]] vpReferenceRun runReferenceExperiment(const vpReferenceStart &start, const vpReferenceEye &eye,
                                                    const vpReferenceRunSpec &spec = {});

END_VISP_NAMESPACE
#endif
