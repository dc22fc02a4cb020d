/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpDirectCompat.h
 * \brief One header that hides the differences between ViSP 3.5 and its successors.
 *
 * From 3.7.1 on ViSP's classes live in a namespace by default. Public headers open it with
 * `BEGIN_VISP_NAMESPACE` and close it with `END_VISP_NAMESPACE`; source files, tests and programs write
 * `VISP_DIRECT_USING_NAMESPACE` once after their includes.
 */
#ifndef vpDirectCompat_h
#define vpDirectCompat_h

#include <visp3/core/vpConfig.h>

#ifndef BEGIN_VISP_NAMESPACE
#define BEGIN_VISP_NAMESPACE
#define END_VISP_NAMESPACE
#endif

#ifndef VP_OVERRIDE
#define VP_OVERRIDE override
#endif

#if defined(ENABLE_VISP_NAMESPACE)
#define VISP_DIRECT_USING_NAMESPACE using namespace VISP_NAMESPACE_NAME;
#else
#define VISP_DIRECT_USING_NAMESPACE
#endif

#endif
