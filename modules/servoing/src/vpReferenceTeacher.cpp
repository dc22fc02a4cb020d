/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/servoing/vpReferenceTeacher.h>

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpField.h>
#include <visp3/direct_core/vpQuantile.h>
#include <visp3/planar_target/vpPlaneTracker.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

BEGIN_VISP_NAMESPACE

class vpReferenceTeacher::Impl
{
public:
  Impl(unsigned int images, double motion) : m_images(images), m_motion(motion)
  {
    vpCheckField("images", "the reference teacher", images, "", {1., 1000.});
    vpCheckField("motion", "the reference teacher", motion, "px", vpFieldRange::positive());
  }

  bool add(const vpImage<unsigned char> &image)
  {
    if (m_count == 0) {
      begin(image);
      return true;
    }
    if (image.getWidth() != m_width || image.getHeight() != m_height) {
      throw vpException(vpException::dimensionError, "the image to average has %ux%u px, the first one %ux%u",
                        image.getWidth(), image.getHeight(), m_width, m_height);
    }
    const vpPlaneTrack &track = m_tracker->track(image, {1., 0., 0., 0., 1., 0., 0., 0., 1.});
    const double shift = track.found ? medianShift(track) : std::numeric_limits<double>::infinity();
    if (!(shift <= m_motion)) {
      begin(image);
      say("The camera or the scene has moved by %.2g px, at most %.2g are allowed: the average starts again.", shift,
          m_motion);
      return false;
    }
    sum(image);
    m_squares += 0.5 * track.sigma * track.sigma; // of the difference of two images
    say("%u of %u images, noise of a corner %.2g px.", m_count, m_images, pointNoise());
    return true;
  }

  [[nodiscard]] double pointNoise() const
  {
    return m_count > 1 ? std::sqrt(m_squares / (m_count - 1)) : std::numeric_limits<double>::quiet_NaN();
  }

  [[nodiscard]] vpImage<unsigned char> image() const
  {
    if (m_count == 0) {
      throw vpException(vpException::notInitialized, "the reference teacher was given no image");
    }
    vpImage<unsigned char> mean(m_height, m_width);
    for (std::size_t i = 0; i < m_sum.size(); ++i) {
      mean.bitmap[i] = static_cast<unsigned char>((m_sum[i] + m_count / 2) / m_count);
    }
    return mean;
  }

  unsigned int m_images, m_count = 0;
  std::string m_message = "No image was given yet.";

private:
  void begin(const vpImage<unsigned char> &image)
  {
    m_tracker.emplace(image);
    m_width = image.getWidth();
    m_height = image.getHeight();
    m_sum.assign(image.getSize(), 0);
    m_count = 0;
    m_squares = 0.;
    sum(image);
    say("1 of %u images.", m_images);
  }

  void sum(const vpImage<unsigned char> &image)
  {
    for (std::size_t i = 0; i < m_sum.size(); ++i) {
      m_sum[i] += image.bitmap[i];
    }
    ++m_count;
  }

  [[nodiscard]] double medianShift(const vpPlaneTrack &track) const
  {
    std::vector<double> shifts;
    for (std::size_t i = 0; i < track.points.size(); ++i) {
      if (track.visible[i]) {
        shifts.push_back(vpImagePoint::distance(track.points[i], m_tracker->reference()[i]));
      }
    }
    return vpMedian(std::move(shifts));
  }

  template <class... Numbers> void say(const char *format, Numbers... numbers)
  {
    char text[160];
    std::snprintf(text, sizeof(text), format, numbers...);
    m_message = text;
  }

  double m_motion;
  std::optional<vpPlaneTracker> m_tracker; // of the first image
  unsigned int m_width = 0, m_height = 0;
  std::vector<unsigned int> m_sum;
  double m_squares = 0.; // of the noise, px^2, one image each
};

vpReferenceTeacher::vpReferenceTeacher(unsigned int images, double motion)
  : m_impl(std::make_unique<Impl>(images, motion))
{}

vpReferenceTeacher::~vpReferenceTeacher() = default;
vpReferenceTeacher::vpReferenceTeacher(vpReferenceTeacher &&) noexcept = default;
vpReferenceTeacher &vpReferenceTeacher::operator=(vpReferenceTeacher &&) noexcept = default;

bool vpReferenceTeacher::add(const vpImage<unsigned char> &image) { return m_impl->add(image); }

bool vpReferenceTeacher::isComplete() const { return m_impl->m_count >= m_impl->m_images; }

vpImage<unsigned char> vpReferenceTeacher::image() const { return m_impl->image(); }

double vpReferenceTeacher::pointNoise() const { return m_impl->pointNoise(); }

double vpReferenceTeacher::averageNoise() const { return pointNoise() / std::sqrt(m_impl->m_count); }

const std::string &vpReferenceTeacher::message() const { return m_impl->m_message; }

END_VISP_NAMESPACE
