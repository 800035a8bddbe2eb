#include <fmt/format.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "app/commands.hpp"
#include "app/load_case.hpp"
#include "app/plot/encoder.hpp"
#include "app/plot/field_plotter.hpp"
#include "app/plot/plot_file.hpp"
#include "core/error.hpp"
#include "picture/canvas.hpp"
#include "picture/field_plane.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

/// A folder for the single pictures, removed with what is in it.
class PictureFolder {
 public:
  explicit PictureFolder(const fs::path& movie)
      : path_(movie.parent_path() / fmt::format(".{}_{}", movie.filename().string(), getpid())) {
    std::error_code error;
    fs::create_directories(path_, error);
    if (error)
      throw EnvironmentError(
          fmt::format("the folder {} cannot be made: {}", path_.string(), error.message()));
  }
  ~PictureFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  PictureFolder(const PictureFolder&) = delete;
  PictureFolder& operator=(const PictureFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// The dumps from the one nearest to --from to the one nearest to --to.
std::vector<ChosenDump> dumps_of(const MovieOptions& o) {
  const std::vector<ChosenDump> all = all_dumps(o.plot.folder);
  const double from = o.from.empty() ? all.front().time_s : quantity_option(o.from, "s", "--from");
  const double to = o.to.empty() ? all.back().time_s : quantity_option(o.to, "s", "--to");
  if (!o.from.empty() && !o.to.empty() && !(from < to))
    throw InputError(fmt::format("--from {} is not before --to {}", o.from, o.to));
  const double first = choose_dump(o.plot.folder, from).time_s, last = choose_dump(o.plot.folder, to).time_s;
  std::vector<ChosenDump> chosen;
  for (const ChosenDump& d : all)
    if (d.time_s >= first && d.time_s <= last) chosen.push_back(d);
  if (chosen.size() < 2)
    throw InputError(
        fmt::format("{} has fields at {} of these times, too few for a movie\n   = help: run it with more of "
                    "them, e.g. --set output.fields.every=0.05us",
                    o.plot.folder, chosen.size()));
  return chosen;
}

/// Draws all of them in the same frame. @param file of picture n.
template <class Name>
void draw_all(const MovieOptions& o, const std::vector<ChosenDump>& dumps, Name&& file) {
  FieldPlotter plotter(o.plot);
  plotter.hold_frame(dumps);
  int width = 0, height = 0;
  for (std::size_t n = 0; n < dumps.size(); ++n) {
    const Canvas canvas = plotter.draw(dumps[n]);
    if (n == 0) width = canvas.width(), height = canvas.height();
    require(canvas.width() == width && canvas.height() == height, "pictures of one movie differ in size");
    write_picture(file(n), canvas);
  }
}

int write_numbered(const MovieOptions& o, const fs::path& file, const std::vector<ChosenDump>& dumps) {
  const auto name = [&](std::size_t n) {
    return file.parent_path() / fmt::format("{}_{:04}.png", file.stem().string(), n);
  };
  draw_all(o, dumps, name);
  fmt::print("{} to {}: {} pictures\n", name(0).string(), name(dumps.size() - 1).string(), dumps.size());
  return 0;
}

}  // namespace

int movie(const MovieOptions& o) {
  require_folder(o.plot.folder);
  const std::string& field = o.plot.what.front();
  if (field.starts_with("gauge.") || field.starts_with("history."))
    throw InputError(
        fmt::format("'{}' is no field\n   = help: name a field such as pressure; `recoil plot` draws '{}'",
                    field, field));
  const fs::path file = o.file.empty() ? fs::path(o.plot.folder) / (field + ".webp") : fs::path(o.file);
  if (file.extension() == ".png") return write_numbered(o, file, dumps_of(o));
  const Encoder encoder(file);  // before the work
  const std::vector<ChosenDump> dumps = dumps_of(o);
  const PictureFolder folder(file);
  draw_all(o, dumps, [&](std::size_t n) { return folder.path() / Encoder::picture_name(n); });
  encoder.encode(folder.path(), dumps.size(), o.rate);
  fmt::print("{}: {} pictures, {:.3g} s\n", file.string(), dumps.size(),
             static_cast<double>(dumps.size()) / o.rate);
  return 0;
}

}  // namespace recoil::app
