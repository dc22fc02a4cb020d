/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file testFolder.h
 * \brief An empty folder for one test, and the message of an exception.
 */
#ifndef vpApp_test_testFolder_h
#define vpApp_test_testFolder_h

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

//! An empty folder for one test, removed afterwards.
struct TestFolder {
  TestFolder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "visp-direct-test-XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~TestFolder() { std::filesystem::remove_all(path); }
  TestFolder(const TestFolder &) = delete;
  TestFolder &operator=(const TestFolder &) = delete;
  std::string write(const std::string &name, const std::string &content) const
  {
    std::filesystem::create_directories((path / name).parent_path());
    std::ofstream(path / name, std::ios::binary) << content;
    return (path / name).string();
  }
  [[nodiscard]] std::string file(const std::string &name) const { return (path / name).string(); }
  [[nodiscard]] std::vector<std::string> entries() const
  {
    std::vector<std::string> names;
    for (const std::filesystem::directory_entry &entry : std::filesystem::recursive_directory_iterator(path)) {
      names.push_back(entry.path().lexically_relative(path).string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  std::filesystem::path path;
};

//! Message of the exception thrown by a call.
template <typename Call> std::string complaint(const Call &call)
{
  try {
    call();
  }
  catch (const std::exception &error) {
    return error.what();
  }
  return "no exception";
}

#endif
