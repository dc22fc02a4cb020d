/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// File of fitted covers: see vpArmCoverSpec::cacheFile.
#ifndef vpArmCoverCache_h
#define vpArmCoverCache_h

#include <visp3/avoidance/vpCapsuleCover.h>

#include <map>
#include <string>

BEGIN_VISP_NAMESPACE

// Entry of a body.
struct vpCachedCover {
  std::string key;        // of mesh, count and seed
  std::string fitted;     // of the capsules as they were fitted
  bool unchecked = false; // the user takes them without proof
  vpCapsuleCover cover;
};

// Hash (FNV-1a) of what a fit depends on; in hexadecimal digits.
std::string vpCoverKey(const vpTriangleMesh &mesh, int count, unsigned int seed);
// Hash of capsules.
std::string vpCapsulesKey(const std::vector<vpArmCapsule> &capsules);

class vpArmCoverCache
{
public:
  // An absent file is an empty one, and so is no name. Throws vpException.
  explicit vpArmCoverCache(const std::string &file);
  [[nodiscard]] const std::string &file() const { return m_file; }
  // Null if there is none.
  [[nodiscard]] const vpCachedCover *find(const std::string &body) const;
  void set(const std::string &body, const vpCachedCover &cover);
  // Writes the file if an entry was set, as a whole or not at all. Returns why it cannot be written, or an empty
  // sentence.
  [[nodiscard]] std::string save() const;

private:
  std::string m_file;
  std::map<std::string, vpCachedCover> m_covers;
  bool m_changed = false;
};

END_VISP_NAMESPACE
#endif
