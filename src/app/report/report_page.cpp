#include "app/report/report_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string_view>
#include <utility>

#include "app/report/field_frames.hpp"
#include "app/report/page_bundle.hpp"
#include "app/report/page_data.hpp"
#include "app/report/run_data.hpp"
#include "app/report/run_dumps.hpp"
#include "app/report/surface_frames.hpp"
#include "core/build_info.hpp"
#include "core/error.hpp"
#include "format/json_files.hpp"
#include "picture/colour_map.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

/// Where the page has room for its data.
constexpr std::string_view data_mark = R"(id="recoil-data">)", blocks_mark = R"(id="recoil-blocks">)";

std::string colours_text(ColourMap map) {
  std::string text;
  for (const Rgb c : colour_table(map, 256)) text += fmt::format("{:02x}{:02x}{:02x}", c.r, c.g, c.b);
  return text;
}

Json colours_json() {
  Json j = {{"sequential", colours_text(ColourMap::sequential)},
            {"diverging", colours_text(ColourMap::diverging)},
            {"heat", colours_text(ColourMap::heat)},
            {"grey", colours_text(ColourMap::grey)}};
  for (std::size_t k = 0; k < 9; ++k) {
    const Rgb c = curve_colour(k);
    j["curves"].push_back(fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b));
  }
  return j;
}

/// JSON inside of a page: no tag can begin in it, and bytes that are no text do not break it.
std::string text_in_page(const Json& j) {
  const std::string text = j.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string out;
  out.reserve(text.size() + text.size() / 50);
  for (const char c : text) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

std::string put_behind(std::string page, std::string_view mark, const std::string& text) {
  const std::size_t at = page.find(mark);
  require(at != std::string::npos, "the page has room for its data");
  return page.insert(at + mark.size(), text);
}

}  // namespace

WrittenReport write_report(const fs::path& file, const std::vector<fs::path>& runs, double most_mb) {
  if (page_bundle().empty())
    throw EnvironmentError(
        "this program was built without the page that shows reports\n   = help: install Debian's nodejs and "
        "npm, "
        "and build it again (`make build` does both)");
  WrittenReport written;
  Blocks blocks;
  Json j = {{"format", 1}, {"version", build_info::version}, {"colours", colours_json()}};
  const double most = most_mb * 1e6 - static_cast<double>(page_bundle().size());
  for (const fs::path& run : runs) {
    const LoadedCase loaded = load_run(run);
    Json one = run_data(run, loaded, blocks);
    const double taken = static_cast<double>(text_in_page(one).size() + blocks.text().size());
    const double left = std::max(
        0.0, most * static_cast<double>(j["runs"].size() + 1) / static_cast<double>(runs.size()) - taken);
    const RunDumps dumps = dumps_of(run);
    for (const fs::path& dump : dumps.damaged)
      written.damaged.push_back(fmt::format("the field file '{}' is damaged or cut off", dump.string()));
    const SurfaceFrames surfaces(dumps, loaded.contents, left / 3);
    one["surfaces"] = surfaces.write(blocks);
    const FieldFrames fields(dumps, loaded, left - static_cast<double>(surfaces.size()));
    one["fields"] = fields.write(blocks);
    if (fields.is_thinned())
      written.omissions.push_back(fmt::format("{}: {} shown", run.string(), fields.omission()));
    j["runs"].push_back(std::move(one));
  }
  std::string page = put_behind(std::string(page_bundle()), data_mark, text_in_page(j));
  page = put_behind(std::move(page), blocks_mark, blocks.text());
  write_atomically(file, page);
  written.bytes = page.size();
  return written;
}

void leave_report(const fs::path& run, bool quiet) {
  if (page_bundle().empty()) return;
  const fs::path file = run / "report.html";
  try {
    const WrittenReport written = write_report(file, {run}, usual_report_mb);
    if (quiet) return;
    fmt::print("report  {}\n", file.string());
    for (const std::string& line : written.omissions) fmt::print("  {}\n", line);
  } catch (const std::exception& e) {
    fmt::print(stderr, "note: no report.html: {}\n", e.what());
  }
}

}  // namespace recoil::app
