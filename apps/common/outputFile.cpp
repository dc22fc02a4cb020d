/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "outputFile.h"

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace vpApp
{
namespace
{
std::runtime_error cannot(const fs::path &file, int reason)
{
  return std::runtime_error(file.string() + ": cannot be written (" + std::generic_category().message(reason) + ")");
}

//! A file descriptor.
class Descriptor
{
public:
  Descriptor(const fs::path &file, int flags) : m_number(open(file.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor()
  {
    if (m_number >= 0) {
      close(m_number);
    }
  }
  Descriptor(const Descriptor &) = delete;
  Descriptor &operator=(const Descriptor &) = delete;
  [[nodiscard]] int number() const { return m_number; }

private:
  int m_number;
};

void writeAll(int descriptor, const std::string &content, const fs::path &file)
{
  for (std::size_t done = 0; done < content.size();) {
    const ssize_t size = write(descriptor, content.data() + done, content.size() - done);
    if (size < 0 && errno != EINTR) {
      throw cannot(file, errno);
    }
    done += size > 0 ? static_cast<std::size_t>(size) : 0;
  }
}

// False if another run removed the file after we opened it.
bool isFileOf(int descriptor, const fs::path &file)
{
  struct stat opened {
  }, named{};
  return fstat(descriptor, &opened) == 0 && lstat(file.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

// The name is the same in every run, so that the next run reuses the file left by a killed one.
void replace(const fs::path &target, const std::string &content, const fs::path &file)
{
  const fs::path temporary = target.parent_path() / ("." + target.filename().string() + ".partial");
  const Descriptor part(temporary, O_WRONLY | O_CREAT | O_NOFOLLOW);
  if (part.number() < 0) {
    throw cannot(file, errno);
  }
  const bool busy = flock(part.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (busy || !isFileOf(part.number(), temporary)) {
    throw std::runtime_error(file.string() + ": is being written by another run");
  }
  try {
    struct stat former {
    };
    if (ftruncate(part.number(), 0) != 0 ||
        (stat(target.c_str(), &former) == 0 && fchmod(part.number(), former.st_mode & 07777) != 0)) {
      throw cannot(file, errno);
    }
    writeAll(part.number(), content, file);
    if (rename(temporary.c_str(), target.c_str()) != 0) {
      throw cannot(file, errno);
    }
  }
  catch (...) {
    unlink(temporary.c_str());
    throw;
  }
}
} // namespace

void requireWritable(const fs::path &file)
{
  const fs::path folder = fs::absolute(file).parent_path();
  if (!fs::is_directory(folder)) {
    throw std::runtime_error(file.string() + ": the folder " + folder.string() + " does not exist");
  }
  if (fs::is_directory(file)) {
    throw std::runtime_error(file.string() + ": is a folder, must be a file");
  }
  if (access((fs::exists(file) ? fs::absolute(file) : folder).c_str(), W_OK) != 0) {
    throw cannot(file, errno);
  }
}

void writeWholeFile(const fs::path &file, const std::string &content)
{
  // A device or a pipe is written to, never replaced; a link is kept.
  if (!fs::exists(file) || fs::is_regular_file(file)) {
    replace(fs::weakly_canonical(file), content, file);
    return;
  }
  const Descriptor device(file, O_WRONLY);
  if (device.number() < 0) {
    throw cannot(file, errno);
  }
  writeAll(device.number(), content, file);
}
} // namespace vpApp
