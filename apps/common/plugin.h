/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file plugin.h
 * \brief Option --plugin: libraries of the user with laws, planners or forms; see visp3/direct_core/vpPlugin.h.
 */
#ifndef vpApp_plugin_h
#define vpApp_plugin_h

#include <string>

namespace vpApp
{
class CommandLine;

/*!
 * Declares `--plugin LIB.so`, which may be repeated. Parsing the command line loads the libraries in their order; declare it
 * before options whose readers look up what plug-ins add.
 * \param brings : What the program takes from them: "laws".
 */
void addPluginOption(CommandLine &line, const std::string &brings);

/*!
 * Loads a library and calls its vispDirectPlugin(). It is never unloaded.
 * \param file : Path of the library, relative to the working directory or absolute; no search path is used.
 * \throw std::runtime_error naming the file, and what is wrong with it or what the function threw.
 */
void loadPlugin(const std::string &file);
/*!
 * Loads a library, never unloaded, and finds a C function in it. \param file : As above. \param function : Its name. \param header :
 * That describes it.
 * \throw std::runtime_error naming the file.
 */
[[nodiscard]] void *pluginFunction(const std::string &file, const std::string &function, const std::string &header);
} // namespace vpApp

#endif
