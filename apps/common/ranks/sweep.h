/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file sweep.h
 * \brief Many independent cases on the cores of all ranks. The results do not depend on the number of ranks or threads.
 *
 * Results pass between processes of the same program on machines of the same kind as bytes. A structure names its
 * fields once, for both directions, in a function of its namespace:
 * \code
 * template <class Archive> void exchange(Archive &archive, Run &run) { archive(run.name, run.duration, run.peaks); }
 * \endcode
 */
#ifndef vpApp_sweep_h
#define vpApp_sweep_h

#include "appMain.h"
#include "jobs.h"
#include "progress.h"
#include "ranks.h"

#include <cstddef>
#include <cstring>
#include <functional>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace vpApp
{
//! \brief What Writer and Reader have in common: numbers, texts, lists, pairs, options, structures with exchange().
template <class Derived> class Archive
{
public:
  template <class... Values> void operator()(Values &...values) { (one(values), ...); }

private:
  template <class T> void one(T &value)
  {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      self().bytes(reinterpret_cast<char *>(&value), sizeof value);
    }
    else {
      exchange(self(), value);
    }
  }
  void one(std::string &text)
  {
    std::size_t size = text.size();
    one(size);
    self().resize(text, size);
    self().bytes(text.data(), size);
  }
  template <class T> void one(std::vector<T> &list)
  {
    std::size_t size = list.size();
    one(size);
    self().resize(list, size);
    for (T &value : list) {
      one(value);
    }
  }
  template <class A, class B> void one(std::pair<A, B> &pair)
  {
    one(pair.first);
    one(pair.second);
  }
  template <class T> void one(std::optional<T> &option)
  {
    bool has = option.has_value();
    one(has);
    if (has && !option) {
      option.emplace();
    }
    if (has) {
      one(*option);
    }
  }
  Derived &self() { return static_cast<Derived &>(*this); }
};

//! \brief Values to bytes.
class Writer : public Archive<Writer>
{
public:
  [[nodiscard]] const std::string &text() const { return m_text; } //!< The bytes so far.
  void bytes(const char *data, std::size_t size) { m_text.append(data, size); }
  template <class List> void resize(List &, std::size_t) {}

private:
  std::string m_text;
};

//! \brief Bytes to values, in the order in which they were written. \throw std::runtime_error when the bytes end early.
class Reader : public Archive<Reader>
{
public:
  explicit Reader(std::string text) : m_text(std::move(text)) {}
  void bytes(char *data, std::size_t size)
  {
    if (size > m_text.size() - m_at) {
      throw std::runtime_error("the results of another process are cut short");
    }
    std::memcpy(data, m_text.data() + m_at, size);
    m_at += size;
  }
  template <class List> void resize(List &list, std::size_t size)
  {
    if (size > m_text.size() - m_at) { // every element takes at least a byte
      throw std::runtime_error("the results of another process are cut short");
    }
    list.resize(size);
  }

private:
  std::string m_text;
  std::size_t m_at = 0;
};

//! \brief Cases 0 .. count - 1. The functions must give the same on every rank.
struct Sweep {
  std::string title;                         //!< For the progress bar: "running 42 motions".
  std::size_t count = 0;                     //!< Number of cases.
  std::function<double(std::size_t)> effort; //!< Expected effort of a case in any unit, > 0; null: all the same.
  //! Cases that rank 0 must run itself, because more is kept of them than their result; null: none.
  std::function<bool(std::size_t)> onFirst;
};

//! Indices of the cases of each rank: the longest first, each to the rank with the least effort so far.
[[nodiscard]] std::vector<std::vector<std::size_t>> shareOut(const Sweep &sweep, int ranks);

/*!
 * Run every case once.
 * \param jobs : Threads of each rank; 0: its share of the cores.
 * \param work : `Result work(std::size_t index, const std::function<void(double)> &done)`, safe to call at the same time
 * for different cases; may report the fraction done, 0..1.
 * \return On rank 0 the results of all cases, elsewhere those of its own share; results pass between ranks by
 * exchange(), see above.
 * \throw Interrupted after Ctrl-C; whatever \e work throws.
 */
template <class Result, class Work>
std::vector<Result> runSweep(const Ranks &ranks, const Sweep &sweep, unsigned int jobs, const Work &work)
{
  const auto effort = [&sweep](std::size_t index) { return sweep.effort ? sweep.effort(index) : 1.; };
  const auto shares = shareOut(sweep, ranks.size());
  const std::vector<std::size_t> &mine = shares[static_cast<std::size_t>(ranks.rank())];
  double total = 0.;
  for (const std::size_t index : mine) {
    total += effort(index);
  }
  Progress progress(sweep.title, total > 0. ? total : 1., std::cerr,
                    ranks.isFirst() ? Progress::detect() : Progress::Style::Silent);
  std::vector<Result> results(sweep.count);
  runJobs(mine.size(), ranks.threads(jobs), [&](std::size_t k) {
    throwIfInterrupted();
    const std::size_t index = mine[k];
    double shown = 0.;
    const std::function<void(double)> done = [&](double share) {
      share = share > 1. ? 1. : share;
      if (share > shown) {
        progress.add((share - shown) * effort(index));
        shown = share;
      }
    };
    results[index] = work(index, done);
    done(1.);
  });
  throwIfInterrupted();
  Writer writer;
  for (std::size_t k = 0; k < mine.size() && !ranks.isFirst(); ++k) {
    writer(results[mine[k]]);
  }
  const std::vector<std::string> texts = ranks.gather(writer.text());
  for (std::size_t rank = 1; rank < texts.size(); ++rank) {
    Reader reader(texts[rank]);
    for (const std::size_t index : shares[rank]) {
      reader(results[index]);
    }
  }
  return results;
}
} // namespace vpApp

#endif
