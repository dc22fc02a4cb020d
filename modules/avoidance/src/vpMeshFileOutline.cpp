/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMeshFileOutline.h"

#include "vpFileText.h"
#include "vpPlyOutline.h"
#include "vpXmlOutline.h"

#include <map>
#include <set>
#include <sstream>
#include <vector>

namespace
{
constexpr double mostRepetitions = 1e5;

[[noreturn]] void fail(const std::string &file, const std::string &what) { throw vpFileError(file + ": " + what); }

struct Tag {
  std::string name;               // with a slash in front at an end
  std::string attributes;         // as in the text, with a slash behind if the element is empty
  std::size_t begin = 0, end = 0; // in the text
  [[nodiscard]] bool isEmpty() const { return !attributes.empty() && attributes.back() == '/'; }
  // As in the text, without its quotes; empty if missing.
  [[nodiscard]] std::string attribute(const std::string &field) const
  {
    for (std::size_t at = 0; (at = attributes.find_first_not_of(" \t\r\n", at)) != std::string::npos;) {
      const std::size_t first = at, quote = attributes.find_first_of("\"'", at);
      if (quote == std::string::npos) {
        break;
      }
      const std::size_t last = std::min(attributes.find(attributes[quote], quote + 1), attributes.size());
      if (attributes.substr(first, attributes.find_first_of(" \t\r\n=", first) - first) == field) {
        return attributes.substr(quote + 1, last - quote - 1);
      }
      at = last + 1;
    }
    return "";
  }
};

// An attribute that names an element; escapes could hide which.
std::string nameIn(const Tag &tag, const std::string &field, const std::string &file)
{
  const std::string text = tag.attribute(field);
  if (text.find_first_of("&%") != std::string::npos) {
    fail(file, field + " of an element " + tag.name + " is \"" + vpPrintable(text, 60) + "\", must be without & and %");
  }
  return text;
}

// The next tag of well-formed XML; false at its end.
bool nextTag(const std::string &text, std::size_t &at, Tag &tag)
{
  for (at = text.find('<', at); at != std::string::npos; at = text.find('<', at)) {
    const char *close = nullptr;
    for (const auto &aside : {std::make_pair("<!--", "-->"), std::make_pair("<![CDATA[", "]]>"),
                              std::make_pair("<?", "?>"), std::make_pair("<!D", ">")}) {
      close = close == nullptr && text.compare(at, std::char_traits<char>::length(aside.first), aside.first) == 0
                  ? aside.second
                  : close;
    }
    if (close != nullptr) {
      at = std::min(text.find(close, at), text.size() - 1) + 1;
      continue;
    }
    tag.begin = at;
    char quote = '\0'; // a value may contain >
    while (++at < text.size() && (quote != '\0' || text[at] != '>')) {
      quote = quote != '\0'                         ? (text[at] == quote ? '\0' : quote)
              : text[at] == '"' || text[at] == '\'' ? text[at]
                                                    : '\0';
    }
    tag.end = std::min(at + 1, text.size());
    const std::string inside = text.substr(tag.begin + 1, at - tag.begin - 1);
    const std::size_t blank = std::min(inside.find_first_of(" \t\r\n"), inside.size());
    tag.name = inside.substr(0, blank);
    tag.attributes = inside.substr(blank);
    if (tag.attributes.empty() && tag.name.size() > 1 && tag.name.back() == '/') {
      tag.name.pop_back();
      tag.attributes = "/";
    }
    return true;
  }
  return false;
}

// Which nodes contain instances of which others, by id and by name: assimp looks for both.
using Instances = std::map<std::string, std::vector<std::string>>;

Instances instancesOf(const std::string &text, const std::string &file)
{
  Instances instances;
  std::vector<std::set<std::string>> open; // names of the nodes around the current position
  Tag tag;
  for (std::size_t at = 0; nextTag(text, at, tag);) {
    if (tag.name == "node" && !tag.isEmpty()) {
      open.push_back({nameIn(tag, "id", file), nameIn(tag, "name", file), nameIn(tag, "sid", file)});
    }
    else if (tag.name == "/node" && !open.empty()) {
      open.pop_back();
    }
    else if (tag.name == "instance_controller") {
      fail(file, "has an instance_controller, must be without skins");
    }
    else if (tag.name == "instance_node") {
      const std::string url = nameIn(tag, "url", file);
      for (const auto &names : open) {
        for (const std::string &name : names) {
          instances[name].push_back(url.substr(url.empty() ? 0 : 1));
        }
      }
    }
  }
  return instances;
}

// Number of nodes that an instance becomes. Without recursion: a chain may be long.
void requireFewInstances(const std::string &text, const std::string &file)
{
  const Instances instances = instancesOf(text, file);
  std::map<std::string, double> counts; // -1: being counted
  double sum = 0.;
  for (const auto &first : instances) {
    std::vector<std::string> path{first.first};
    while (!path.empty()) {
      const std::string name = path.back();
      const auto found = instances.find(name);
      double count = 1.;
      bool ready = true;
      counts.emplace(name, -1.);
      for (const std::string &other : found == instances.end() ? std::vector<std::string>() : found->second) {
        const auto known = counts.find(other);
        if (known == counts.end()) {
          path.push_back(other);
          ready = false;
          break;
        }
        if (known->second < 0.) {
          fail(file, "node " + vpPrintable(other, 60) + " contains an instance of itself");
        }
        count += known->second;
      }
      if (ready) {
        counts[name] = count;
        path.pop_back();
      }
    }
    sum += counts[first.first];
  }
  if (!(sum <= mostRepetitions)) {
    fail(file, "repeats its nodes more than 100000 times");
  }
}

std::size_t wholeNumber(const Tag &tag, const std::string &field, const std::string &file)
{
  const std::string text = tag.attribute(field);
  const bool missing = text.empty() && field != "count"; // the format's default
  if (!missing && (text.empty() || text.size() > 9 || text.find_first_not_of("0123456789") != std::string::npos)) {
    fail(file, field + " of an element " + tag.name + " is \"" + vpPrintable(text, 60) + "\", must be a whole number");
  }
  return missing ? (field == "stride" ? 1 : 0) : std::stoul(text);
}

std::size_t wordsIn(const std::string &text)
{
  std::istringstream in(text);
  std::size_t count = 0;
  for (std::string word; in >> word;) {
    ++count;
  }
  return count;
}

// Accessors within their arrays, arrays of as many numbers as they say: assimp does not look.
void requireArrays(const std::string &text, const std::string &file)
{
  std::map<std::string, std::size_t> sizes;
  Tag tag, array, accessor, indices;
  std::size_t params = 0;
  std::vector<std::pair<std::string, std::size_t>> ends; // of accessors in their arrays
  for (std::size_t at = 0; nextTag(text, at, tag);) {
    if (tag.name == "float_array") {
      array = tag;
      sizes[nameIn(tag, "id", file)] = 0;
    }
    else if (tag.name == "/float_array") {
      const std::size_t count = wholeNumber(array, "count", file);
      if (count != wordsIn(text.substr(array.end, tag.begin - array.end))) {
        fail(file, "float_array " + vpPrintable(array.attribute("id"), 60) + " has not the " + std::to_string(count) +
                       " numbers that it says");
      }
      sizes[array.attribute("id")] = count;
    }
    else if (tag.name == "p" || tag.name == "vcount" || tag.name == "h") {
      indices = tag;
    }
    else if (tag.name == "/p" || tag.name == "/vcount" || tag.name == "/h") {
      if (text.find_first_not_of("0123456789+- \t\r\n", indices.end) < tag.begin) {
        fail(file, "an element " + indices.name + " has more than whole numbers"); // assimp would not end
      }
    }
    else if (tag.name == "Name_array" || tag.name == "IDREF_array") {
      sizes[nameIn(tag, "id", file)] = 0; // no numbers
    }
    else if (tag.name == "accessor") {
      accessor = tag;
      params = 0;
    }
    else if (tag.name == "param" && ++params > 0) {
      continue;
    }
    if (tag.name == "/accessor" || (tag.name == "accessor" && tag.isEmpty())) {
      const std::size_t count = wholeNumber(accessor, "count", file), stride = wholeNumber(accessor, "stride", file);
      const std::string source = nameIn(accessor, "source", file);
      if (stride < params) {
        fail(file, "the accessor of " + vpPrintable(source, 60) + " has more parameters than its stride");
      }
      ends.emplace_back(source.substr(source.empty() ? 0 : 1), wholeNumber(accessor, "offset", file) + count * stride);
    }
  }
  for (const auto &end : ends) {
    const auto size = sizes.find(end.first);
    if (size != sizes.end() && end.second > size->second) {
      fail(file, "an accessor goes beyond the end of " + vpPrintable(end.first, 60));
    }
  }
}

// Elements that a mesh does not need, directly below the root.
void removeExtras(std::string &text)
{
  const std::set<std::string> extras{"library_effects",     "library_images",     "library_materials",
                                     "library_controllers", "library_animations", "library_cameras",
                                     "library_lights"};
  std::string kept;
  std::size_t from = 0;
  std::string removing;
  Tag tag;
  for (std::size_t at = 0; nextTag(text, at, tag);) {
    if (removing.empty() && extras.count(tag.name) > 0) {
      kept.append(text, from, tag.begin - from);
      from = tag.end;
      removing = tag.isEmpty() ? "" : tag.name;
    }
    else if (tag.name == "/" + removing) {
      from = tag.end;
      removing.clear();
    }
  }
  text = kept.append(text, from, std::string::npos);
}

// The indices of a primitive come after its inputs, by whose number assimp divides theirs.
void requireInputs(const std::vector<vpXmlElement> &elements, const std::string &file)
{
  static const std::set<std::string> primitives{"triangles",  "polylist",  "polygons", "lines",
                                                "linestrips", "tristrips", "trifans"};
  std::set<int> complete;
  for (const vpXmlElement &element : elements) {
    if (element.parent < 0 || primitives.count(elements[static_cast<std::size_t>(element.parent)].name) == 0) {
      continue;
    }
    const auto semantic = element.attributes.find("semantic");
    if (element.name == "input" && semantic != element.attributes.end() && semantic->second == "VERTEX") {
      complete.insert(element.parent);
    }
    else if (element.name != "input" && element.name != "extra" && complete.count(element.parent) == 0) {
      fail(file, "an element " + elements[static_cast<std::size_t>(element.parent)].name +
                     " has no input VERTEX before its indices");
    }
  }
}
} // namespace

void vpRequireMeshOutline(std::string &bytes, const std::string &extension, const std::string &file)
{
  if (bytes.empty()) {
    fail(file, "is empty");
  }
  if (extension == "dae") {
    requireInputs(vpReadXmlOutline(bytes, file, false), file);
    requireFewInstances(bytes, file);
    removeExtras(bytes);
    requireArrays(bytes, file);
  }
  if (extension == "ply") {
    vpRequirePlyOutline(bytes, file);
  }
}
