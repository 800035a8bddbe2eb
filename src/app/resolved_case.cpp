#include "app/resolved_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "config/read_shape.hpp"
#include "config/units.hpp"
#include "core/build_info.hpp"
#include "format/csv.hpp"
#include "material/library.hpp"

namespace recoil::app {

namespace {

using config::Body;
using config::Case;
using config::Gauge;
using config::Shape;
using config::Vector;

/// A text of TOML, with quotes.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string quantity(double value, const char* unit) {
  return fmt::format("\"{} {}\"", format_number(value), unit);
}

std::string range(double lo, double hi) {
  return fmt::format("[{}, {}]", quantity(lo, "m"), quantity(hi, "m"));
}

std::string list(const std::vector<std::string>& texts) {
  std::vector<std::string> parts;
  for (const std::string& t : texts) parts.push_back(quoted(t));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

class Writer {
 public:
  explicit Writer(const LoadedCase& loaded)
      : document_(loaded.document), c_(loaded.contents), axes_(config::axes_of(c_.domain.geometry)) {}

  std::string text(const std::vector<Material>& materials) {
    out_ = fmt::format("# {} as recoil {} computed it: all values, in SI.\n", c_.file, build_info::version);
    line("format", fmt::format("{}", c_.format));
    line("title", quoted(c_.title));
    line("cite", list(c_.cite));
    settings();
    for (const Body& body : c_.bodies) add(body);
    for (const Gauge& gauge : c_.gauges) add(gauge);
    if (!c_.expect.empty()) out_ += "\n[expect]\n";
    for (const config::Expectation& e : c_.expect) add(e);
    std::set<std::string> seen;
    for (std::size_t m = 0; m < materials.size(); ++m)
      if (!c_.bodies[m].rigid && seen.insert(c_.bodies[m].material).second)
        out_ += "\n" + to_toml(materials[m], "material." + quoted(c_.bodies[m].material));
    return out_;
  }

 private:
  /// Where a value comes from.
  std::string source(const std::string& path) const {
    const config::Node* node = document_.find(path);
    if (!node) return "default";
    return node->place.file == document_.name ? fmt::format("line {}", node->place.line) : node->place.file;
  }

  void section(const std::string& name) {
    section_ = name;
    out_ += fmt::format("\n[{}]\n", name);
  }
  void line(const std::string& key, const std::string& value) {
    const std::string path = section_.empty() ? key : section_ + '.' + key;
    out_ += fmt::format("{} = {}  # {}\n", key, value, source(path));
  }

  std::string vector(const Vector& v, const char* unit) const {
    std::vector<std::string> parts;
    for (std::size_t d = 0; d < axes_.size(); ++d)
      parts.push_back(axes_[d] + " = " +
                      (std::string(unit) == "1" ? format_number(v[d]) : quantity(v[d], unit)));
    return fmt::format("{{ {} }}", fmt::join(parts, ", "));
  }

  void settings() {
    using enum config::Boundary;
    section("domain");
    line("geometry", quoted(config::name_of(c_.domain.geometry)));
    for (std::size_t d = 0; d < axes_.size(); ++d) line(axes_[d], range(c_.domain.lo[d], c_.domain.hi[d]));
    section("domain.boundary");
    const auto name = [](config::Boundary b) {
      return b == symmetry ? "symmetry" : b == periodic ? "periodic" : b == axis ? "axis" : "outflow";
    };
    for (std::size_t d = 0; d < axes_.size(); ++d)
      line(axes_[d], list({name(c_.domain.boundary[d][0]), name(c_.domain.boundary[d][1])}));
    section("mesh");
    line("finest", quantity(c_.mesh.finest, "m"));
    line("offset", format_number(c_.mesh.offset));
    line("block", fmt::format("{}", c_.mesh.block));
    section("time");
    line("end", quantity(c_.time.end, "s"));
    if (c_.time.fixed_dt)
      line("fixed-dt", quantity(*c_.time.fixed_dt, "s"));
    else
      line("cfl", format_number(c_.time.cfl));
    section("method");
    line("scheme", quoted(c_.method.scheme));
    if (c_.method.scheme == "seed") line("kappa", format_number(c_.method.kappa));
    section("contact");
    choice("default", c_.contact.usual);
    for (const config::Contact::Pair& p : c_.contact.pairs) {
      section("contact.pairs." + p.bodies[0] + '-' + p.bodies[1]);
      choice("mode", p.choice);
    }
    section("output.fields");
    line("every", quantity(c_.output.fields_every, "s"));
    line("variables", list(c_.output.variables));
    section("output.history");
    line("every", quantity(c_.output.history_every, "s"));
  }

  void choice(const char* key, const config::ContactChoice& c) {
    using enum config::ContactChoice::Mode;
    line(key, quoted(c.mode == bonded ? "bonded" : c.mode == friction ? "friction" : "separable"));
    if (c.mode == friction) line("friction", format_number(c.friction));
  }

  std::string box(const Shape& s) const {
    std::string t = "kind = \"box\"";
    for (std::size_t d = 0; d < axes_.size(); ++d)
      t += fmt::format(", {} = {}", axes_[d], range(s.lo[d], s.hi[d]));
    if (s.rotation != 0)
      t += fmt::format(", rotation = {}, centre = {}", quantity(s.rotation, "rad"), vector(s.centre, "m"));
    return t;
  }

  std::string cylinder(const Shape& s) const {
    const std::string t = "kind = \"cylinder\", radius = " + quantity(s.radius, "m");
    if (c_.domain.geometry == config::Geometry::axisymmetric)
      return t + ", z = " + range(s.length_lo, s.length_hi);
    if (c_.domain.geometry == config::Geometry::planar) return t + ", centre = " + vector(s.centre, "m");
    return t + fmt::format(", centre = {}, axis = {}, along = {}", vector(s.centre, "m"), vector(s.axis, "1"),
                           range(s.length_lo, s.length_hi));
  }

  std::string polygon(const Shape& s) const {
    std::vector<std::string> corners;
    for (const auto& v : s.vertices)
      corners.push_back(fmt::format("[{}, {}]", quantity(v[0], "m"), quantity(v[1], "m")));
    return fmt::format("kind = \"polygon\", rotation = {}, centre = {}, vertices = [{}]",
                       quantity(s.rotation, "rad"), vector(s.centre, "m"), fmt::join(corners, ", "));
  }

  std::string several(const Shape& s) const {
    std::vector<std::string> parts;
    for (const Shape& part : s.parts) parts.push_back(shape(part));
    return fmt::format("kind = \"{}\", parts = [{}]",
                       s.kind == Shape::Kind::combined ? "union" : "difference", fmt::join(parts, ", "));
  }

  std::string shape(const Shape& s) const {
    std::string t;
    switch (s.kind) {
      case Shape::Kind::box:
        t = box(s);
        break;
      case Shape::Kind::cylinder:
        t = cylinder(s);
        break;
      case Shape::Kind::sphere:
        t = fmt::format("kind = \"sphere\", radius = {}, centre = {}", quantity(s.radius, "m"),
                        vector(s.centre, "m"));
        break;
      case Shape::Kind::half_space:
        t = fmt::format("kind = \"half-space\", point = {}, normal = {}", vector(s.point, "m"),
                        vector(s.normal, "1"));
        break;
      case Shape::Kind::polygon:
        t = polygon(s);
        break;
      default:
        t = several(s);
    }
    return "{ " + t + " }";
  }

  void add(const Body& body) {
    section("body." + body.name);
    if (body.rigid)
      line("rigid", "true");
    else
      line("material", quoted(body.material));
    line("shape", shape(body.shape));
    line("velocity", vector(body.velocity, "m/s"));
    if (body.mass > 0) free_motion(body);
    if (body.spin == Vector{}) return;
    line("spin", c_.domain.geometry == config::Geometry::space ? vector(body.spin, "rad/s")
                                                               : quantity(body.spin[2], "rad/s"));
    if (!(body.mass > 0)) line("spin-centre", vector(body.spin_centre, "m"));
  }

  void free_motion(const Body& body) {
    const bool planar = c_.domain.geometry == config::Geometry::planar,
               space = c_.domain.geometry == config::Geometry::space;
    line("mass", quantity(body.mass, planar                                         ? "kg/m"
                                     : c_.domain.geometry == config::Geometry::line ? "kg/m2"
                                                                                    : "kg"));
    line("centre-of-mass", vector(body.centre_of_mass, "m"));
    if (body.inertia == Vector{}) return;
    line("inertia", space ? vector(body.inertia, "kg m2") : quantity(body.inertia[2], "kg m"));
  }

  void add(const Gauge& g) {
    using enum Gauge::Kind;
    section("gauge." + g.name);
    constexpr const char* kinds[] = {"surface-velocity", "point",      "body", "contact", "bar",
                                     "attitude",         "peak-stress"};
    line("kind", quoted(kinds[static_cast<int>(g.kind)]));
    if (g.kind == contact)
      line("pair", quoted(g.pair[0] + '-' + g.pair[1]));
    else
      line("body", quoted(g.body));
    if (g.kind == surface_velocity || g.kind == point || g.kind == peak_stress || g.radius > 0)
      line("at", vector(g.at, "m"));
    if (g.radius > 0) line("radius", quantity(g.radius, "m"));
    if (g.direction != Vector{}) line("direction", vector(g.direction, "1"));
    if (g.kind == bar) line("wall", quoted(g.wall));
    if (g.kind == peak_stress) {
      line("to", vector(g.to, "m"));
      line("stations", std::to_string(g.stations));
    } else {
      line("every", quantity(g.every, "s"));
    }
  }

  /// The unit of an expectation is any, so its values stay in the unit that they were written in.
  void add(const config::Expectation& e) {
    const std::string name = quoted(e.quantity);
    const bool own = e.place.file == document_.name;
    const std::string from = fmt::format("{}line {}", own ? "" : "expected.toml, ", e.place.line);
    if (e.is_flag) {
      out_ += fmt::format("{} = {}  # {}\n", name, e.flag, from);
      return;
    }
    const auto written = [&](double value, bool difference) {
      if (e.unit.empty()) return format_number(value);
      const double scaled = difference ? value / config::unit_size(e.unit) : config::in_unit(value, e.unit);
      return quoted(fmt::format("{:.15g} {}", scaled, e.unit));  // without the round-off of the unit
    };
    std::string t = e.at_most ? "at-most = " : e.at_least ? "at-least = " : "value = ";
    t += written(e.value, false);
    if (!e.at_most && !e.at_least) t += ", within = " + written(e.tolerance, true);
    if (!e.source.empty()) t += ", source = " + quoted(e.source);
    if (!e.why.empty()) t += ", why = " + quoted(e.why);
    out_ += fmt::format("{} = {{ {} }}  # {}\n", name, t, from);
  }

  const config::Document& document_;
  const Case& c_;
  std::vector<std::string> axes_;
  std::string section_, out_;
};

}  // namespace

std::string resolved_text(const LoadedCase& loaded) { return Writer(loaded).text(loaded.materials); }

}  // namespace recoil::app
