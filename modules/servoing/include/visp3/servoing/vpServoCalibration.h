/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoCalibration.h
 * \brief Reads the files of ViSP's calibration programs: camera parameters, and poses such as eMc.
 */
#ifndef vpServoCalibration_h
#define vpServoCalibration_h

#include <visp3/core/vpCameraParameters.h>
#include <visp3/manipulator/vpArmTypes.h>

#include <string>

BEGIN_VISP_NAMESPACE

//! \ingroup group_servoing
//! \brief A camera of a calibration file.
struct VISP_EXPORT vpCalibratedCamera {
  std::string name;              //!< Name of the camera in the file.
  unsigned int width = 0;        //!< Width of the images of the calibration, px; 0 if the file does not state it.
  unsigned int height = 0;       //!< Height of the images of the calibration, px; 0 if the file does not state it.
  vpCameraParameters parameters; //!< With distortion where the file has it: vision by vpServoVision removes it.
};

/*!
 * \ingroup group_servoing
 * \brief Reads a camera from an XML file as written by vpXmlParserCamera, that is by ViSP's `calibrate-camera`.
 *
 * Of several models of the chosen camera the one with distortion is taken.
 * \param file : The file. \param name : Name of the camera; empty: any.
 * \param width, height : Size of the images, px; 0: any.
 * \throw vpException (ioError) for a file that cannot be read; (badValue) naming the file and what is wrong: no XML, no
 * camera or more than one that fits (all are listed), a model that is not supported, a number that is missing or wrong.
 */
[[nodiscard]] VISP_EXPORT vpCalibratedCamera vpLoadCalibratedCamera(const std::string &file,
                                                                    const std::string &name = "",
                                                                    unsigned int width = 0, unsigned int height = 0);

/*!
 * \ingroup group_servoing
 * \brief Reads a pose, m, as written by ViSP's hand-eye calibration: YAML of vpPoseVector::saveYAML() (6 numbers:
 * translation, theta u) or of vpHomogeneousMatrix::saveYAML() (4 x 4), or the text of vpHomogeneousMatrix::save() or
 * vpPoseVector::save().
 *
 * A rotation with errors of rounding is replaced by the nearest one.
 *
 * \code
 * const vpCameraParameters calibrated = vpLoadCalibratedCamera("camera.xml", "", 640, 480).parameters;
 * const vpRigidTransform eMc = vpLoadPose("eMc.yaml"); // both throw, naming the file and what is wrong
 * std::cout << calibrated << "camera at " << eMc.p.transpose() << " m in the end effector" << std::endl;
 * \endcode
 * \throw vpException (ioError) for a file that cannot be read; (badValue) naming the file and what is wrong: a wrong
 *   number of numbers, one that is not finite, no rotation (off by more than 0.001), a translation of more than 1000 m.
 */
[[nodiscard]] VISP_EXPORT vpRigidTransform vpLoadPose(const std::string &file);

END_VISP_NAMESPACE
#endif
