/// The module `_material` of the Python package: materials of the library, and points of them that are
/// deformed (recoil/material.py is what users see). All values are SI.

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/point/material_path.hpp"
#include "config/diagnostics.hpp"
#include "core/error.hpp"
#include "material/hugoniot.hpp"
#include "material/library.hpp"
#include "material/material.hpp"

namespace py = pybind11;
using namespace recoil;
using app::PathPoint;

namespace {

/// @throws InputError with what is wrong in the file, or the nearest names.
Material load(const std::string& name, const std::vector<std::string>& folders) {
  config::Diagnostics out;
  const auto material =
      find_material(name, nullptr, MaterialFolders(folders.begin(), folders.end()), out, {"Python"});
  if (!material) throw InputError(out.text());
  return *material;
}

app::PathKind path_kind(const std::string& name) {
  using enum app::PathKind;
  if (name == "uniaxial-strain") return uniaxial_strain;
  if (name == "uniaxial-stress") return uniaxial_stress;
  if (name == "simple-shear") return simple_shear;
  throw InputError(fmt::format("there is no path '{}'", name));
}

py::array_t<double> column(const std::vector<PathPoint>& path,
                           const std::function<double(const PathPoint&)>& value) {
  py::array_t<double> array(static_cast<py::ssize_t>(path.size()));
  auto to = array.mutable_unchecked<1>();
  for (std::size_t k = 0; k < path.size(); ++k) to(static_cast<py::ssize_t>(k)) = value(path[k]);
  return array;
}

/// (points, 6): xx, yy, zz, xy, yz, xz.
py::array_t<double> stresses(const std::vector<PathPoint>& path) {
  constexpr std::array<std::size_t, 6> order{0, 1, 5, 2, 4, 3};
  py::array_t<double> array({static_cast<py::ssize_t>(path.size()), py::ssize_t{6}});
  auto to = array.mutable_unchecked<2>();
  for (std::size_t k = 0; k < path.size(); ++k)
    for (std::size_t c = 0; c < 6; ++c)
      to(static_cast<py::ssize_t>(k), static_cast<py::ssize_t>(c)) = path[k].state.stress[order[c]];
  return array;
}

py::dict follow(const Material& material, const std::string& kind, const std::vector<double>& strains,
                double rate, int steps, std::optional<double> pressure, std::optional<double> temperature) {
  const auto path =
      app::follow_path(material, {path_kind(kind), strains, rate, steps, pressure, temperature});
  py::dict columns;
  const auto add = [&](const char* name, const auto& value) { columns[name] = column(path, value); };
  add("time", [](const PathPoint& p) { return p.time; });
  add("strain", [](const PathPoint& p) { return p.strain; });
  add("side_strain", [](const PathPoint& p) { return p.side_strain; });
  add("energy", [](const PathPoint& p) { return p.energy; });
  add("pressure", [](const PathPoint& p) { return p.state.pressure; });
  add("density", [](const PathPoint& p) { return p.state.density; });
  add("von_mises", [](const PathPoint& p) { return p.state.von_mises; });
  add("temperature", [](const PathPoint& p) { return p.state.temperature; });
  add("molten", [](const PathPoint& p) { return p.state.molten; });
  add("plastic_strain", [](const PathPoint& p) { return p.state.plastic_strain; });
  add("damage", [](const PathPoint& p) { return p.state.damage; });
  add("void_fraction", [](const PathPoint& p) { return p.state.void_fraction; });
  columns["stress"] = stresses(path);
  return columns;
}

py::dict shock(const Material& material, double velocity) {
  const ShockState s = shock_at_velocity(material, velocity);
  py::dict d;
  d["velocity"] = s.velocity;
  d["stress"] = s.stress;
  d["pressure"] = s.pressure;
  d["density"] = s.density;
  d["energy"] = s.energy;
  d["temperature"] = s.temperature;
  d["molten"] = s.molten;
  d["plastic_strain"] = s.plastic_strain;
  d["yield_stress"] = s.yield;
  d["shock_speed"] = s.shock_speed;
  d["release_speed"] = s.release_speed;
  d["bulk_speed"] = s.bulk_speed;
  d["precursor_speed"] = s.precursor_speed;
  d["precursor_velocity"] = s.precursor_velocity;
  d["precursor_stress"] = s.precursor_stress;
  return d;
}

double yield_at(const Material& m, double strain, double rate, double temperature, double pressure) {
  return yield(m.strength, {.ep = strain, .rate = rate, .temperature = temperature, .pressure = pressure});
}

/// The program's errors as those of the package.
void translate(std::exception_ptr thrown) {
  const auto raise = [](const char* name, const std::exception& error) {
    PyErr_SetString(py::module_::import("recoil.errors").attr(name).ptr(), error.what());
  };
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    raise("InputError", error);
  } catch (const PhysicsError& error) {
    raise("PhysicsError", error);
  } catch (const EnvironmentError& error) {
    raise("EnvironmentError", error);
  } catch (const InternalError& error) {
    raise("InternalError", error);
  }
}

}  // namespace

PYBIND11_MODULE(_material, module) {
  py::register_exception_translator(translate);
  py::class_<Material>(module, "Material")
      .def_readonly("name", &Material::name)
      .def_readonly("title", &Material::title)
      .def_property_readonly("density", [](const Material& m) { return density(m); })
      .def_property_readonly("shear_modulus", [](const Material& m) { return shear_modulus(m); })
      .def_property_readonly("bulk_speed", [](const Material& m) { return bulk_sound_speed(m); })
      .def_property_readonly("longitudinal_speed", [](const Material& m) { return longitudinal_speed(m); })
      .def("toml", [](const Material& m) { return to_toml(m); })
      .def("yield_stress", yield_at)
      .def("follow", follow)
      .def("shock", shock)
      .def("largest_velocity", [](const Material& m) { return largest_velocity(m); });
  module.def("load", load);
}
