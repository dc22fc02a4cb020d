/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The includes of the sources against the picture of the house, doc/house.dot: every include follows an arrow, every arrow
// is used, and neither rooms nor files include each other in a circle.
#include "vpCatch.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace fs = std::filesystem;
using Graph = std::map<std::string, std::set<std::string>>;

namespace
{
const fs::path root = VISP_DIRECT_SOURCE_DIR;

std::string read(const fs::path &file)
{
  std::ifstream stream(file);
  REQUIRE(stream);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

//! Of a path from the root, as in the picture.
std::string roomOf(const fs::path &file)
{
  auto part = file.begin();
  const std::string first = *part++;
  if (first == "modules") {
    return *part;
  }
  return first == "apps" && *part == "common" ? "common" : first;
}

bool isTest(const fs::path &file)
{
  return std::any_of(file.begin(), file.end(), [](const fs::path &p) { return p == "test" || p == "benchmark"; });
}

//! Headers and sources of all rooms, from the root.
std::vector<fs::path> sources()
{
  std::vector<fs::path> files;
  for (const char *top : {"modules", "lab", "apps", "support", "tutorial", "python"}) {
    for (const auto &entry : fs::recursive_directory_iterator(root / top)) {
      if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp") {
        files.push_back(fs::relative(entry.path(), root));
      }
    }
  }
  return files;
}

//! What a file includes of ours, from the root.
std::vector<fs::path> includesOf(const fs::path &file, const std::map<std::string, std::vector<fs::path>> &byName)
{
  static const std::regex line("(?:^|\n)[ \t]*#[ \t]*include[ \t]*[<\"]([^>\"]+)[>\"]");
  const std::string text = read(root / file);
  std::vector<fs::path> found;
  for (std::sregex_iterator i(text.begin(), text.end(), line), end; i != end; ++i) {
    const fs::path name = (*i)[1].str();
    const auto known = byName.find(name.filename());
    if (known == byName.end()) {
      continue;
    }
    std::vector<fs::path> fitting;
    std::copy_if(known->second.begin(), known->second.end(), std::back_inserter(fitting),
                 [&](const fs::path &candidate) {
                   const std::string whole = "/" + candidate.generic_string(), end = "/" + name.generic_string();
                   return whole.size() >= end.size() && whole.compare(whole.size() - end.size(), end.size(), end) == 0;
                 });
    const auto near = std::find_if(fitting.begin(), fitting.end(), [&](const fs::path &candidate) {
      return candidate.parent_path() == file.parent_path() || roomOf(candidate) == roomOf(file);
    });
    if (!fitting.empty()) {
      found.push_back(near != fitting.end() ? *near : fitting.front());
    }
  }
  return found;
}

Graph picture()
{
  const std::string text = std::regex_replace(read(root / "doc" / "house.dot"), std::regex("//[^\n]*"), "");
  static const std::regex arrow("(\\w+)\\s*->\\s*(?:\\{([^}]*)\\}|(\\w+))\\s*;"), word("\\w+");
  Graph graph;
  for (std::sregex_iterator i(text.begin(), text.end(), arrow), end; i != end; ++i) {
    const std::string to = (*i)[2].str() + (*i)[3].str();
    for (std::sregex_iterator j(to.begin(), to.end(), word); j != end; ++j) {
      graph[(*i)[1]].insert(j->str());
    }
  }
  return graph;
}

//! The members of a circle, "a -> b -> a"; empty when there is none.
std::string circle(const Graph &graph)
{
  std::map<std::string, int> state; // 1: on the way, 2: done
  std::string found;
  const std::function<void(const std::string &, const std::string &)> visit = [&](const std::string &node,
                                                                                  const std::string &way) {
    const std::string here = way + " -> " + node;
    if (state[node] == 1) {
      found = here;
    }
    if (state[node] != 0 || !found.empty()) {
      return;
    }
    state[node] = 1;
    const auto next = graph.find(node);
    if (next != graph.end()) {
      for (const std::string &to : next->second) {
        visit(to, here);
      }
    }
    state[node] = 2;
  };
  for (const auto &[node, to] : graph) {
    visit(node, "");
  }
  return found;
}
} // namespace

TEST_CASE("Every include follows an arrow of the picture, and nothing goes in a circle", "[architecture]")
{
  const std::vector<fs::path> files = sources();
  REQUIRE(files.size() > 300);
  std::map<std::string, std::vector<fs::path>> byName;
  for (const fs::path &file : files) {
    if (file.extension() == ".h") {
      byName[file.filename()].push_back(file);
    }
  }
  const Graph drawn = picture();
  Graph used, includes;
  for (const fs::path &file : files) {
    for (const fs::path &header : includesOf(file, byName)) {
      includes[file.generic_string()].insert(header.generic_string());
      const std::string from = roomOf(file), to = roomOf(header);
      INFO(file << " includes " << header);
      if (file.begin()->string() == "modules") { // its tests, too
        CHECK((to != "lab" && to != "apps" && to != "common"));
      }
      if (from != to && !isTest(file) && !isTest(header)) {
        used[from].insert(to);
        CHECK((drawn.count(from) == 1 && drawn.at(from).count(to) == 1));
      }
    }
  }
  CHECK(circle(drawn) == "");
  CHECK(circle(includes) == "");
  for (const auto &[from, to] : drawn) {
    for (const std::string &room : to) {
      INFO("the picture draws " << from << " -> " << room);
      CHECK(used[from].count(room) == 1);
    }
  }
}

TEST_CASE("A circle is found", "[architecture]")
{
  CHECK(circle({{"a", {"b"}}, {"b", {"c"}}}) == "");
  CHECK(circle({{"a", {"b"}}, {"b", {"c"}}, {"c", {"b"}}}) == " -> a -> b -> c -> b");
}
