/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file commandLine.h
 * \brief The command line of a program: each option's name, range, default, placeholder and sentence in one call.
 */
#ifndef vpApp_commandLine_h
#define vpApp_commandLine_h

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace CLI
{
class App;
class Option;
} // namespace CLI

namespace vpApp
{
//! \brief Where a number of the command line must be.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool above = false; //!< Least itself is outside.
};

//! A number. \throw UsageError "--latency is -1, must be a number >= 0 and <= 10", also for NaN and infinity.
[[nodiscard]] double numberIn(const std::string &option, const std::string &text, const Range &range);
//! A whole number. \throw UsageError "--jobs is 0, must be a whole number from 1 to 256".
[[nodiscard]] long long wholeIn(const std::string &option, const std::string &text, const Range &range);
//! Numbers separated by commas. \throw UsageError naming the first that is not one, as numberIn().
[[nodiscard]] std::vector<double> numbersIn(const std::string &option, const std::string &text,
                                            const Range &range = {});

/*!
 * \brief Options of a program. A variable's value at the time of the call is the default, which the help states unless
 * the sentence has a "(default" of its own or there is nothing to state. Variables must outlive parse().
 */
class CommandLine
{
public:
  using Reader = std::function<void(const std::vector<std::string> &values)>;

  //! \param program : Its name. \param about : Above the options. \param examples : Below them. Files data/NAME, here and
  //! in the sentences of options, are printed as withDataPaths() finds them.
  CommandLine(const std::string &program, const std::string &about, const std::string &examples);
  ~CommandLine();
  CommandLine(const CommandLine &) = delete;
  CommandLine &operator=(const CommandLine &) = delete;

  //! Heading of the options that follow.
  void group(const std::string &heading) { m_group = heading; }
  //! An option without a value.
  void flag(const std::string &name, bool &value, const std::string &sentence);
  //! A text, for example the name of a file; a name without dashes is an argument without a name.
  void text(const std::string &name, std::string &value, const std::string &placeholder, const std::string &sentence);
  //! Texts separated by commas, or the option several times.
  void list(const std::string &name, std::vector<std::string> &values, const std::string &placeholder,
            const std::string &sentence);
  //! A finite number.
  void number(const std::string &name, double &value, const Range &range, const std::string &placeholder,
              const std::string &sentence);
  //! A whole number. \param range : Must fit into Integer.
  template <class Integer>
  void whole(const std::string &name, Integer &value, const Range &range, const std::string &placeholder,
             const std::string &sentence)
  {
    add(name, placeholder, sentence, std::to_string(value),
        [&value, name, range](const auto &values) { value = static_cast<Integer>(wholeIn(name, values[0], range)); });
  }
  //! One of some names, which the help lists unless the sentence has the first of them.
  template <class Value>
  void choice(const std::string &name, Value &value, const std::vector<std::pair<std::string, Value>> &choices,
              const std::string &sentence)
  {
    std::vector<std::string> names;
    std::string preset;
    for (const auto &[word, meaning] : choices) {
      names.push_back(word);
      preset = meaning == value ? word : preset;
    }
    chooseFrom(name, names, preset, sentence, [&value, choices](std::size_t i) { value = choices[i].second; });
  }
  /*!
   * Any option. \param names : Its name; a former name may follow after a comma: "--robot,--arm". \param count : Number of values;
   * 0: one, and the option may be repeated; -1: any number.
   */
  void add(const std::string &names, const std::string &placeholder, const std::string &sentence,
           const std::string &preset, Reader read, int count = 1);

  /*!
   * Read the command line. Whether a file is there is no matter of the command line: its reader says so, and the status
   * is ExitData.
   * \return False when there is nothing left to do because `--help` or `--version` was asked for, and printed.
   * \throw UsageError naming the option and its value.
   */
  [[nodiscard]] bool parse(int argc, const char *const *argv);
  //! The options that were given, in the order of the help.
  [[nodiscard]] std::vector<std::string> given() const;
  //! True when the option was given.
  [[nodiscard]] bool isGiven(const std::string &name) const;

private:
  void chooseFrom(const std::string &name, const std::vector<std::string> &names, const std::string &preset,
                  const std::string &sentence, std::function<void(std::size_t)> choose);
  std::unique_ptr<CLI::App> m_app;
  std::string m_group;
};
} // namespace vpApp

#endif
