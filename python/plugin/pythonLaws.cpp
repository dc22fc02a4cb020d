/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Laws written in Python for the programs: VISP_DIRECT_LAWS=mine.py visp-servo-compare --plugin .../visp_direct/laws.so. The file
// calls ServoLaw.add() for each.
#include <Python.h>

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpDirectCompat.h>
#include <visp3/direct_core/vpPlugin.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include <dlfcn.h>

VISP_DIRECT_USING_NAMESPACE

namespace
{
std::string fileOf(const void *symbol)
{
  Dl_info info{};
  return dladdr(symbol, &info) != 0 ? info.dli_fname : "";
}

std::string quoted(const std::string &text)
{
  std::string result = "'";
  for (const char c : text) {
    result += (c == '\'' || c == '\\' ? "\\" : "") + std::string(1, c);
  }
  return result + "'";
}
} // namespace

extern "C" void vispDirectPlugin()
{
  const char *file = std::getenv("VISP_DIRECT_LAWS");
  if (file == nullptr || !std::filesystem::is_regular_file(file)) {
    throw vpException(vpException::ioError, "%s: is no file with laws in Python, set VISP_DIRECT_LAWS to one",
                      file == nullptr ? "VISP_DIRECT_LAWS is not set" : file);
  }
  // numpy and others take Python's symbols from the process, and a plug-in is loaded with its own ones hidden.
  dlopen(fileOf(reinterpret_cast<const void *>(&Py_InitializeEx)).c_str(), RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD);
  Py_InitializeEx(0); // for the rest of the process, as what add() adds
  const std::filesystem::path package =
      std::filesystem::absolute(fileOf(reinterpret_cast<const void *>(&vispDirectPlugin)));
  const std::string code = "import runpy, sys\nsys.path.insert(0, " +
                           quoted(package.parent_path().parent_path().string()) + ")\nrunpy.run_path(" + quoted(file) +
                           ")\n";
  const bool good = PyRun_SimpleString(code.c_str()) == 0; // prints where in the file an exception comes from
  PyEval_SaveThread();
  if (!good) {
    throw vpException(vpException::badValue, "%s: has not run to its end", file);
  }
}
