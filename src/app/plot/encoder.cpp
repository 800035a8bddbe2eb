#include "app/plot/encoder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <system_error>

#include "app/launch.hpp"
#include "core/error.hpp"
#include "format/json_files.hpp"

namespace recoil::app {

namespace fs = std::filesystem;

namespace {

/// The small program for a format and the package of Debian that has it.
struct Maker {
  const char *suffix, *program, *package;
};
constexpr Maker makers[] = {
    {".webp", "img2webp", "webp"}, {".apng", "apngasm", "apngasm"}, {".mp4", "ffmpeg", "ffmpeg"}};

std::vector<std::string> ffmpeg_words(const fs::path& folder, double rate, const std::string& suffix) {
  std::vector<std::string> words{"ffmpeg",     "-y",
                                 "-loglevel",  "error",
                                 "-framerate", fmt::format("{}", rate),
                                 "-i",         (folder / "%06d.png").string()};
  if (suffix == ".webp") words.insert(words.end(), {"-c:v", "libwebp_anim", "-q:v", "80", "-loop", "0"});
  if (suffix == ".apng") words.insert(words.end(), {"-f", "apng", "-plays", "0"});
  if (suffix == ".mp4")  // H.264 as all browsers play it; sides are even numbers of pixels
    words.insert(words.end(), {"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-crf", "18",
                               "-pix_fmt", "yuv420p", "-movflags", "+faststart"});
  return words;
}

}  // namespace

Encoder::Encoder(const fs::path& file) : file_(file), suffix_(file.extension().string()) {
  std::ranges::transform(suffix_, suffix_.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto* maker =
      std::ranges::find(makers, suffix_, [](const Maker& m) { return std::string(m.suffix); });
  if (maker == std::end(makers))
    throw InputError(
        fmt::format("a movie cannot be written as '{}'\n   = help: choose .webp, .apng or .mp4, or .png "
                    "for numbered pictures",
                    file.filename().string()));
  for (const char* program : {maker->program, "ffmpeg"})
    if (program_.empty() && !on_path(program).empty()) program_ = program;
  if (program_.empty())
    throw EnvironmentError(fmt::format(
        "there is no {}, which makes {} files\n   = help: install Debian's {}, or write "
        "numbered pictures: {}",
        maker->program, suffix_, maker->package, fs::path(file).replace_extension(".png").string()));
}

std::string Encoder::picture_name(std::size_t n) { return fmt::format("{:06}.png", n); }

std::vector<std::string> Encoder::words(const fs::path& folder, std::size_t pictures, double rate,
                                        const std::string& output) const {
  std::vector<std::string> words;
  if (program_ == "img2webp") {
    words = {program_, "-loop", "0", "-lossy", "-q", "80", "-d", fmt::format("{}", std::lround(1000 / rate))};
    for (std::size_t n = 0; n < pictures; ++n) words.push_back((folder / picture_name(n)).string());
    words.push_back("-o");
  } else if (program_ == "apngasm") {  // the length of a picture as a fraction of a second
    return {program_, output, (folder / picture_name(0)).string(), "100",
            fmt::format("{}", std::lround(100 * rate))};
  } else {
    words = ffmpeg_words(folder, rate, suffix_);
  }
  words.push_back(output);
  return words;
}

void Encoder::encode(const fs::path& folder, std::size_t pictures, double rate) const {
  const fs::path made = folder / ("movie" + suffix_), log = folder / "encoder.log";
  if (run_program(words(folder, pictures, rate, made.string()), log) != 0 || !fs::exists(made)) {
    const fs::path kept = file_.string() + ".log";
    std::error_code ignored;
    fs::copy_file(log, kept, fs::copy_options::overwrite_existing, ignored);
    throw EnvironmentError(
        fmt::format("{} failed; see {}\n   = help: another format may do, or .png for numbered pictures",
                    program_, kept.string()));
  }
  sync_and_rename(made, file_);
}

}  // namespace recoil::app
