/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "outputFile.h"

#include <array>
#include <cerrno>
#include <fstream>
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
constexpr const char *MARK = ".visp-direct-run";
constexpr int PATIENCE = 100; // retries when another process removes the folder while we enter it

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

bool isRealFolder(const fs::path &path)
{
  std::error_code ignored;
  return fs::symlink_status(path, ignored).type() == fs::file_type::directory;
}

bool isMarked(const fs::path &folder)
{
  std::error_code ignored;
  return isRealFolder(folder) && fs::symlink_status(folder / MARK, ignored).type() == fs::file_type::regular;
}

std::string ownerOf(const fs::path &folder) // empty if it was killed before writing its name
{
  std::array<char, 256> line{};
  std::ifstream(folder / MARK).getline(line.data(), line.size());
  return line.data();
}

// False if the mark was removed after opening, because its owner had ended.
bool stillThere(int descriptor)
{
  struct stat status {
  };
  return fstat(descriptor, &status) == 0 && status.st_nlink > 0;
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

FolderLock::FolderLock(const fs::path &folder, const std::string &owner) : m_folder(folder)
{
  try {
    lock(owner);
    clear();
    writeMark(owner);
  }
  catch (...) {
    if (m_mark >= 0) {
      close(m_mark);
    }
    throw;
  }
}

FolderLock::~FolderLock()
{
  if (m_mark >= 0) {
    close(m_mark);
  }
}

void FolderLock::lock(const std::string &owner)
{
  for (int attempt = 0; attempt < PATIENCE; ++attempt) {
    const bool made = mkdir(m_folder.c_str(), 0777) == 0;
    if (!made && errno != EEXIST) {
      throw cannot(m_folder.parent_path(), errno);
    }
    if (!made && !isLeftoverOf(owner, m_folder)) {
      throw std::runtime_error(m_folder.string() + ": is not a leftover of " + owner +
                               ", so it is left alone; move it away or name another folder");
    }
    m_mark = open((m_folder / MARK).c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (m_mark < 0 && errno == ENOENT) {
      continue;
    }
    if (m_mark < 0) {
      throw cannot(m_folder.parent_path(), errno);
    }
    if (flock(m_mark, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      const std::string holder = ownerOf(m_folder);
      throw std::runtime_error(m_folder.parent_path().string() + ": another run" +
                               (holder.empty() ? "" : " of " + holder) +
                               " is writing into it; wait for its end or name another folder");
    }
    if (stillThere(m_mark)) { // also on file systems without locks
      return;
    }
    close(m_mark);
    m_mark = -1;
  }
  throw std::runtime_error(m_folder.string() + ": is made and removed by other runs all the time");
}

void FolderLock::clear() const
{
  for (const fs::directory_entry &entry : fs::directory_iterator(m_folder)) {
    if (!isMark(entry.path())) {
      fs::remove_all(entry.path());
    }
  }
}

// Enough bytes to detect a full disk before any computation.
void FolderLock::writeMark(const std::string &owner) const
{
  constexpr std::size_t SIZE = 4096;
  std::string text = owner + "\nA run that has not ended, or was killed. The next run into this folder removes it.\n";
  text.resize(SIZE, '\n');
  const bool written = ftruncate(m_mark, 0) == 0 && pwrite(m_mark, text.data(), SIZE, 0) == SIZE && fsync(m_mark) == 0;
  if (!written) {
    const int reason = errno;
    unlink((m_folder / MARK).c_str());
    rmdir(m_folder.c_str());
    throw cannot(m_folder.parent_path(), reason != 0 ? reason : ENOSPC);
  }
}

void FolderLock::remove()
{
  std::error_code ignored;
  for (const fs::directory_entry &entry : fs::directory_iterator(m_folder, ignored)) {
    if (!isMark(entry.path())) {
      fs::remove_all(entry.path(), ignored);
    }
  }
  unlink((m_folder / MARK).c_str());
  rmdir(m_folder.c_str()); // fails if the next run already uses it
}

bool FolderLock::isMark(const fs::path &file) { return file.filename() == MARK; }

bool FolderLock::isLeftoverOf(const std::string &owner, const fs::path &folder)
{
  std::error_code ignored;
  return isMarked(folder) ? ownerOf(folder).empty() || ownerOf(folder) == owner
                          : isRealFolder(folder) && fs::is_empty(folder, ignored);
}
} // namespace vpApp
