/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file archive.h
 * \brief Values as bytes and back, between processes of the same program on machines of the same kind.
 *
 * A structure names its fields once, for both directions, in a function of its namespace:
 * \code
 * template <class Archive> void exchange(Archive &archive, Run &run) { archive(run.name, run.duration, run.peaks); }
 * \endcode
 */
#ifndef vpApp_archive_h
#define vpApp_archive_h

#include <cstddef>
#include <cstring>
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
} // namespace vpApp

#endif
