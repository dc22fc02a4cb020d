/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The command line of the programs: values, defaults in the help, and a sentence for every mistake.
#include "vpCatch.h"

#include "testFolder.h"

#include "appMain.h"
#include "commandLine.h"

#include <iostream>
#include <sstream>

TEST_CASE("a command line tells help from mistakes", "[apps]")
{
  enum class Colour { Red, Blue };
  struct Read {
    bool flag = false;
    std::string file;
    std::vector<std::string> names{"a", "b"};
    double rate = 25.;
    unsigned int count = 3;
    Colour colour = Colour::Blue;
    std::vector<double> pair;
    std::vector<std::string> given;
    bool run = false;
  };
  const auto parse = [](std::vector<const char *> arguments) {
    Read read;
    vpApp::CommandLine line("prog", "About.", "Examples.");
    line.text("FILE", read.file, " ", "An input");
    line.group("Values");
    line.flag("--flag", read.flag, "A flag");
    line.list("--names", read.names, "NAME,...", "Some names");
    line.number("--rate", read.rate, {0., 240., true}, "HZ", "A rate");
    line.whole("--count", read.count, {1, 256}, "N", "A count (default: that of the file)");
    line.choice("--colour", read.colour, {{"red", Colour::Red}, {"blue", Colour::Blue}}, "A colour");
    line.add(
        "--pair", "X Y", "A pair", "",
        [&read](const auto &values) {
          read.pair = {vpApp::numberIn("--pair", values[0], {}), vpApp::numberIn("--pair", values[1], {})};
        },
        2);
    arguments.insert(arguments.begin(), "prog");
    read.run = line.parse(static_cast<int>(arguments.size()), arguments.data());
    read.given = line.given();
    return read;
  };
  const Read all = parse({"in.txt", "--flag", "--names", "x,y", "--names", "z", "--rate", "1e2", "--count", "256",
                          "--colour", "red", "--pair", "-1", "2.5"});
  CHECK(all.run);
  CHECK(all.flag);
  CHECK(all.file == "in.txt");
  CHECK(all.names == std::vector<std::string>{"x", "y", "z"});
  CHECK(all.rate == 100.);
  CHECK(all.count == 256);
  CHECK(all.colour == Colour::Red);
  CHECK(all.pair == std::vector<double>{-1., 2.5});
  CHECK(parse({"--rate", "5", "--colour=blue"}).given == std::vector<std::string>{"--rate", "--colour"});
  CHECK(parse({}).names.size() == 2);
  {
    std::ostringstream printed;
    std::streambuf *before = std::cout.rdbuf(printed.rdbuf());
    const bool run = parse({"--help"}).run;
    std::cout.rdbuf(before);
    CHECK_FALSE(run);
    for (const char *part :
         {"About.", "Examples.", "Values", "Some names (default: a,b)", "A rate (default: 25)",
          "A count (default: that of the file)\n", "A colour: red or blue (default: blue)", "A pair\n", "--version"}) {
      CAPTURE(part, printed.str());
      CHECK(printed.str().find(part) != std::string::npos);
    }
  }
  const std::vector<std::pair<std::vector<const char *>, std::string>> mistakes = {
      {{"--rate", "0"}, "--rate is 0, must be a number > 0 and <= 240"},
      {{"--rate", "nan"}, "--rate is nan, must be a number > 0 and <= 240"},
      {{"--rate", "1e999"}, "--rate is 1e999, must be a number > 0 and <= 240"},
      {{"--rate", " 5"}, "--rate is  5, must be a number > 0 and <= 240"},
      {{"--rate", "5x"}, "--rate is 5x, must be a number > 0 and <= 240"},
      {{"--rate", ""}, "--rate is given without a value"},
      {{"--rate"}, "--rate is given without a value"},
      {{"--rate", "--flag"}, "--rate is given without a value"},
      {{"--names", "--rate", "5"}, "--names is given without a value"},
      {{"--rate", "1", "--rate", "2"}, "--rate is given more than once"},
      {{"--count", "257"}, "--count is 257, must be a whole number from 1 to 256"},
      {{"--count", "2.5"}, "--count is 2.5, must be a whole number from 1 to 256"},
      {{"--count", "99999999999999999999"}, "--count is 99999999999999999999, must be a whole number from 1 to 256"},
      {{"--colour", "green"}, "--colour is green, must be red or blue"},
      {{"--names", "a,,b"}, "--names is a,,b, which has an empty name"},
      {{"--pair", "1"}, "--pair is given without its 2 values"},
      {{"--pair", "1", "x"}, "--pair is x, must be a number"},
      {{"--nonsense"}, "there is no option --nonsense"},
      {{"--nonsense=5"}, "there is no option --nonsense"},
      {{"--colur", "red"}, "there is no option --colur, did you mean --colour?"},
      {{"--rte=5"}, "there is no option --rte, did you mean --rate?"}};
  for (const auto &[arguments, sentence] : mistakes) {
    CHECK(complaint([&arguments = arguments, &parse] { (void)parse(arguments); }) == sentence);
  }
  CHECK_THROWS_AS(parse({"--nonsense"}), vpApp::UsageError);
}

TEST_CASE("the help is 80 columns wide, and its commands can be copied", "[apps]")
{
  std::string longWords, file;
  for (int i = 0; i < 40; ++i) {
    longWords += "word" + std::to_string(i) + " ";
  }
  const std::string command = "prog --file " + std::string(30, 'a') + " --file " + std::string(30, 'b') + " --other c";
  vpApp::CommandLine line("prog", longWords + "\n\nSecond paragraph.",
                          "Examples:\n  " + command + "\n      " + longWords + "\n  prog\n      short");
  line.text("--file", file, "FILE", longWords);
  std::ostringstream printed;
  std::streambuf *before = std::cout.rdbuf(printed.rdbuf());
  const char *arguments[] = {"prog", "--help"};
  CHECK_FALSE(line.parse(2, arguments));
  std::cout.rdbuf(before);
  std::istringstream help(printed.str());
  std::string words, copied;
  bool goesOn = false;
  for (std::string text; std::getline(help, text);) {
    CAPTURE(text);
    CHECK(text.size() <= 80);
    std::istringstream pieces(text);
    for (std::string word; pieces >> word;) {
      words += word + " ";
    }
    if (goesOn || text.rfind("  prog --file", 0) == 0) {
      goesOn = !text.empty() && text.back() == '\\';
      copied += text.substr(text.find_first_not_of(' '), text.size() - text.find_first_not_of(' ') - (goesOn ? 1 : 0));
    }
  }
  CHECK(copied == command);
  for (const std::string &part :
       {longWords + "Second paragraph. Usage:", longWords + "prog short", "--file FILE " + longWords}) {
    CAPTURE(part, words);
    CHECK(words.find(part) != std::string::npos); // nothing is lost, in order
  }
}

TEST_CASE("lists of numbers, and former names of options", "[apps]")
{
  CHECK(vpApp::numbersIn("--q", "1,-2.5,3e-1") == std::vector<double>{1., -2.5, 0.3});
  CHECK(vpApp::numbersIn("--q", "7") == std::vector<double>{7.});
  for (const std::string text : {"", "1,", ",1", "1,,2", "1 2", "1,x", "nan", "1,inf"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(vpApp::numbersIn("--q", text), vpApp::UsageError);
  }
  CHECK(complaint([] {
          static_cast<void>(vpApp::numbersIn("--q", "1,-2", {0., 9., true}));
        }) == "--q is -2, must be a number > 0 and <= 9");
  for (const char *name : {"--robot", "--arm"}) {
    std::string value;
    vpApp::CommandLine line("prog", "About.", "Examples.");
    line.text("--robot,--arm", value, "FILE", "A robot");
    const char *arguments[] = {"prog", name, "x.urdf"};
    CHECK(line.parse(3, arguments));
    CHECK(value == "x.urdf");
    CHECK(line.given() == std::vector<std::string>{"--robot"});
    CHECK(line.isGiven("--robot"));
    vpApp::CommandLine empty("prog", "About.", "Examples.");
    empty.text("--robot,--arm", value, "FILE", "A robot");
    const char *nothing[] = {"prog", name, ""};
    CHECK(complaint([&] { static_cast<void>(empty.parse(3, nothing)); }) == "--robot is given without a value");
  }
}
