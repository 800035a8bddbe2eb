#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "parallel/world.hpp"

namespace recoil::parallel {

/// Writes values to bytes and reads them back in the same order. A type lists its members once, for both
/// directions: `template <class Archive> void transfer(Archive& a) { a(first, second); }`. Plain values,
/// texts, and std::vector, std::optional, std::pair and std::map of such things need no list.
template <class Archive, class T>
concept Listed = requires(T& value, Archive& archive) {
  value.transfer(archive);
};

class ArchiveWriter {
 public:
  explicit ArchiveWriter(Bytes& bytes) : bytes_(bytes) {}
  template <class... T>
  void operator()(const T&... values) {
    (write(values), ...);
  }

 private:
  template <class T>
  void write(const T& value) {
    if constexpr (Listed<ArchiveWriter, T>)
      const_cast<T&>(value).transfer(*this);  // which only reads it
    else
      pack(bytes_, plain(value));
  }
  void write(const std::string& text) { write_all(text); }
  void write(const std::vector<bool>& flags) { write(std::vector<char>(flags.begin(), flags.end())); }
  template <class T>
  void write(const std::vector<T>& list) {
    write_all(list);
  }
  template <class T>
  void write(const std::optional<T>& value) {
    write(value.has_value());
    if (value) write(*value);
  }
  template <class A, class B>
  void write(const std::pair<A, B>& both) {
    write(both.first);
    write(both.second);
  }
  template <class K, class V>
  void write(const std::map<K, V>& map) {
    write(static_cast<std::uint64_t>(map.size()));
    for (const auto& entry : map) write(entry);
  }
  template <class List>
  void write_all(const List& list) {
    write(static_cast<std::uint64_t>(list.size()));
    for (const auto& value : list) write(value);
  }
  template <class T>
  static const T& plain(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>, "a type with a list of its members, or a plain one");
    return value;
  }
  Bytes& bytes_;
};

class ArchiveReader {
 public:
  explicit ArchiveReader(Unpacker& from) : from_(from) {}
  template <class... T>
  void operator()(T&... values) {
    (read(values), ...);
  }

 private:
  template <class T>
  void read(T& value) {
    if constexpr (Listed<ArchiveReader, T>) {
      value.transfer(*this);
    } else {
      static_assert(std::is_trivially_copyable_v<T>, "a type with a list of its members, or a plain one");
      from_.read(&value, 1);
    }
  }
  void read(std::string& text) { read_all(text); }
  void read(std::vector<bool>& flags) {
    std::vector<char> values;
    read(values);
    flags.assign(values.begin(), values.end());
  }
  template <class T>
  void read(std::vector<T>& list) {
    read_all(list);
  }
  template <class T>
  void read(std::optional<T>& value) {
    bool there = false;
    read(there);
    value.reset();
    if (there) read(value.emplace());
  }
  template <class A, class B>
  void read(std::pair<A, B>& both) {
    read(both.first);
    read(both.second);
  }
  template <class K, class V>
  void read(std::map<K, V>& map) {
    map.clear();
    for (std::uint64_t n = size(); n > 0; --n) {
      std::pair<K, V> entry;
      read(entry);
      map.insert(std::move(entry));
    }
  }
  template <class List>
  void read_all(List& list) {
    list.clear();
    for (std::uint64_t n = size(); n > 0; --n) {
      typename List::value_type value{};
      read(value);
      list.push_back(std::move(value));
    }
  }
  std::uint64_t size() {
    std::uint64_t n = 0;
    from_.read(&n, 1);
    return n;
  }
  Unpacker& from_;
};

}  // namespace recoil::parallel
