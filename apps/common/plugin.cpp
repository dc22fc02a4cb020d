/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "plugin.h"

#include "appMain.h"
#include "commandLine.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <dlfcn.h>
#include <link.h>

namespace vpApp
{
namespace
{
// The loader's message, without the path at its beginning.
std::string loaderSentence(const std::string &path)
{
  const char *said = dlerror();
  const std::string message = said == nullptr ? "no reason given" : said;
  const std::string prefix = path + ": ";
  return message.rfind(prefix, 0) == 0 ? message.substr(prefix.size()) : message;
}

// The section headers are a library's end. The loader trusts the file's length: one that was cut raises SIGBUS.
bool isCut(const std::filesystem::path &path)
{
  ElfW(Ehdr) header;
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char *>(&header), sizeof header) ||
      std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0 ||
      header.e_ident[EI_CLASS] != (sizeof(void *) == 8 ? ELFCLASS64 : ELFCLASS32)) {
    return false; // the loader says what it is
  }
  const auto size = std::filesystem::file_size(path);
  return header.e_shoff > size || header.e_shnum * std::uintmax_t(header.e_shentsize) > size - header.e_shoff;
}
} // namespace

void *pluginFunction(const std::string &file, const std::string &function, const std::string &header)
{
  const std::filesystem::path path = std::filesystem::absolute(file);
  if (!std::filesystem::is_regular_file(path)) {
    throw std::runtime_error(file + (std::filesystem::exists(path) ? ": is not a file" : ": no such file"));
  }
  if (isCut(path)) {
    throw std::runtime_error(file + ": cannot be loaded: its end is missing");
  }
  void *library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    throw std::runtime_error(file + ": cannot be loaded: " + loaderSentence(path.string()));
  }
  void *found = dlsym(library, function.c_str());
  if (found == nullptr) {
    throw std::runtime_error(file + ": has no function " + function + "(), see " + header);
  }
  return found;
}

void loadPlugin(const std::string &file)
{
  const auto add =
      reinterpret_cast<void (*)()>(pluginFunction(file, "vispDirectPlugin", "visp3/direct_core/vpPlugin.h"));
  try {
    add();
  }
  catch (const std::exception &error) {
    throw std::runtime_error(file + ": " + sentenceOf(error));
  }
  catch (...) {
    throw std::runtime_error(file + ": vispDirectPlugin() threw something that is no std::exception");
  }
}

void addPluginOption(CommandLine &line, const std::string &brings)
{
  line.add(
      "--plugin", "LIB.so", "Library with " + brings + " of your own (tutorial \"Your own law\"); may be repeated", "",
      [](const auto &files) {
        for (const std::string &file : files) {
          loadPlugin(file);
        }
      },
      0);
}
} // namespace vpApp
