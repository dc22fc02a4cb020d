# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Reports of the programs, made from the data that they write: python3 -m visp_direct.report OUT [OUT2...] [--paper]

A report is one file, report.html in OUT, that needs no network. Several results of one program stand side by side, in the first
folder. --paper writes each figure as PDF, one column wide, into OUT/paper."""
