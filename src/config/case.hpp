#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/gauge/gauge.hpp"
#include "config/section/body.hpp"
#include "config/section/contact.hpp"
#include "config/section/domain.hpp"
#include "config/section/expect.hpp"
#include "config/section/limits.hpp"
#include "config/section/load.hpp"
#include "config/section/mesh.hpp"
#include "config/section/method.hpp"
#include "config/section/output.hpp"
#include "config/section/time.hpp"

namespace recoil::config {

/// The contents of a case file, checked and in SI. Its materials are read by material/library, with the key
/// lists of their models.
struct Case {
  std::string file;  // path as given
  std::string text;  // the file's content
  int format = 1;
  std::string title;
  std::vector<std::string> cite;
  Domain domain;
  MeshChoice mesh;
  std::vector<Region> regions;  // of finest cells
  TimeChoice time;
  std::vector<Body> bodies;
  std::vector<Load> loads;
  std::vector<Gauge> gauges;
  Contact contact;
  Method method;
  Limits limits;
  Output output;
  std::vector<Expectation> expect;
  std::vector<std::filesystem::path> files;  // that the case names and its bodies are read from

  static constexpr const char* doc = "The top of the file.";
  /// Every table, in the order in which one writes and in which they are read.
  static Entries<Case> keys();
};

/// The largest difference of the velocities of two bodies, at the start or by a history [m/s]; without spins.
double largest_closing_speed(const Case& c);

/// All tables of a case with all their values, defaults as well, but materials.
std::vector<WrittenTable> written_tables(const Case& c);

}  // namespace recoil::config
