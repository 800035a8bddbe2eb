#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/diagnostics.hpp"
#include "config/document.hpp"
#include "config/geometry.hpp"
#include "config/table.hpp"

namespace recoil::config {

/// What the readers of a case share.
struct CaseReading {
  Geometry geometry;
  std::vector<std::string> axes;  // names of the coordinates, in the order of vectors
  Diagnostics& out;
  bool knows_domain = true;                    // else bodies would only give errors that follow from that one
  bool knows_bodies = true;                    // else neither would what speaks of them
  Vector lo{}, hi{};                           // m, of the domain
  std::vector<std::string> bodies = {};        // their names
  std::vector<std::string> rigid_bodies = {};  // those of them that are
  std::filesystem::path folder = {};  // of the case file: files that it names lie in it or are seen from it
  std::vector<std::filesystem::path>* files = nullptr;  // where those are collected; null: nowhere
};

/// A table that has been read, for checks of several keys together.
struct TableReading {
  const Node& node;
  const Record& record;
  const CaseReading& in;
  std::span<const Key> keys;
  Owner owner;

  bool has(std::string_view key) const { return record.has(key); }
  bool good(std::string_view key) const { return record.good(key); }
  /// An error at the value of a key.
  void wrong(std::string_view key, std::string message, std::string help = {}) const {
    in.out.error(record.place(key), std::move(message), std::move(help));
  }
  /// An error at the name of a key.
  void refuse(std::string_view key, std::string message, std::string help = {}) const {
    in.out.error(record.key_place(key), std::move(message), std::move(help));
  }
  /// A key that another one makes necessary.
  void missing(std::string_view key) const;
};

/// The place of a file that the case names, which exists; a missing one is reported, and gives an empty path.
/// In the folder of a run it is the copy that the run made, whatever the folder of the original.
std::filesystem::path input_file(const TableReading& reading, std::string_view key);

/// Checks that there is such a body. @return false, after an error, where there is none.
bool check_body(const std::string& name, const Place& place, const CaseReading& in);

/// All ways to read "a-b" as two of the names; names may hold '-' themselves, so there may be several.
std::vector<std::array<std::string, 2>> pairs_named(std::string_view pair,
                                                    const std::vector<std::string>& names);

/// The two bodies of a pair "a-b"; unknown and ambiguous ones are reported, and come back empty.
std::array<std::string, 2> read_pair(const std::string& pair, const Place& place,
                                     const std::vector<std::string>& names, Diagnostics& out);

/// Names become names of files and columns. @param what "body", "gauge". @return false after an error.
bool check_name(const Node& node, const char* what, Diagnostics& out);

/// The table of tables must hold tables only.
bool check_is_table(const Node& node, const char* what, Diagnostics& out);

}  // namespace recoil::config
