/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file report.h
 * \brief The report of a result, made by Python from its data.
 */
#ifndef vpApp_report_h
#define vpApp_report_h

#include "outputFolder.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace vpApp
{
/*!
 * Ends a run: writes summary.json, lets `python3 -m visp_direct.report` make report.html of the data, and moves the result into
 * place. The interpreter is that of the build, or the one named by the environment variable `VISP_DIRECT_PYTHON`.
 * Where it or a package is missing the result is complete without report.html, and a sentence on the standard error says why.
 * \param summary : As for OutputFolder::writeSummary().
 * \param isKeptAfterCtrlC : The result counts although Ctrl-C ended the run.
 * \param hasAnswer : The report has an answer of its own, which is none of the findings in \e summary.
 * \return For the user: "Report: OUT/report.html", or "Data: OUT"; before it, if \e hasAnswer, that answer, a sentence on each line.
 * \throw std::runtime_error as OutputFolder::commit(); Interrupted after Ctrl-C, unless \e isKeptAfterCtrlC.
 */
std::string finishWithReport(OutputFolder &out, const nlohmann::ordered_json &summary, bool isKeptAfterCtrlC = false,
                             bool hasAnswer = false);
} // namespace vpApp

#endif
