#include "config/document.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

#include "config/text_faults.hpp"
#include "config/unquoted.hpp"

namespace recoil::config {

const Node* Node::find(std::string_view name) const {
  for (const Node& child : children)
    if (kind == Kind::table && child.key == name) return &child;
  return nullptr;
}

Node* Node::find(std::string_view name) { return const_cast<Node*>(std::as_const(*this).find(name)); }

std::string describe(const Node& node) {
  switch (node.kind) {
    case Node::Kind::none:
      return "nothing";
    case Node::Kind::table:
      return "a table";
    case Node::Kind::array:
      return "a list";
    case Node::Kind::text:
      return "the text '" + node.text + "'";
    case Node::Kind::integer:
    case Node::Kind::real:
      return "the bare number " + node.text;
    case Node::Kind::flag:
      return node.text;
    case Node::Kind::other:
      return "a date or time";
  }
  return {};
}

std::vector<std::string> split_path(std::string_view dotted) {
  std::vector<std::string> parts(1);
  bool quoted = false;
  for (const char c : dotted) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == '.' && !quoted) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::string join_path(const std::string& parent, const std::string& key) {
  const std::string name = key.find('.') == std::string::npos ? key : '"' + key + '"';
  return parent.empty() ? name : parent + '.' + name;
}

const Node* Document::find(std::string_view dotted) const {
  const Node* node = &root;
  for (const std::string& part : split_path(dotted)) {
    node = node->find(part);
    if (!node) return nullptr;
  }
  return node;
}

std::vector<std::string> Document::names(std::string_view dotted) const {
  std::vector<std::string> out;
  if (const Node* node = dotted.empty() ? &root : find(dotted))
    for (const Node& child : node->children)
      if (child.is_table() && node->is_table()) out.push_back(child.key);
  return out;
}

namespace {

/// Turns the library's tree into ours.
struct Converter {
  const std::string& file;
  const QuoteRepairs& repairs;

  Place place(const toml::source_region& s) const {
    const int line = static_cast<int>(s.begin.line);
    const int first = repairs.original_column(line, static_cast<int>(s.begin.column));
    const int last = repairs.original_column(line, static_cast<int>(s.end.column));
    return {file, line, first, s.end.line == s.begin.line ? std::max(1, last - first) : 1};
  }

  void convert_table(const toml::table& table, Node& out) const {
    out.kind = Node::Kind::table;
    for (auto&& [key, value] : table) {
      Node child;
      child.key = std::string(key.str());
      child.path = join_path(out.path, child.key);
      child.key_place = place(key.source());
      convert(value, child);
      out.children.push_back(std::move(child));
    }
    std::stable_sort(out.children.begin(), out.children.end(), [](const Node& a, const Node& b) {
      return std::tie(a.key_place.line, a.key_place.column) < std::tie(b.key_place.line, b.key_place.column);
    });
  }

  void convert_array(const toml::array& array, Node& out) const {
    out.kind = Node::Kind::array;
    for (auto&& value : array) {
      Node child;
      child.path = fmt::format("{}[{}]", out.path, out.children.size());
      child.key_place = place(value.source());
      convert(value, child);
      out.children.push_back(std::move(child));
    }
  }

  void convert(const toml::node& in, Node& out) const {
    out.place = place(in.source());
    if (const auto* table = in.as_table()) {
      convert_table(*table, out);
    } else if (const auto* array = in.as_array()) {
      convert_array(*array, out);
    } else if (const auto* text = in.as_string()) {
      out.kind = Node::Kind::text;
      out.text = text->get();
    } else if (const auto* integer = in.as_integer()) {
      out.kind = Node::Kind::integer;
      out.integer = integer->get();
      out.number = static_cast<double>(out.integer);
      out.text = fmt::format("{}", out.integer);
    } else if (const auto* real = in.as_floating_point()) {
      out.kind = Node::Kind::real;
      out.number = real->get();
      out.text = fmt::format("{}", out.number);
    } else if (const auto* flag = in.as_boolean()) {
      out.kind = Node::Kind::flag;
      out.flag = flag->get();
      out.text = out.flag ? "true" : "false";
    } else {
      out.kind = Node::Kind::other;
    }
  }
};

std::string syntax_message(std::string_view description) {
  constexpr std::string_view start = "Error while parsing ";
  if (description.starts_with(start)) description.remove_prefix(start.size());
  return "this is no TOML: " + std::string(description);
}

std::string_view without_blanks(std::string_view s) {
  const std::size_t first = s.find_first_not_of(" \t"), last = s.find_last_not_of(" \t");
  return first == std::string_view::npos ? std::string_view() : s.substr(first, last - first + 1);
}

/// What stands between the brackets of a table's header [a.b]; empty: the line is none.
std::string_view header_of(std::string_view line) {
  line = without_blanks(line);
  if (!line.starts_with('[')) return {};
  line = line.substr(0, line.find(']'));
  return without_blanks(line.substr(std::min(line.find_first_not_of('['), line.size())));
}

/// The line in which a key or table that the parser met again in `line` was given first; 0: not found.
int first_line_of(std::string_view text, std::string_view key, int line) {
  const std::string_view repeated = header_of(line_of(text, line));
  std::string header;
  for (int n = line - 1; n > 0 && repeated.empty() && header.empty(); --n)
    header = header_of(line_of(text, n));
  std::size_t end = 0;
  for (int n = 1; n < line; ++n) end = text.find('\n', end) + 1;
  Diagnostics ignored;
  const Document before = parse_document(std::string(text.substr(0, end)), "", ignored);
  const Node* table = header.empty() ? &before.root : before.find(header);
  const Node* first = !repeated.empty() ? before.find(repeated) : table ? table->find(key) : nullptr;
  if (first) return first->key_place.line;
  const bool same_line = line_of(text, line).find(key) != line_of(text, line).rfind(key);
  return same_line ? line : 0;
}

/// The last word in quotes of the parser's "cannot redefine existing string 'end'".
std::string_view repeated_key(std::string_view description) {
  const std::size_t last = description.rfind('\'');
  if (last == std::string_view::npos || last == 0) return {};
  const std::size_t first = description.rfind('\'', last - 1);
  return first == std::string_view::npos ? std::string_view()
                                         : description.substr(first + 1, last - first - 1);
}

void report_repeated(std::string_view text, std::string_view description, const Place& place,
                     Diagnostics& out) {
  const std::string_view key = repeated_key(description);
  const int first = first_line_of(text, key, place.line);
  out.error(place, fmt::format("'{}' is given twice", key),
            first == 0            ? "take out one of the two"
            : first == place.line ? "the first stands before it in the same line; take out one of the two"
                                  : fmt::format("the first stands in line {}: {}; take out one of the two",
                                                first, without_blanks(line_of(text, first))));
}

/// Reports what keeps a text from being parsed at all. @return whether there was something.
bool report_faults(const std::string& text, const std::string& name, Diagnostics& out) {
  if (without_blanks(line_of(text, 1)).empty() && text.find_first_not_of(" \t\r\n") == std::string::npos) {
    out.error({name, 0, 0, 1}, "the file is empty",
              "`recoil explain` lists what a case holds; cases/ has examples to start from");
    return true;
  }
  std::optional<TextFault> fault = find_foreign_byte(text);
  if (!fault) fault = find_open_quote(text);
  if (fault) out.error({name, fault->line, fault->column, 1}, fault->message, fault->help);
  return fault.has_value();
}

}  // namespace

Document parse_document(std::string text, std::string name, Diagnostics& out) {
  Document doc;
  doc.name = std::move(name);
  doc.text = std::move(text);
  doc.root.kind = Node::Kind::table;
  doc.root.place = doc.root.key_place = Place{doc.name, 0, 0, 1};
  out.source(doc.name, shown(doc.text));
  if (report_faults(doc.text, doc.name, out)) {
    doc.complete = false;
    return doc;
  }
  QuoteRepairs repairs;
  std::string current = doc.text;
  // Repairs only go forward, so this ends: where one did not help the parser stops before it again.
  int repaired_line = 0, repaired_column = 0;
  for (;;) {
    try {
      const toml::table table = toml::parse(std::string_view(current), std::string_view(doc.name));
      Converter{doc.name, repairs}.convert_table(table, doc.root);
      return doc;
    } catch (const toml::parse_error& e) {
      const int line = static_cast<int>(e.source().begin.line),
                column = static_cast<int>(e.source().begin.column);
      const std::optional<Unquoted> word = repairs.repair(current, line, column);
      if (word && std::tie(line, word->column) > std::tie(repaired_line, repaired_column)) {
        repaired_line = line, repaired_column = word->column;
        out.error({doc.name, line, word->column, word->length},
                  "'" + word->text + "' needs quotes: " + word->why, "write \"" + word->text + "\"");
        continue;
      }
      const Place place{doc.name, line, repairs.original_column(line, column), 1};
      if (e.description().find("cannot redefine existing ") != std::string_view::npos)
        report_repeated(doc.text, e.description(), place, out);
      else
        out.error(
            place, syntax_message(e.description()),
            "a line is [table] or key = value; texts stand in quotes, what is opened is closed in its line");
      doc.complete = false;
      return doc;
    }
  }
}

Document read_document(const std::string& path, Diagnostics& out) {
  std::ifstream file(path, std::ios::binary);
  const bool readable = file && !std::filesystem::is_directory(path);
  std::string content;
  if (readable) content.assign(std::istreambuf_iterator<char>(file), {});
  if (!readable || file.bad()) {
    Document doc;
    doc.name = path;
    doc.root.kind = Node::Kind::table;
    doc.complete = false;
    const bool is_folder = std::filesystem::is_directory(path);
    out.error(
        {path, 0, 0, 1}, "cannot read '" + path + "'" + (is_folder ? ": it is a folder" : ""),
        is_folder ? "rename it, or put a file in its place" : "give the path of a file, e.g. case.toml");
    return doc;
  }
  return parse_document(std::move(content), path, out);
}

namespace {

void set_places(Node& node, const Place& place) {
  node.place = node.key_place = place;
  for (Node& child : node.children) set_places(child, place);
}

void set_paths(Node& node, const std::string& path) {
  node.path = path;
  for (std::size_t i = 0; i < node.children.size(); ++i) {
    Node& child = node.children[i];
    set_paths(child, node.is_array() ? fmt::format("{}[{}]", path, i) : join_path(path, child.key));
  }
}

}  // namespace

Node parse_value(const std::string& text, const Place& place) {
  Node node;
  Diagnostics ignored;
  const bool one_line = text.find('\n') == std::string::npos;
  Document doc;
  doc.complete = false;
  if (one_line) doc = parse_document("value = " + text, "", ignored);
  if (doc.complete && !ignored.has_errors() && doc.root.children.size() == 1) {
    node = doc.root.children.front();
  } else {
    node.kind = Node::Kind::text;
    node.text = text;
  }
  node.key.clear();
  set_places(node, place);
  return node;
}

bool put(Node& root, const std::vector<std::string>& path, Node value) {
  Node* at = &root;
  for (const std::string& part : path) {
    if (at->kind != Node::Kind::table) return false;
    Node* next = at->find(part);
    if (!next) {
      Node made;
      made.kind = Node::Kind::table;
      made.key = part;
      made.path = join_path(at->path, part);
      made.place = made.key_place = value.place;
      next = &at->children.emplace_back(std::move(made));
    }
    at = next;
  }
  value.key = at->key;
  set_paths(value, at->path);
  *at = std::move(value);
  return true;
}

Node merged(const Node& base, const Node& over) {
  if (!base.is_table() || !over.is_table()) return over;
  Node out = over;
  for (const Node& child : base.children) {
    if (Node* mine = out.find(child.key)) {
      *mine = merged(child, *mine);
    } else {
      out.children.push_back(child);
    }
  }
  return out;
}

}  // namespace recoil::config
