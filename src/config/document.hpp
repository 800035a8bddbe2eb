#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "config/diagnostics.hpp"

namespace recoil::config {

/// One value of a TOML text, or a table or array of them. A plain tree of our own, so that the TOML library
/// stays inside document.cpp.
struct Node {
  enum class Kind { none, table, array, text, integer, real, flag, other };
  Kind kind = Kind::none;
  std::string key;             // own name in its table; empty: the whole document or an element of an array
  std::string path;            // from the top, dotted: "body.flyer.velocity.x", "body.ring.shape.parts[0]"
  Place key_place;             // of the key (or of the table's header)
  Place place;                 // of the value
  std::string text;            // kind text: the content. Other single values: as written
  double number = 0;           // integer and real
  std::int64_t integer = 0;    // integer
  bool flag = false;           // flag
  std::vector<Node> children;  // table: in file order; array: in order

  bool is_table() const { return kind == Kind::table; }
  bool is_array() const { return kind == Kind::array; }
  bool is_text() const { return kind == Kind::text; }
  bool is_number() const { return kind == Kind::integer || kind == Kind::real; }
  bool is_flag() const { return kind == Kind::flag; }

  /// The child with this name, or null. Only its own children: no dotted paths.
  const Node* find(std::string_view name) const;
  Node* find(std::string_view name);
};

/// What a node is, for messages: "a table", "a text", "the number 3", ...
std::string describe(const Node& node);

/// A parsed text with the places of all its keys and values.
struct Document {
  std::string name;  // path of the file, as shown in messages
  std::string text;
  Node root;             // kind table
  bool complete = true;  // false: a mistake of syntax (or a missing file) cut the reading short

  /// The node at a dotted path ("body.flyer"), or null.
  const Node* find(std::string_view dotted) const;
  /// Names of the tables directly below a dotted path, in file order: names("body").
  std::vector<std::string> names(std::string_view dotted) const;
};

/// Parses a text. Mistakes of syntax go to `out`; what was understood is returned. Unquoted quantities
/// (5 km/s) are reported and then read as if they had quotes, so that the mistakes after them are found as
/// well.
Document parse_document(std::string text, std::string name, Diagnostics& out);

/// Reads and parses a file; a file that cannot be read is an error in `out`.
Document read_document(const std::string& path, Diagnostics& out);

/// Parses one TOML value, e.g. `0.1` or `{ x = "1 m/s" }`; what is no TOML value is taken as bare text.
/// All places become `place`.
Node parse_value(const std::string& text, const Place& place);

/// The parts of a dotted path; parts in double quotes may hold dots: expect."contact.a-b.opens".value.
std::vector<std::string> split_path(std::string_view dotted);
/// The opposite of split_path.
std::string join_path(const std::string& parent, const std::string& key);

/// Puts `value` at a path below `root`, replacing what is there and making the tables on the way.
/// @return false where the way leads through something that is not a table.
bool put(Node& root, const std::vector<std::string>& path, Node value);

/// `over` laid over `base`: tables are merged key by key, anything else is replaced. Places stay with their
/// values, the table's own places and path are those of `over`.
Node merged(const Node& base, const Node& over);

}  // namespace recoil::config
