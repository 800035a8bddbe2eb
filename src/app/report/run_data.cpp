#include "app/report/run_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "app/check/prediction.hpp"
#include "app/report/comparisons.hpp"
#include "app/report/material_data.hpp"
#include "app/run/resolved_case.hpp"
#include "config/geometry.hpp"
#include "core/error.hpp"
#include "format/csv.hpp"
#include "format/json_files.hpp"
#include "format/packed.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

/// The contents of a JSON file; null where there is none, or where it is torn.
Json json_of(const fs::path& file) {
  Json j = Json::parse(text_of(file), nullptr, false);
  return j.is_discarded() ? Json(nullptr) : j;
}

/// "velocity [m/s]" as name and unit.
Json column_json(const CsvTable& table, const std::string& column) {
  const std::string unit = table.unit(column);
  return {{"name", unit.empty() ? column : column.substr(0, column.rfind(" ["))}, {"unit", unit}};
}

/// A table of numbers: its columns, and their values one column after another.
Json table_json(const fs::path& file, Blocks& blocks) {
  const CsvTable table = read_csv(file);
  Json j = {{"name", file.stem().string()}, {"rows", table.rows.size()}};
  std::vector<float> all;
  all.reserve(table.rows.size() * table.columns.size());
  for (const std::string& column : table.columns) {
    j["columns"].push_back(column_json(table, column));
    for (const double v : table.numbers(column)) all.push_back(static_cast<float>(v));
  }
  j["values"] = blocks.add(packed_floats(all));
  return j;
}

Json gauges_json(const fs::path& run, const LoadedCase& loaded, Blocks& blocks) {
  Json all = Json::array();
  for (const config::Gauge& gauge : loaded.contents.gauges) {
    const fs::path file = run / "gauges" / (gauge.name + ".csv");
    if (!fs::exists(file)) continue;
    Json j = table_json(file, blocks);
    j["kind"] = std::visit([](const auto& g) { return std::string(g.kind); }, gauge.kind);
    j["curves"] = comparisons(gauge, loaded, run);
    all.push_back(std::move(j));
  }
  return all;
}

/// The columns of the place in a row, "1.5 0"; empty where there is none. Runs of before have one such
/// column.
std::string place_text(const CsvTable& table, std::size_t row) {
  std::string text;
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    if (table.columns[c].starts_with("place") && table.rows[row][c] != "nan")
      text += (text.empty() ? "" : " ") + table.rows[row][c];
  return text;
}

Json events_json(const fs::path& file) {
  Json all = Json::array();
  if (!fs::exists(file)) return all;
  const CsvTable table = read_csv(file);
  const std::vector<double> times = table.numbers("time");
  const auto kinds = table.texts("event"), bodies = table.texts("bodies"), details = table.texts("detail");
  for (std::size_t k = 0; k < times.size(); ++k)
    all.push_back({{"t", number(times[k])},
                   {"event", kinds[k]},
                   {"bodies", bodies[k]},
                   {"place", place_text(table, k)},
                   {"detail", details[k]}});
  return all;
}

/// The fragments at the end, the first of them: names of columns with units, and rows as text.
Json fragments_json(const fs::path& file) {
  constexpr std::size_t most = 50;
  Json j = {{"columns", Json::array()}, {"rows", Json::array()}, {"left_out", 0}};
  if (!fs::exists(file)) return j;
  const CsvTable table = read_csv(file);
  j["columns"] = table.columns;
  std::size_t left_out = 0;
  for (const std::vector<std::string>& row : table.rows) {
    if (row.front() != table.rows.back().front()) continue;
    if (j["rows"].size() < most)
      j["rows"].push_back(row);
    else
      ++left_out;
  }
  j["left_out"] = left_out;
  return j;
}

/// What `recoil check` said before the run.
std::string predicted(const LoadedCase& loaded) {
  std::string text;
  try {
    const auto plates = find_plate_pairs(loaded.contents);
    for (const PlatePair& pair : plates)
      text += describe(predict(pair, loaded.contents, loaded.materials), loaded.contents);
    for (const TouchPrediction& touch : predict_touches(loaded.contents, loaded.materials, plates))
      text += describe(touch, loaded.contents);
    for (const std::string& why : not_predicted(loaded.contents)) text += fmt::format("  {}\n", why);
  } catch (const PhysicsError& e) {
    text += fmt::format("  nothing: {}\n", e.what());
  }
  return text;
}

Json crash_json(const fs::path& folder) {
  std::error_code none;
  std::vector<fs::path> texts;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.path().extension() == ".txt") texts.push_back(entry.path());
  if (texts.empty()) return nullptr;
  return text_of(*std::ranges::min_element(texts));
}

}  // namespace

Json run_data(const fs::path& run, const LoadedCase& loaded, Blocks& blocks) {
  const config::Case& c = loaded.contents;
  const std::string resolved = text_of(run / "case.resolved.toml");
  Json j = {{"name", fs::absolute(run).lexically_normal().filename().string()},
            {"title", c.title},
            {"geometry", config::name_of(c.domain.geometry)},
            {"axes", config::axes_of(c.domain.geometry)},
            {"cell_mm", c.mesh.finest * 1e3},
            {"end_us", c.time.end * 1e6},
            {"scheme", loaded.contents.method.scheme},
            {"summary", json_of(run / "summary.json")},
            {"status", json_of(run / "status.json")},
            {"crash", crash_json(run / "crash")},
            {"predicted", predicted(loaded)},
            {"case", text_of(run / "case.toml")},
            {"resolved", resolved},
            {"changes", changes_of(resolved)},
            {"events", events_json(run / "events.csv")},
            {"fragments", fragments_json(run / "fragments.csv")}};
  for (const config::Body& body : c.bodies)
    j["bodies"].push_back({{"name", body.name}, {"material", body.rigid ? "rigid" : body.material}});
  j["gauges"] = gauges_json(run, loaded, blocks);
  if (fs::exists(run / "history.csv")) j["history"] = table_json(run / "history.csv", blocks);
  j["materials"] = materials_json(loaded);
  j["sources"] = sources_json(loaded);
  return j;
}

}  // namespace recoil::app
