/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "imageSource.h"

#include "appMain.h"
#include "cameraClock.h"
#include "numberText.h"

#include <arv.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace vpApp
{
namespace
{
constexpr int BUFFERS = 8;
constexpr guint64 POLL = 100000; // us
constexpr double PATIENCE = 3.;  // s without an image until the camera counts as gone

struct Unref {
  void operator()(void *object) const { g_object_unref(object); }
};
template <class Object> using Ref = std::unique_ptr<Object, Unref>;

//! \throw std::runtime_error "camera: what failed: reason".
void check(GError *error, const std::string &camera, const std::string &failed)
{
  if (error != nullptr) {
    const std::string reason = error->message;
    g_error_free(error);
    throw std::runtime_error(camera + ": " + failed + ": " + reason);
  }
}

std::string camerasThere()
{
  arv_update_device_list();
  std::vector<std::string> ids;
  for (unsigned int i = 0; i < arv_get_n_devices(); ++i) {
    ids.emplace_back(arv_get_device_id(i));
  }
  return ids.empty() ? "Aravis sees no camera" : "Aravis sees " + enumerate(ids);
}

//! Time of arrival on the clock of now(), from a time of the system's clock in ns.
double arrivalOf(guint64 system)
{
  const double real = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  return now() - std::max(0., real - 1e-9 * static_cast<double>(system));
}

class AravisSource : public ImageSource
{
public:
  AravisSource(const std::string &id, double rate, std::size_t frames) : m_frames(frames)
  {
    GError *error = nullptr;
    m_camera.reset(arv_camera_new(id.empty() ? nullptr : id.c_str(), &error));
    if (!m_camera) {
      g_clear_error(&error);
      throw std::runtime_error("aravis" + (id.empty() ? "" : ":" + id) + ": the camera cannot be opened; " +
                               camerasThere());
    }
    const char *model = arv_camera_get_model_name(m_camera.get(), &error);
    check(error, "aravis:" + id, "the camera does not tell its name");
    m_name = std::string(model != nullptr ? model : "camera") + (id.empty() ? "" : " (" + id + ")");
    arv_camera_set_pixel_format(m_camera.get(), ARV_PIXEL_FORMAT_MONO_8, &error);
    check(error, m_name, "has no grey values of 8 bits (Mono8)");
    if (rate > 0.) {
      arv_camera_set_frame_rate(m_camera.get(), rate, &error);
      check(error, m_name, "cannot take " + vpApp::number(rate, 4) + " images per second");
    }
    start();
  }

  ~AravisSource() override
  {
    if (!m_gone) { // else it would be asked in vain, again and again
      arv_camera_stop_acquisition(m_camera.get(), nullptr);
    }
  }

  bool next(vpImage<unsigned char> &image) override
  {
    if (m_frames != 0 && m_read >= m_frames) {
      return false;
    }
    m_missing = 0;
    const double start = now();
    while (!interrupted()) {
      if (ArvBuffer *buffer = arv_stream_timeout_pop_buffer(m_stream.get(), POLL)) {
        const bool good = take(buffer, image);
        arv_stream_push_buffer(m_stream.get(), buffer);
        if (good) {
          return true;
        }
      }
      m_gone = now() - start > PATIENCE;
      if (m_gone) {
        throw std::runtime_error(m_name + ": the camera gives no image" +
                                 (m_read > 0 ? " after " + std::to_string(m_read) : ""));
      }
    }
    return false;
  }
  [[nodiscard]] std::string name() const override { return "image " + std::to_string(number()) + " of " + m_name; }
  [[nodiscard]] unsigned int number() const override { return static_cast<unsigned int>(m_read + m_lost - 1); }
  [[nodiscard]] double time() const override { return m_time; }
  [[nodiscard]] std::string clock() const override
  {
    return m_stamped ? "time stamps of the camera" : "times of arrival";
  }
  [[nodiscard]] bool isLive() const override { return true; }
  [[nodiscard]] std::size_t count() const override { return m_frames; }
  [[nodiscard]] std::size_t lost() const override { return m_lost; }
  [[nodiscard]] std::string description() const override { return "the camera " + m_name; }
  [[nodiscard]] bool isAfterGap() const override { return m_missing > 0 && m_read > 1; }
  [[nodiscard]] std::vector<std::string> remarks() const override
  {
    if (m_lost == 0) {
      return {};
    }
    return {"The camera took " + std::to_string(m_lost) + (m_lost == 1 ? " image" : " images") +
            " that did not arrive whole."};
  }

private:
  void start()
  {
    GError *error = nullptr;
    m_stream.reset(arv_camera_create_stream(m_camera.get(), nullptr, nullptr, &error));
    check(error, m_name, "no stream");
    const guint payload = arv_camera_get_payload(m_camera.get(), &error);
    check(error, m_name, "the camera does not tell the size of its images");
    for (int i = 0; i < BUFFERS; ++i) {
      arv_stream_push_buffer(m_stream.get(), arv_buffer_new(payload, nullptr));
    }
    arv_camera_start_acquisition(m_camera.get(), &error);
    check(error, m_name, "the acquisition cannot be started");
  }

  //! False for an image that did not arrive whole: its number will be missing.
  bool take(ArvBuffer *buffer, vpImage<unsigned char> &image)
  {
    if (arv_buffer_get_status(buffer) != ARV_BUFFER_STATUS_SUCCESS) {
      return false;
    }
    const auto width = static_cast<unsigned int>(arv_buffer_get_image_width(buffer));
    const auto height = static_cast<unsigned int>(arv_buffer_get_image_height(buffer));
    std::size_t bytes = 0;
    const auto *data = static_cast<const unsigned char *>(arv_buffer_get_data(buffer, &bytes));
    if (data == nullptr || bytes < static_cast<std::size_t>(width) * height ||
        arv_buffer_get_image_pixel_format(buffer) != ARV_PIXEL_FORMAT_MONO_8) {
      return false;
    }
    image.resize(height, width);
    std::copy_n(data, static_cast<std::size_t>(width) * height, image.bitmap);
    m_missing += m_numbers.missingBefore(arv_buffer_get_frame_id(buffer));
    m_lost += m_missing;
    const guint64 stamp = arv_buffer_get_timestamp(buffer);
    const double arrival = arrivalOf(arv_buffer_get_system_timestamp(buffer));
    m_stamped = stamp != 0;
    m_time = m_stamped ? m_clock.convert(1e-9 * static_cast<double>(stamp), arrival) : arrival;
    ++m_read;
    return true;
  }

  std::size_t m_frames;
  std::string m_name;
  Ref<ArvCamera> m_camera;
  Ref<ArvStream> m_stream; // before the camera
  CameraClock m_clock;
  ImageNumbers m_numbers;
  std::size_t m_read = 0, m_lost = 0, m_missing = 0;
  double m_time = 0.;
  bool m_stamped = true, m_gone = false;
};
} // namespace

std::unique_ptr<ImageSource> openAravis(const std::string &id, double rate, std::size_t frames)
{
  return std::make_unique<AravisSource>(id, rate, frames);
}
} // namespace vpApp
