/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "camera.h"

#include "appMain.h"
#include "target.h"

#include <visp3/core/vpMath.h>
#include <visp3/rendering/vpPlaneRenderer.h>
#include <visp3/servoing/vpServoCalibration.h>

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>

namespace visualServo
{
namespace
{
constexpr unsigned int RENDERED_WIDTH = 640, RENDERED_HEIGHT = 480; // px
constexpr double RENDERED_FOCAL = 600.;                             // px
constexpr double ASSUMED_VIEW = 60.;                                // degrees, horizontal
constexpr double USUAL_RATE = 25.;                                  // Hz

vpCameraParameters cameraOf(double focal, unsigned int width, unsigned int height)
{
  return vpCameraParameters(focal, focal, 0.5 * (width - 1.), 0.5 * (height - 1.));
}

//! How a rendered camera sees: as that of the file, without distortion.
Eye renderedEye(const CameraOptions &options)
{
  Eye eye;
  eye.rate = options.rate;
  eye.fMc = fixedCamera(options);
  if (options.xml.empty()) {
    eye.intrinsics = cameraOf(RENDERED_FOCAL, RENDERED_WIDTH, RENDERED_HEIGHT);
    eye.width = RENDERED_WIDTH;
    eye.height = RENDERED_HEIGHT;
    return eye;
  }
  const vpCalibratedCamera calibrated = vpLoadCalibratedCamera(options.xml, options.name);
  if (calibrated.width == 0 || calibrated.height == 0) {
    throw std::runtime_error(options.xml + ": does not state the size of the images, which a rendered camera needs");
  }
  const vpCameraParameters &p = calibrated.parameters;
  eye.intrinsics.initPersProjWithoutDistortion(p.get_px(), p.get_py(), p.get_u0(), p.get_v0());
  eye.width = calibrated.width;
  eye.height = calibrated.height;
  return eye;
}

//! A target on the end effector before a fixed camera faces away from the arm.
const vpRigidTransform FACING{Eigen::Vector3d(1., -1., -1.).asDiagonal(), Eigen::Vector3d::Zero()};

//! Sees the photograph from the pose of the robot's camera, or on its end effector.
class RenderedSource : public vpApp::ImageSource
{
public:
  RenderedSource(const Options &options, const Photo &photo, const Eye &eye, const Robot &robot)
    : m_robot(robot), m_renderer(photo.image, photo.width, photo.height, eye.intrinsics, eye.width, eye.height),
      m_isFixed(options.camera.isFixed), m_fMc(eye.fMc), m_objectAt(objectAt(*options.camera.pose)),
      m_period(1. / options.camera.rate), m_isByClock(options.realTime), m_seed(options.seed)
  {
    m_faults.noise = options.camera.noise;
  }

  bool next(vpImage<unsigned char> &image) override
  {
    m_time = static_cast<double>(m_number) * m_period;
    if (m_isByClock) {
      m_begin = m_number == 0 ? vpApp::now() : m_begin;
      wait(m_begin + m_time);
      m_time = vpApp::now();
    }
    const vpRigidTransform pose = m_robot.pose();
    const vpRigidTransform cMo = m_isFixed ? m_fMc.inverse() * pose * m_objectAt : pose.inverse() * m_objectAt;
    m_renderer.render(cMo.toHomogeneous(), m_faults, m_seed + m_number, image);
    ++m_number;
    return !vpApp::interrupted();
  }
  [[nodiscard]] std::string name() const override { return "image " + std::to_string(number()); }
  [[nodiscard]] unsigned int number() const override { return m_number - 1; }
  [[nodiscard]] double time() const override { return m_time; }
  [[nodiscard]] std::string clock() const override { return "times of rendering"; }
  [[nodiscard]] bool isLive() const override { return true; }
  [[nodiscard]] std::size_t count() const override { return 0; }
  [[nodiscard]] std::string description() const override { return "a rendered camera"; }

private:
  //! In the end effector before a fixed camera, else in the base.
  [[nodiscard]] vpRigidTransform objectAt(const vpHomogeneousMatrix &cMo) const
  {
    const vpRigidTransform pose = m_robot.pose(), seen = vpRigidTransform::fromHomogeneous(cMo);
    return m_isFixed ? pose.inverse() * m_fMc * seen : pose * seen;
  }
  static void wait(double until)
  {
    const double left = until - vpApp::now();
    if (left > 0.) {
      std::this_thread::sleep_for(std::chrono::duration<double>(left));
    }
  }

  const Robot &m_robot;
  vpPlaneRenderer m_renderer;
  bool m_isFixed;
  vpRigidTransform m_fMc, m_objectAt;
  vpCameraFaults m_faults;
  double m_period;
  bool m_isByClock;
  unsigned int m_seed, m_number = 0;
  double m_begin = 0., m_time = 0.;
};

//! A source whose first image was read before, and whose images have times even where the files have none.
class TimedSource : public vpApp::ImageSource
{
public:
  TimedSource(std::unique_ptr<vpApp::ImageSource> source, const vpImage<unsigned char> &first, double rate)
    : m_source(std::move(source)), m_first(first), m_firstTime(m_source->time()), m_rate(rate)
  {}

  bool next(vpImage<unsigned char> &image) override
  {
    if (m_read == 0 && !m_source->isLive()) {
      image = m_first;
    }
    else if (!m_source->next(image)) {
      return false;
    }
    if (!m_source->isLive()) {
      const double given = m_source->time() - m_firstTime, before = m_time;
      const bool isUsable = m_rate == 0. && std::isfinite(given) && (m_read == 0 || given > before);
      m_time = isUsable ? given : m_read == 0 ? 0. : before + 1. / (m_rate > 0. ? m_rate : USUAL_RATE);
    }
    ++m_read;
    return true;
  }
  [[nodiscard]] std::string name() const override { return m_source->name(); }
  [[nodiscard]] unsigned int number() const override { return m_source->number(); }
  [[nodiscard]] double time() const override { return m_source->isLive() ? m_source->time() : m_time; }
  [[nodiscard]] std::string clock() const override
  {
    const bool isOfFile = m_rate == 0. && std::isfinite(m_source->time());
    return m_source->isLive() || isOfFile ? m_source->clock() : "a constant rate";
  }
  [[nodiscard]] bool isLive() const override { return m_source->isLive(); }
  [[nodiscard]] std::size_t count() const override { return m_source->count(); }
  [[nodiscard]] std::size_t lost() const override { return m_source->lost(); }
  [[nodiscard]] std::string description() const override { return m_source->description(); }
  [[nodiscard]] bool isAfterGap() const override { return m_source->isAfterGap(); }
  [[nodiscard]] std::vector<std::string> remarks() const override { return m_source->remarks(); }

private:
  std::unique_ptr<vpApp::ImageSource> m_source;
  vpImage<unsigned char> m_first;
  double m_firstTime, m_rate;
  std::size_t m_read = 0;
  double m_time = 0.;
};

std::unique_ptr<vpApp::ImageSource> openSource(const CameraOptions &options)
{
  const std::string aravis = "aravis";
  if (options.source.rfind(aravis, 0) == 0 &&
      (options.source.size() == aravis.size() || options.source[aravis.size()] == ':')) {
    return vpApp::openAravis(options.source.size() > aravis.size() ? options.source.substr(aravis.size() + 1) : "",
                             options.rate);
  }
  const std::string device = vpApp::cameraDevice(options.source);
  return device.empty() ? vpApp::openImages({options.source}) : vpApp::openCamera(device);
}
} // namespace

vpRigidTransform fixedCamera(const CameraOptions &options)
{
  return options.fMc.empty() ? vpRigidTransform() : vpLoadPose(options.fMc);
}

vpCameraParameters intrinsicsOf(const CameraOptions &options, unsigned int width, unsigned int height)
{
  return options.xml.empty() ? cameraOf(0.5 * width / std::tan(0.5 * vpMath::rad(ASSUMED_VIEW)), width, height)
                             : vpLoadCalibratedCamera(options.xml, options.name, width, height).parameters;
}

Camera openCamera(const Options &options, const Robot &robot)
{
  Camera camera;
  Eye &eye = camera.eye;
  const CameraOptions &wanted = options.camera;
  if (wanted.source == "sim") {
    eye = renderedEye(wanted);
    if (wanted.isFixed && wanted.fMc.empty()) {
      eye.fMc = robot.pose() * FACING * vpRigidTransform::fromHomogeneous(*wanted.pose).inverse();
    }
    camera.source = std::make_unique<RenderedSource>(options, readPhoto(options.target), eye, robot);
    return camera;
  }
  std::unique_ptr<vpApp::ImageSource> source = openSource(wanted);
  vpImage<unsigned char> first;
  if (!source->next(first)) {
    vpApp::throwIfInterrupted();
    throw std::runtime_error(source->description() + " holds no image");
  }
  eye.width = first.getWidth();
  eye.height = first.getHeight();
  eye.rate = wanted.rate > 0. ? wanted.rate : USUAL_RATE;
  eye.isAssumed = wanted.xml.empty();
  eye.intrinsics = intrinsicsOf(wanted, eye.width, eye.height);
  eye.fMc = fixedCamera(wanted);
  camera.source = std::make_unique<TimedSource>(std::move(source), first, wanted.rate);
  return camera;
}
} // namespace visualServo
