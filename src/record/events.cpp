#include "record/events.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "parallel/archive.hpp"
#include "state/body.hpp"

namespace recoil {

namespace {

using Three = std::array<double, 3>;

constexpr double never = std::numeric_limits<double>::quiet_NaN();
constexpr double nowhere_near = std::numeric_limits<double>::infinity();
constexpr double least_reversal = 1e-3;  // of the speed of approach, below which a reversal is noise
constexpr double least_speed = 1e-9;     // m/s that is shown
constexpr double round_off = 1e-9;       // of a hold time, and of the larger speed of two bodies

double dot(const Three& a, const Three& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double size(const Three& a) { return std::sqrt(dot(a, a)); }

/// One pair under observation. Begins are on trial until they have lasted for the hold time.
struct Watched {
  std::size_t a = 0, b = 0;
  double hold = 0;     // s
  bool glued = false;  // a force of zero does not part it
  PairStory story;
  double largest_force = 0;
  double silent = never;      // s, end of the last step with force; NaN: there was force in the last step
  double parted = never;      // s, that of the opening on trial or the last one
  double met = never;         // s, when a touch after an opening began, on trial
  double apart = never;       // s, since when the gap is open everywhere
  bool separate = false;      // the gap has been open everywhere for the hold time
  double gap = nowhere_near;  // m, at the end of the last step
  double closing = never;     // m/s, over the last step
  std::vector<double> place;  // m, mean, while they last touched
  std::vector<double> lift_place;  // m, of the last lift-off
  std::array<bool, 2> free{};      // to move, not as prescribed
  Three impulse{}, impulse_parted{};
  std::array<Three, 2> velocity_made{}, velocity_parted{};  // m/s

  bool presses(const PairSample& s) const {
    const double force = size(s.force);
    return s.area > 0 && (glued || (force > 0 && force >= least_force * largest_force));
  }

  template <class Archive>
  void transfer(Archive& a) {
    a(story, largest_force, silent, parted, met, apart, separate, gap, closing, place, lift_place, free,
      impulse, impulse_parted, velocity_made, velocity_parted);
  }
};

}  // namespace

struct EventWatch::Parts {
  std::vector<std::string> names;
  int dim = 1;
  double least_gap = 0;  // m
  double stand_off = 0;  // m
  double gap_at = 0;     // part of a step
  std::vector<std::string> axes;
  std::array<bool, 3> sided{};  // axes along which a body is but half of one
  std::vector<Watched> pairs;
  std::vector<Event> events, news;

  void add(const Watched& w, double time, const char* kind, std::vector<double> place, std::string detail) {
    add({time, kind, w.story.first + "-" + w.story.second, std::move(place), std::move(detail)});
  }

  void add(Event e) {
    const auto later = std::upper_bound(events.begin(), events.end(), e.time,
                                        [](double t, const Event& other) { return t < other.time; });
    news.push_back(e);
    events.insert(later, std::move(e));
  }

  /// Mean velocity of a body [m/s] at the start of a step, from its momentum at the end and what its contacts
  /// gave it in between.
  Three velocity_before(std::size_t body, const std::vector<PairSample>& samples,
                        const std::vector<BodyMotion>& motion) const {
    if (!(motion[body].mass > 0)) return motion[body].velocity;
    Three p = motion[body].momentum;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const double sign = pairs[k].a == body ? 1 : pairs[k].b == body ? -1 : 0;
      for (std::size_t d = 0; d < 3; ++d) p[d] -= sign * (samples[k].impulse[d] - pairs[k].impulse[d]);
    }
    for (double& c : p) c /= motion[body].mass;
    return p;
  }

  std::array<Three, 2> velocities_before(const Watched& w, const std::vector<PairSample>& samples,
                                         const std::vector<BodyMotion>& motion) const {
    return {velocity_before(w.a, samples, motion), velocity_before(w.b, samples, motion)};
  }

  /// "450" in 1-D, else "x 60 y -350"; empty where no component has a meaning.
  /// @param of what a velocity is part; what is less than its round-off is shown as 0.
  std::string components(const Three& v, const std::array<Three, 2>& of) const {
    const double least = std::max(round_off * std::max(size(of[0]), size(of[1])), least_speed);
    std::vector<std::string> shown;
    for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d)
      if (!sided[d])
        shown.push_back(
            fmt::format("{}{:.5g}", dim > 1 ? axes[d] + ' ' : "", std::abs(v[d]) > least ? v[d] : 0.0));
    return fmt::format("{}", fmt::join(shown, " "));
  }

  std::string motion_text(const Watched& w, const std::array<Three, 2>& v) const {
    std::vector<std::string> texts;
    for (std::size_t k = 0; k < 2; ++k)
      if (const std::string shown = components(v[k], v); w.free[k] && !shown.empty())
        texts.push_back(fmt::format("{} {} m/s", names[k == 0 ? w.a : w.b], shown));
    return fmt::format("{}", fmt::join(texts, ", "));
  }

  /// When a touch began that the step [time - dt, time] is the first to feel: the gap where the surfaces
  /// touch over the speed at which the pair's gap closed in the step before, or over `approach` in the first
  /// step. (The smallest gap at centres of cells would miss the tip of a sharp
  /// body.)
  double time_of_touch(const Watched& w, const PairSample& s, double time, double dt, double approach) const {
    const double speed = std::isnan(w.closing) ? approach : w.closing, start = time - dt;
    if (!(speed > 0)) return start;
    return std::clamp(start + gap_at * dt + (s.gap / s.area - stand_off) / speed, std::max(start - dt, 0.0),
                      time);
  }

  void press(Watched& w, double time, double dt, const PairSample& s, const std::vector<PairSample>& all,
             const std::vector<BodyMotion>& motion) {
    w.place.assign(s.place.begin(), s.place.begin() + dim);
    for (double& x : w.place) x /= s.area;
    w.silent = never;
    if (!w.story.open) return;
    if (std::isnan(w.story.made)) {
      w.free = {motion[w.a].mass > 0, motion[w.b].mass > 0};
      w.velocity_made = velocities_before(w, all, motion);
      Three n = s.impulse;  // on the first body: away from the second
      const double length = size(n);
      for (double& c : n) c = length > 0 ? c / length : 0;
      w.story.made = time_of_touch(w, s, time, dt, dot(n, w.velocity_made[1]) - dot(n, w.velocity_made[0]));
      w.story.open = false;
      add(w, w.story.made, "contact", w.place, motion_text(w, w.velocity_made));
      return;
    }
    if (std::isnan(w.met)) w.met = time_of_touch(w, s, time, dt, never);
    if (w.separate || time - w.met >= w.hold * (1 - round_off)) close_again(w);
  }

  void close_again(Watched& w) {
    if (!w.story.recloses) w.story.closes_again = w.met;
    w.story.recloses = true;
    w.story.open = w.separate = false;
    add(w, w.met, "reclosure", w.place, {});
    w.met = never;
  }

  void release(Watched& w, double time, double dt, const std::vector<PairSample>& all,
               const std::vector<BodyMotion>& motion) {
    if (std::isnan(w.story.made)) return;
    if (std::isnan(w.silent)) {
      w.silent = time - dt;
      if (!w.story.open) {
        w.parted = w.silent;
        w.impulse_parted = w.impulse;
        w.velocity_parted = velocities_before(w, all, motion);
      }
    }
    if (time - w.silent < w.hold * (1 - round_off)) return;
    w.met = never;
    if (!w.story.open) believe(w);
  }

  /// Follows the gap: its rate, and whether it is open everywhere.
  void follow_gap(Watched& w, double time, double dt, double gap, bool presses) {
    const bool known = std::isfinite(gap) && std::isfinite(w.gap);
    const double before = w.gap;
    w.closing = known && dt > 0 ? (before - gap) / dt : never;
    w.gap = gap;
    if (std::isnan(w.story.made)) return;
    if (presses || !(gap > least_gap)) {
      w.apart = never;
      return;
    }
    if (std::isnan(w.apart))
      w.apart =
          known && gap > before ? time - dt * std::clamp((gap - least_gap) / (gap - before), 0.0, 1.0) : time;
    if (!w.separate && time - w.apart >= w.hold * (1 - round_off)) separate(w);
  }

  void separate(Watched& w) {
    w.separate = true;
    if (std::isnan(w.story.separates)) w.story.separates = w.apart;
    add(w, w.apart, "separation", w.place, fmt::format("gap above {:.3g} mm everywhere", least_gap * 1e3));
  }

  void believe(Watched& w) {
    w.story.open = true;
    if (std::isnan(w.story.opens))
      w.story.opens = w.parted;
    else if (std::isnan(w.story.opens_again))
      w.story.opens_again = w.parted;
    w.story.restitution = restitution_of(w);
    add(w, w.parted, "opening", w.place, motion_text(w, w.velocity_parted));
  }

  /// Newton's coefficient of restitution, along the impulse.
  double restitution_of(const Watched& w) const {
    double before = 0, after = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double n = sided[d] ? 0 : w.impulse_parted[d];
      before += n * (w.velocity_made[0][d] - w.velocity_made[1][d]);
      after += n * (w.velocity_parted[0][d] - w.velocity_parted[1][d]);
    }
    return before < 0 ? -after / before : never;
  }

  /// Whether a body that moved towards its partner now moves away from it, along the impulse. Of a body cut
  /// by a plane of symmetry only half is there, and momentum along a radius has no
  /// direction, so such an axis does not count.
  void look_for_ricochet(const Watched& w, int side) {
    Three n = w.impulse_parted;  // on the first body: away from the second
    for (std::size_t d = 0; d < 3; ++d)
      if (sided[d]) n[d] = 0;
    const double length = size(n), away = side == 0 ? 1 : -1;
    const std::size_t body = side == 0 ? w.a : w.b;
    if (!(length > 0) || !w.free[side]) return;
    const Three &was = w.velocity_made[side], &is = w.velocity_parted[side];
    const double before = away * dot(was, n) / length, after = away * dot(is, n) / length;
    Three approach = was;
    for (std::size_t d = 0; d < 3; ++d) approach[d] -= w.velocity_made[1 - side][d];
    const double least = least_reversal * size(approach);
    if (!(before < -least) || !(after > least)) return;
    add(w, w.parted, "ricochet", w.place,
        fmt::format(
            "{}: {} m/s before, {} m/s after; along the impulse {:.5g} m/s towards {}, then {:.5g} m/s away",
            names[body], components(was, w.velocity_made), components(is, w.velocity_parted), -before,
            names[side == 0 ? w.b : w.a], after));
  }
};

EventWatch::EventWatch(std::vector<std::string> names, config::Geometry geometry, ContactRule rule,
                       std::array<bool, 3> sided)
    : parts_(std::make_unique<Parts>()) {
  Parts& p = *parts_;
  p.names = std::move(names);
  p.dim = config::dimension(geometry);
  p.axes = config::axes_of(geometry);
  p.least_gap = rule.gap;
  p.stand_off = rule.stand_off;
  p.gap_at = rule.gap_at;
  p.sided = sided;
  if (config::has_radius(geometry)) p.sided[0] = true;
  const std::size_t n = p.names.size();
  require(rule.hold.size() == n * (n - 1) / 2, "a hold time for every pair");
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b) {
      Watched w;
      w.a = a, w.b = b, w.hold = rule.hold[p.pairs.size()];
      w.glued = !rule.glued.empty() && rule.glued[p.pairs.size()];
      w.story.first = p.names[a], w.story.second = p.names[b];
      w.story.made = w.story.opens = w.story.separates = w.story.lift_first = w.story.lift_last = never;
      w.story.closes_again = w.story.opens_again = w.story.restitution = never;
      p.pairs.push_back(std::move(w));
    }
}

EventWatch::~EventWatch() = default;
EventWatch::EventWatch(EventWatch&&) noexcept = default;

void EventWatch::begin(const std::vector<PairSample>& samples) {
  for (std::size_t k = 0; k < samples.size(); ++k) parts_->pairs[k].gap = samples[k].smallest_gap;
}

bool EventWatch::needs_motion(const std::vector<PairSample>& samples) const {
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Watched& w = parts_->pairs[k];
    const bool presses = w.presses(samples[k]), met = !std::isnan(w.story.made);
    if (presses ? !met : met && !w.story.open && std::isnan(w.silent)) return true;
  }
  return false;
}

void EventWatch::step(double time, double dt, const std::vector<PairSample>& samples,
                      const std::vector<BodyMotion>& motion) {
  Parts& p = *parts_;
  for (std::size_t k = 0; k < p.pairs.size(); ++k) {
    Watched& w = p.pairs[k];
    const PairSample& s = samples[k];
    const bool presses = w.presses(s);
    if (presses)
      p.press(w, time, dt, s, samples, motion);
    else
      p.release(w, time, dt, samples, motion);
    w.largest_force = std::max(w.largest_force, size(s.force));
    p.follow_gap(w, time, dt, s.smallest_gap, presses);
  }
  for (std::size_t k = 0; k < p.pairs.size(); ++k) p.pairs[k].impulse = samples[k].impulse;
}

void EventWatch::lift_off(std::size_t pair, double time, const std::vector<double>& place) {
  Watched& w = parts_->pairs[pair];
  if (std::isnan(w.story.lift_first)) {
    w.story.lift_first = time;
    parts_->add(w, time, "lift-off", place, "first local opening while the pair touches elsewhere");
  }
  if (std::isnan(w.story.lift_last) || time > w.story.lift_last) {
    w.story.lift_last = time;
    w.lift_place = place;
  }
}

void EventWatch::failure(const std::string& body, double time, std::vector<double> place) {
  const auto same = [&](const Event& e) { return e.kind == "failure" && e.bodies == body; };
  if (std::any_of(parts_->events.begin(), parts_->events.end(), same)) return;
  parts_->add({time, "failure", body, std::move(place), "its matter fails for the first time"});
}

void EventWatch::fragment(const std::string& body, const std::string& by, double time,
                          std::vector<double> place) {
  parts_->add(
      {time, "fragment", body, std::move(place), "one of its fragments goes on as part of '" + by + "'"});
}

void EventWatch::finish() {
  for (Watched& w : parts_->pairs) {
    if (!w.story.open && !std::isnan(w.silent)) parts_->believe(w);
    if (!w.separate && !std::isnan(w.apart)) parts_->separate(w);
    if (w.story.lift_last > w.story.lift_first)
      parts_->add(w, w.story.lift_last, "lift-off", w.lift_place,
                  "last local opening while the pair touches elsewhere");
    if (w.story.open && !std::isnan(w.parted))
      for (const int side : {0, 1}) parts_->look_for_ricochet(w, side);
  }
}

const std::vector<Event>& EventWatch::events() const { return parts_->events; }

std::vector<Event> EventWatch::take_news() { return std::exchange(parts_->news, {}); }

void EventWatch::pack(parallel::Bytes& bytes) const {
  parallel::ArchiveWriter archive(bytes);
  archive(parts_->pairs, parts_->events, parts_->news);
}

void EventWatch::unpack(parallel::Unpacker& from) {
  parallel::ArchiveReader archive(from);
  std::vector<Watched> pairs;
  archive(pairs, parts_->events, parts_->news);
  require(pairs.size() == parts_->pairs.size(), "a checkpoint of other bodies");
  for (std::size_t k = 0; k < pairs.size(); ++k)
    pairs[k].a = parts_->pairs[k].a, pairs[k].b = parts_->pairs[k].b, pairs[k].hold = parts_->pairs[k].hold;
  parts_->pairs = std::move(pairs);
}

std::vector<PairStory> EventWatch::stories() const {
  std::vector<PairStory> all;
  for (const Watched& w : parts_->pairs) all.push_back(w.story);
  return all;
}

}  // namespace recoil
