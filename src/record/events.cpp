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
constexpr double touching_part = 0.5;    // of the largest area so far
constexpr double least_reversal = 1e-3;  // of the speed before contact, below which a reversal is noise

double dot(const Three& a, const Three& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// One pair under observation.
struct Watched {
  std::size_t a = 0, b = 0;
  PairStory story;
  double largest = 0;
  int steps_apart = 0;
  double parted = never;           // s, when the parting on trial or the last one began
  std::vector<double> place;       // m, mean, while they last touched
  std::vector<double> lift_place;  // m, of the last lift-off
  Three impulse_parted{};
  std::array<Three, 2> velocity_made{}, velocity_parted{};  // m/s

  template <class Archive>
  void transfer(Archive& a) {
    a(story, largest, steps_apart, parted, place, lift_place, impulse_parted, velocity_made, velocity_parted);
  }
};

}  // namespace

struct EventWatch::Parts {
  std::vector<std::string> names;
  int dim = 1;
  std::array<bool, 3> sided{};  // axes along which other things than contact push too
  std::vector<Watched> pairs;
  std::vector<BodyMotion> start;
  std::vector<Event> events, news;

  void add(const Watched& w, double time, const char* kind, std::vector<double> place, std::string detail) {
    Event e{time, kind, w.story.first + "-" + w.story.second, std::move(place), std::move(detail)};
    const auto later = std::upper_bound(events.begin(), events.end(), time,
                                        [](double t, const Event& other) { return t < other.time; });
    news.push_back(e);
    events.insert(later, std::move(e));
  }

  /// Mean velocity of a body [m/s], from its start and the impulses of all its contacts.
  Three velocity_of(std::size_t body, const std::vector<PairSample>& samples) const {
    if (body >= start.size()) return {};
    if (!(start[body].mass > 0)) return start[body].velocity;
    Three p = start[body].momentum;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const double sign = pairs[k].a == body ? 1 : pairs[k].b == body ? -1 : 0;
      for (std::size_t d = 0; d < 3; ++d) p[d] += sign * samples[k].impulse[d];
    }
    for (double& c : p) c /= start[body].mass;
    return p;
  }

  std::string velocity_text(std::size_t body, const Three& v) const {
    if (body >= start.size() || !(start[body].mass > 0)) return {};
    std::vector<std::string> shown;
    for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d)
      shown.push_back(sided[d] ? "-" : fmt::format("{:.5g}", v[d]));
    return fmt::format("{} {} m/s", names[body], fmt::join(shown, " "));
  }

  std::string motion_text(const Watched& w, const std::array<Three, 2>& v) const {
    const std::string first = velocity_text(w.a, v[0]), second = velocity_text(w.b, v[1]);
    return first + (first.empty() || second.empty() ? "" : ", ") + second;
  }

  void touch(Watched& w, double time, double dt, const PairSample& s, const std::vector<PairSample>& all) {
    w.place.assign(s.place.begin(), s.place.begin() + dim);
    for (double& x : w.place) x /= s.area;
    w.steps_apart = 0;
    if (!w.story.open) return;
    w.story.open = false;
    const bool first = std::isnan(w.story.made);
    if (first) {
      w.story.made = time - dt;
      for (std::size_t k = 0; k < 2; ++k) w.velocity_made[k] = velocity_before(k == 0 ? w.a : w.b, all, w);
    } else {
      if (!w.story.recloses) w.story.closes_again = time - dt;
      w.story.recloses = true;
    }
    add(w, time - dt, first ? "contact" : "reclosure", w.place, {});
  }

  /// At the start of the step in which a pair first touches its own impulse is not yet counted.
  Three velocity_before(std::size_t body, std::vector<PairSample> all, const Watched& w) const {
    for (std::size_t k = 0; k < pairs.size(); ++k)
      if (&pairs[k] == &w) all[k].impulse = {};
    return velocity_of(body, all);
  }

  void stay_apart(Watched& w, double time, double dt, const PairSample& s,
                  const std::vector<PairSample>& all) {
    if (w.story.open) return;
    if (w.steps_apart++ == 0) {
      w.parted = time - dt;
      w.impulse_parted = s.impulse;
      w.velocity_parted[0] = velocity_of(w.a, all);
      w.velocity_parted[1] = velocity_of(w.b, all);
    }
    if (w.steps_apart >= opening_steps) believe(w);
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

  /// Newton's coefficient of restitution. Axes along which other things push do not count.
  double restitution_of(const Watched& w) const {
    double before = 0, after = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double n = sided[d] ? 0 : w.impulse_parted[d];
      before += n * (w.velocity_made[0][d] - w.velocity_made[1][d]);
      after += n * (w.velocity_parted[0][d] - w.velocity_parted[1][d]);
    }
    return before < 0 ? -after / before : never;
  }

  /// Whether a body that moved towards its partner now moves away from it. Across a plane of symmetry the
  /// plane pushes as well, which the contacts do not tell, so that axis does not count. Off the axis of an
  /// axisymmetric domain momentum has no direction, so only the axial part counts there.
  void look_for_ricochet(const Watched& w, int side) {
    Three n = w.impulse_parted;  // on the first body: away from the second
    for (std::size_t d = 0; d < 3; ++d)
      if (sided[d]) n[d] = 0;
    const double size = std::sqrt(dot(n, n)), away = side == 0 ? 1 : -1;
    const std::size_t body = side == 0 ? w.a : w.b;
    if (!(size > 0) || body >= start.size() || !(start[body].mass > 0)) return;
    const double before = away * dot(w.velocity_made[side], n) / size,
                 after = away * dot(w.velocity_parted[side], n) / size;
    const double least = least_reversal * std::sqrt(dot(w.velocity_made[side], w.velocity_made[side]));
    if (!(before < -least) || !(after > least)) return;
    add(w, w.parted, "ricochet", w.place,
        fmt::format("{}: {:.5g} m/s towards {} before, {:.5g} m/s away after", names[body], -before,
                    names[side == 0 ? w.b : w.a], after));
  }
};

EventWatch::EventWatch(std::vector<std::string> names, config::Geometry geometry, std::array<bool, 3> sided)
    : parts_(std::make_unique<Parts>()) {
  Parts& p = *parts_;
  p.names = std::move(names);
  p.dim = config::dimension(geometry);
  p.sided = sided;
  if (geometry == config::Geometry::axisymmetric) p.sided[0] = true;
  const std::size_t n = p.names.size();
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b) {
      Watched w;
      w.a = a, w.b = b;
      w.story.first = p.names[a], w.story.second = p.names[b];
      w.story.made = w.story.opens = w.story.lift_first = w.story.lift_last = never;
      w.story.closes_again = w.story.opens_again = w.story.restitution = never;
      p.pairs.push_back(std::move(w));
    }
}

EventWatch::~EventWatch() = default;
EventWatch::EventWatch(EventWatch&&) noexcept = default;

void EventWatch::begin(const std::vector<BodyMotion>& start) { parts_->start = start; }

void EventWatch::step(double time, double dt, const std::vector<PairSample>& samples) {
  Parts& p = *parts_;
  for (std::size_t k = 0; k < p.pairs.size(); ++k) {
    Watched& w = p.pairs[k];
    const PairSample& s = samples[k];
    w.largest = std::max(w.largest, s.area);
    const bool touching = s.area > 0 && (p.dim == 1 || s.area >= touching_part * w.largest);
    if (touching)
      p.touch(w, time, dt, s, samples);
    else
      p.stay_apart(w, time, dt, s, samples);
  }
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

void EventWatch::finish() {
  for (Watched& w : parts_->pairs) {
    if (!w.story.open && w.steps_apart > 0) parts_->believe(w);
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
  archive(parts_->pairs, parts_->start, parts_->events, parts_->news);
}

void EventWatch::unpack(parallel::Unpacker& from) {
  parallel::ArchiveReader archive(from);
  std::vector<Watched> pairs;
  archive(pairs, parts_->start, parts_->events, parts_->news);
  require(pairs.size() == parts_->pairs.size(), "a checkpoint of other bodies");
  for (std::size_t k = 0; k < pairs.size(); ++k)
    pairs[k].a = parts_->pairs[k].a, pairs[k].b = parts_->pairs[k].b;
  parts_->pairs = std::move(pairs);
}

std::vector<PairStory> EventWatch::stories() const {
  std::vector<PairStory> all;
  for (const Watched& w : parts_->pairs) all.push_back(w.story);
  return all;
}

}  // namespace recoil
