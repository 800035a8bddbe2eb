#include "app/run/reporter.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

namespace recoil::app {

namespace {

constexpr std::chrono::milliseconds live_every{200};
constexpr std::chrono::seconds line_every{10};

std::string duration(double seconds) {
  if (seconds < 60) return fmt::format("{:.0f} s", seconds);
  const long s = static_cast<long>(seconds);
  return s < 3600 ? fmt::format("{}:{:02} min", s / 60, s % 60)
                  : fmt::format("{}:{:02} h", s / 3600, s / 60 % 60);
}

std::string bar(double part) {
  constexpr int width = 24;
  const int full = std::clamp(static_cast<int>(part * width), 0, width);
  return '[' + std::string(static_cast<std::size_t>(full), '#') +
         std::string(static_cast<std::size_t>(width - full), '.') + ']';
}

/// @param time, step where this life of the run began, `wall` seconds ago.
std::string text_of(const Progress& now, double time, long step, double wall, bool with_bar) {
  const double part = now.end > 0 ? now.time / now.end : 1, done = now.time - time;
  const double left = done > 0 ? wall * (now.end - now.time) / done : 0;
  const double rate = wall > 0 ? now.cells * static_cast<double>(now.step - step) / wall * 1e-6 : 0;
  return fmt::format("{:8.4g} us {} {:3.0f} %  step {}  dt {:.3g} ns  {:.3g} Mcell/s  {} left",
                     now.time * 1e6, with_bar ? bar(part) : "", part * 100, now.step, now.dt * 1e9, rate,
                     duration(left));
}

}  // namespace

bool tell(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0)
    return true;
  if (std::freopen("/dev/null", "w", stdout) == nullptr) std::clearerr(stdout);
  return false;
}

Reporter::Reporter(Display display, bool speaks, const std::filesystem::path& log, bool goes_on)
    : display_(display), speaks_(speaks), log_(nullptr, &std::fclose), start_(Clock::now()) {
  next_ = start_ + live_every;
  next_log_ = start_ + line_every;
  if (!speaks_) return;
  log_.reset(std::fopen(log.c_str(), goes_on ? "a" : "w"));
  if (!log_) throw EnvironmentError(fmt::format("{} cannot be written", log.string()));
}

Reporter::~Reporter() { clear(); }

void Reporter::show(const std::string& text) {
  if (!tell(text)) display_ = Display::none;
}

void Reporter::clear() {
  if (line_shown_) show("\r\033[K");
  line_shown_ = false;
}

void Reporter::write(const std::string& line, bool to_terminal) {
  if (!speaks_) return;
  fmt::print(log_.get(), "{}\n", line);
  std::fflush(log_.get());
  if (!to_terminal) return;
  clear();
  show(line + '\n');
}

void Reporter::say(const std::string& line) { write(line, display_ != Display::none); }
void Reporter::insist(const std::string& line) { write(line, true); }

void Reporter::progress(const Progress& now) {
  if (!speaks_) return;
  const auto clock = Clock::now();
  const double wall = std::chrono::duration<double>(clock - start_).count();
  if (clock >= next_log_) {
    write(text_of(now, begun_at_, first_step_, wall, false), display_ == Display::plain);
    next_log_ = clock + line_every;
  }
  if (display_ != Display::live || clock < next_) return;
  show("\r\033[K" + text_of(now, begun_at_, first_step_, wall, true));
  line_shown_ = true;
  next_ = clock + live_every;
}

}  // namespace recoil::app
