#pragma once

#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "config/geometry.hpp"
#include "config/keys.hpp"

/// The declaration of a case's keys, beside the structs that they fill:
///
///     struct MeshChoice {
///       double finest = 0;  // m
///       static constexpr const char* doc = "The cells.";
///       static std::vector<Entry<MeshChoice>> keys() {
///         return {{.name = "finest", .member = &MeshChoice::finest, .unit = "m", ...}};
///       }
///     };
///
/// Reading (read_struct.hpp), checks, defaults, `explain`, the schema, the reference page and the resolved
/// case (write_struct.hpp) follow from it. What a default-constructed struct holds is the default. A struct
/// may have a function `check(const TableReading&)` for conditions on several keys; it is called last.
namespace recoil::config {

struct Node;
struct CaseReading;
struct TableReading;
struct Writing;
struct WrittenTable;

/// Extents along the coordinates, a key of type range each: the key is the coordinate's name.
template <class T>
struct Extents {
  Vector T::*lo;
  Vector T::*hi;
};

/// An enumeration, by the places of its values in `choices`.
template <class T>
struct Choice {
  int (*get)(const T&);
  void (*set)(T&, int);
};

template <class>
struct MemberOf;
template <class V, class T>
struct MemberOf<V T::*> {
  using Struct = T;
  using Value = V;
};

/// The member of an entry that is an enumeration: choice_of<&Domain::geometry>().
template <auto M>
constexpr auto choice_of() {
  using T = typename MemberOf<decltype(M)>::Struct;
  using V = typename MemberOf<decltype(M)>::Value;
  return Choice<T>{[](const T& t) { return static_cast<int>(t.*M); },
                   [](T& t, int n) { t.*M = static_cast<V>(n); }};
}

/// A value that has a reader of its own. `type` is what help and the schema call it; where `typed`, the value
/// has been checked to be that before `read` is called.
template <class T>
struct Custom {
  Key::Type type;
  bool typed;
  void (*read)(T&, const TableReading&, const Key&);
  std::string (*write)(const T&, const char* name, const Writing&);
  void (*sections)(const std::string& path, std::vector<Section>&) = nullptr;  // tables that it can be
};

/// A table that is a section of its own, or a table of them.
template <class T>
struct Part {
  void (*read)(T&, const Node&, CaseReading&);
  void (*sections)(const std::string& path, std::vector<Section>&);
  void (*write)(const T&, const std::string& path, const Writing&, std::vector<WrittenTable>&);
};

/// What an entry fills; the type of the key follows from it.
template <class T>
using Member =
    std::variant<double T::*, std::optional<double> T::*, int T::*, bool T::*, std::string T::*,
                 std::vector<std::string> T::*, std::array<std::string, 2> T::*, std::array<double, 2> T::*,
                 Vector T::*, Extents<T>, Choice<T>, Custom<T>, Part<T>>;

/// What a value must satisfy besides its type.
enum class Rule {
  none,
  body,           // a text: the name of a body
  inside_domain,  // a position
  direction,      // a vector: not zero; is brought to length 1
  turn,           // a vector: about the axis out of the plane, given as a quantity in planar geometry
};

template <class T>
struct Entry {
  const char* name;
  Member<T> member;
  const char* unit = "1";  // SI
  double least = -Key::infinity, most = Key::infinity;
  bool positive = false;  // zero is refused as well
  bool required = false;
  bool optional = false;  // may be left out, and what the struct starts with then says so: it is no default
  Rule rule = Rule::none;
  const char* doc = "";
  const char* example = "";
  std::vector<std::string> choices = {};
  std::vector<Geometry> only_in = {};                           // empty: in every geometry
  std::array<const char*, geometry_names.size()> unit_in = {};  // SI, by geometry, where it differs
  bool (*when)(const T&) = nullptr;                             // where it does not apply, it is not written
};

template <class T>
using Entries = std::vector<Entry<T>>;

/// Another name of a kind of table (kinds.hpp).
struct Alias {
  const char* kind;
  const char* doc;
  std::vector<Geometry> only_in;
};

}  // namespace recoil::config
