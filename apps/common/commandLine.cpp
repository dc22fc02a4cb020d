/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "commandLine.h"

#include "appMain.h"
#include "dataFile.h"
#include "numberText.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <sstream>

namespace vpApp
{
namespace
{
constexpr std::size_t NAME_COLUMN = 30;  // where the sentences of options begin
constexpr std::size_t HELP_COLUMNS = 80; // width of the help

//! The words in lines of at most width characters, between them what separates lines. A longer word has a line of its own.
std::string wrapped(const std::string &text, std::size_t width, const std::string &separator)
{
  std::string lines;
  std::size_t column = 0;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const bool fits = column + 1 + word.size() <= width;
    lines += (column == 0 ? "" : fits ? " " : separator) + word;
    column = (column > 0 && fits ? column + 1 : 0) + word.size();
  }
  return lines;
}

/*!
 * The text above and below the options, its paragraphs wrapped. A line that begins with two blanks is a command; where it is too long it
 * goes on after a backslash, so that it can be copied. Lines that begin with more blanks say what the command does.
 */
std::string wrappedText(const std::string &text)
{
  std::string all, paragraph;
  std::size_t indent = 0;
  const auto end = [&all, &paragraph, &indent] {
    if (!paragraph.empty()) {
      const std::string blanks(indent, ' ');
      all += blanks +
             (indent == 2 ? wrapped(paragraph, HELP_COLUMNS - 6, " \\\n    ")
                          : wrapped(paragraph, HELP_COLUMNS - indent, "\n" + blanks)) +
             "\n";
      paragraph.clear();
    }
  };
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin != indent || indent == 2) {
      end();
    }
    if (begin == std::string::npos) {
      all += '\n';
      continue;
    }
    indent = begin;
    paragraph += line + ' ';
  }
  end();
  return all;
}

//! Wraps all text at the same width.
class HelpFormatter : public CLI::Formatter
{
public:
  HelpFormatter()
  {
    column_width(NAME_COLUMN);
    label("Positionals", "Arguments");
  }
  std::string make_description(const CLI::App *app) const override
  {
    return wrappedText(app->get_description()) + "\n";
  }
  std::string make_option_desc(const CLI::Option *option) const override
  {
    // CLI11 indents what follows a line end.
    return wrapped(withDataPaths(option->get_description()), HELP_COLUMNS - NAME_COLUMN, "\n");
  }
  std::string make_footer(const CLI::App *app) const override { return wrappedText(app->get_footer()); }
};

[[noreturn]] void refuse(const std::string &option, const std::string &text, const std::string &wanted)
{
  throw UsageError(option + " is " + text + ", must be " + wanted);
}

// "a number >= 0 and <= 10"
std::string wantedNumber(const Range &range)
{
  std::string wanted = "a number";
  if (std::isfinite(range.least)) {
    wanted += (range.above ? " > " : " >= ") + number(range.least, 6);
  }
  if (std::isfinite(range.most)) {
    wanted += (std::isfinite(range.least) ? " and <= " : " <= ") + number(range.most, 6);
  }
  return wanted;
}

std::string either(const std::vector<std::string> &names)
{
  std::string sentence;
  for (std::size_t i = 0; i < names.size(); ++i) {
    sentence += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  }
  return sentence;
}

// CLI11 says "--out: 1 required TEXT missing" and "--out: At most 1 required but received 2".
std::string mismatchSentence(const CLI::App &app, const std::string &message)
{
  const std::string name = message.substr(0, message.find(':'));
  const CLI::Option *option = app.get_option_no_throw(name);
  if (option == nullptr) {
    return message;
  }
  if (message.find("ost ") != std::string::npos) {
    return name + " is given more than once";
  }
  const int count = option->get_items_expected_min();
  return name + " is given without " + (count > 1 ? "its " + std::to_string(count) + " values" : "a value");
}

//! Number of letters to insert, remove or replace between two words.
std::size_t distanceOf(const std::string &a, const std::string &b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t corner = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = corner + (a[i] == b[j] ? 0 : 1);
      corner = row[j + 1];
      row[j + 1] = std::min({replaced, corner + 1, row[j] + 1});
    }
  }
  return row.back();
}

//! The option that was probably meant, or nothing.
std::string nearestOption(const CLI::App &app, const std::string &word)
{
  std::string nearest;
  std::size_t least = 3; // letters
  for (const CLI::Option *option : app.get_options()) {
    for (const std::string &name : option->get_lnames()) {
      const std::size_t distance = distanceOf(word, "--" + name);
      if (distance < least) {
        least = distance;
        nearest = "--" + name;
      }
    }
  }
  return nearest;
}

std::string extraSentence(const CLI::App &app)
{
  const std::vector<std::string> extras = app.remaining();
  const auto option = std::find_if(extras.begin(), extras.end(), [](const auto &word) { return word[0] == '-'; });
  if (option == extras.end()) {
    return "unexpected argument \"" + extras.front() + "\"";
  }
  const std::string word = option->substr(0, option->find('=')), nearest = nearestOption(app, word);
  return "there is no option " + word + (nearest.empty() ? "" : ", did you mean " + nearest + "?");
}
} // namespace

double numberIn(const std::string &option, const std::string &text, const Range &range)
{
  char *end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool whole = !text.empty() && end == text.c_str() + text.size() && std::isspace(text[0]) == 0;
  if (!whole || !std::isfinite(value) || !(range.above ? value > range.least : value >= range.least) ||
      !(value <= range.most)) {
    refuse(option, text, wantedNumber(range));
  }
  return value;
}

long long wholeIn(const std::string &option, const std::string &text, const Range &range)
{
  char *end = nullptr;
  errno = 0;
  const long long value = std::strtoll(text.c_str(), &end, 10);
  const bool whole = !text.empty() && end == text.c_str() + text.size() && std::isspace(text[0]) == 0 && errno == 0;
  const auto real = static_cast<double>(value);
  if (!whole || !(real >= range.least) || !(real <= range.most)) {
    refuse(option, text,
           std::isfinite(range.most)
               ? "a whole number from " + number(range.least, 12) + " to " + number(range.most, 12)
               : "a whole number >= " + number(range.least, 12));
  }
  return value;
}

std::vector<double> numbersIn(const std::string &option, const std::string &text, const Range &range)
{
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    numbers.push_back(numberIn(option, text.substr(begin, end - begin), range));
    begin = end + 1;
  }
  return numbers;
}

CommandLine::CommandLine(const std::string &program, const std::string &about, const std::string &examples)
  : m_app(std::make_unique<CLI::App>(about, program))
{
  m_app->formatter(std::make_shared<HelpFormatter>());
  m_app->footer(withDataPaths(examples));
}

CommandLine::~CommandLine() = default;

void CommandLine::add(const std::string &names, const std::string &placeholder, const std::string &sentence,
                      const std::string &preset, Reader read, int count)
{
  const std::string name = names.substr(0, names.find(','));
  const bool stated = preset.empty() || sentence.find("(default") != std::string::npos;
  CLI::Option *option = m_app->add_option(
      names,
      [name, read = std::move(read)](const CLI::results_t &values) {
        for (const std::string &value : values) {
          // A name that a script left empty would be taken as not given; CLI11 takes the next option for a value.
          if (value.empty() || value.rfind("--", 0) == 0) {
            throw UsageError(name + " is given without a value");
          }
        }
        read(values);
        return true;
      },
      stated ? sentence : sentence + " (default: " + preset + ")");
  option->option_text(placeholder);
  if (count > 1) {
    option->expected(count);
  }
  else if (count < 0) {
    option->expected(1, CLI::detail::expected_max_vector_size)->allow_extra_args();
  }
  else if (count == 0) {
    option->expected(1, CLI::detail::expected_max_vector_size)->allow_extra_args(false);
  }
  if (!m_group.empty()) {
    option->group(m_group);
  }
}

void CommandLine::flag(const std::string &name, bool &value, const std::string &sentence)
{
  CLI::Option *option = m_app->add_flag(name, value, sentence);
  if (!m_group.empty()) {
    option->group(m_group);
  }
}

void CommandLine::text(const std::string &name, std::string &value, const std::string &placeholder,
                       const std::string &sentence)
{
  add(name, placeholder, sentence, value, [&value](const auto &values) { value = values[0]; });
}

void CommandLine::list(const std::string &name, std::vector<std::string> &values, const std::string &placeholder,
                       const std::string &sentence)
{
  std::string preset;
  for (const std::string &value : values) {
    preset += (preset.empty() ? "" : ",") + value;
  }
  const Reader read = [&values, name](const auto &texts) {
    values.clear();
    for (const std::string &text : texts) {
      std::size_t begin = 0;
      for (std::size_t comma = 0; comma != std::string::npos; begin = comma + 1) {
        comma = text.find(',', begin);
        const std::size_t length = (comma == std::string::npos ? text.size() : comma) - begin;
        if (length == 0) {
          throw UsageError(name + " is " + text + ", which has an empty name");
        }
        values.push_back(text.substr(begin, length));
      }
    }
  };
  add(name, placeholder, sentence, preset, read, 0);
}

void CommandLine::number(const std::string &name, double &value, const Range &range, const std::string &placeholder,
                         const std::string &sentence)
{
  add(name, placeholder, sentence, std::isnan(value) ? "" : vpApp::number(value, 6),
      [&value, name, range](const auto &values) { value = numberIn(name, values[0], range); });
}

void CommandLine::chooseFrom(const std::string &name, const std::vector<std::string> &names, const std::string &preset,
                             const std::string &sentence, std::function<void(std::size_t)> choose)
{
  const bool listed = sentence.find(names.front()) != std::string::npos;
  add(name, "NAME", listed ? sentence : sentence + ": " + either(names), preset,
      [name, names, choose = std::move(choose)](const auto &values) {
        const auto found = std::find(names.begin(), names.end(), values[0]);
        if (found == names.end()) {
          refuse(name, values[0], either(names));
        }
        choose(static_cast<std::size_t>(found - names.begin()));
      });
}

bool CommandLine::parse(int argc, const char *const *argv)
{
  m_app->set_version_flag("--version", m_app->get_name() + " " + versionText());
  try {
    m_app->parse(argc, argv);
    return true;
  }
  catch (const CLI::Success &request) { // --help, --version
    m_app->exit(request);
    return false;
  }
  catch (const CLI::ArgumentMismatch &error) {
    throw UsageError(mismatchSentence(*m_app, error.what()));
  }
  catch (const CLI::ExtrasError &) {
    throw UsageError(extraSentence(*m_app));
  }
  catch (const CLI::ParseError &error) {
    throw UsageError(error.what());
  }
}

std::vector<std::string> CommandLine::given() const
{
  std::vector<std::string> names;
  for (const CLI::Option *option : m_app->get_options()) {
    if (option->count() > 0) {
      names.push_back(option->get_name());
    }
  }
  return names;
}

bool CommandLine::isGiven(const std::string &name) const { return m_app->get_option(name)->count() > 0; }
} // namespace vpApp
