#include "gauge/kind/contact_gauge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "gauge/gauge_watch.hpp"
#include "gauge/periods.hpp"
#include "state/contact_sums.hpp"

namespace recoil {

template <int Dim>
void probe_contact(const State<Dim>& state, int pair, const Vec<Dim>& at, double radius, int item,
                   ExactSums& sums) {
  using A = ContactSums<Dim>;
  const SumRow row = sums.add(item);
  for (int slot = 0; slot < state.mesh.local(); ++slot) {
    for (const Contact<Dim>& c : state.contacts[slot]) {
      const int lower = std::min(c.first, c.second), higher = std::max(c.first, c.second);
      if (!counts(state, c) || pair_number(lower, higher, state.count()) != pair) continue;
      if (radius > 0 && norm(shortest_way(state.grid(), c.point, at)) > radius) continue;
      const double sign = c.first == lower ? 1 : -1, gap = c.gap / state.grid().dx;
      const Vec<Dim> force = force_on_lower(c), shear = (sign * c.area) * c.shear;
      row[A::area] += c.area;
      row[A::traction] += c.traction * c.area;
      row[A::square] += c.traction * c.traction * c.area;
      row[A::velocity] += c.work_velocity * c.area;
      row[A::gap] += c.gap * c.area;
      row[A::power] += power_to_lower(c);
      for (int d = 0; d < Dim; ++d) {
        const auto k = static_cast<std::size_t>(d);
        row[A::force + k] += force[d];
        row[A::shear + k] += shear[d];
      }
      row.raise(A::widest, gap);
      row.raise(A::deepest, -gap);
    }
  }
}

namespace {

/// Root mean square over the area of the traction's departure from its mean.
template <int Dim>
double scatter(std::span<const double> now) {
  using A = ContactSums<Dim>;
  const double mean = now[A::traction] / now[A::area];
  return std::sqrt(std::max(0.0, now[A::square] / now[A::area] - mean * mean));
}

template <int Dim>
class ContactWatch : public GaugeWatch<Dim> {
 public:
  ContactWatch(const config::ContactGauge& from, const WatchSetup<Dim>& setup)
      : dx_(setup.state.grid().dx),
        at_(first_components<Dim>(from.at)),
        radius_(from.radius),
        direction_(first_components<Dim>(from.direction)) {
    const int a = body_number(setup.state, from.pair[0]), b = body_number(setup.state, from.pair[1]);
    const int lower = std::min(a, b);
    turned_ = a > b;
    // Records follow the normal out of the lower-numbered body, or out of the deformable one of a rigid pair.
    outward_ = turned_ != setup.state.bodies[lower].rigid.has_value() ? -1 : 1;
    pair_ = pair_number(lower, std::max(a, b), setup.state.count());
    item_ = setup.sums.item(ContactSums<Dim>::sums, 2);
  }

  bool follows_every_step() const override { return true; }
  void collect(const State<Dim>& state, const parallel::World& /*world*/, bool at_rest,
               ExactSums& sums) override {
    if (!at_rest) probe_contact(state, pair_, at_, radius_, item_, sums);
  }
  void follow(const ExactSums& sums, double dt) override;
  void read(const GaugeReading<Dim>& reading, std::vector<double>& row) override;
  void pack(parallel::Bytes& bytes) const override {
    parallel::pack(bytes, part_);
    parallel::pack(bytes, std::array{normal_impulse_, tangential_impulse_});
  }
  void unpack(parallel::Unpacker& bytes) override {
    part_ = bytes.read<PairSample>();
    const auto impulses = bytes.read<std::array<double, 2>>();
    normal_impulse_ = impulses[0], tangential_impulse_ = impulses[1];
  }

 private:
  double along(const std::array<double, 3>& v) const {
    double sum = 0;
    for (int d = 0; d < Dim; ++d) sum += direction_[d] * v[d];
    return sum;
  }

  int item_ = 0, pair_ = 0;
  bool turned_ = false;        // the pair is named the other way round
  double outward_ = 1;         // -1: the contact's normal points out of the second named body
  double dx_;                  // m
  Vec<Dim> at_;                // m
  double radius_;              // m, of the part of the contact that counts; 0: all
  Vec<Dim> direction_;         // or zero
  PairSample part_;            // of that part, when it is not all
  double normal_impulse_ = 0;  // since the start
  double tangential_impulse_ = 0;
};

template <int Dim>
void ContactWatch<Dim>::follow(const ExactSums& sums, double dt) {
  using A = ContactSums<Dim>;
  const std::span<const double> now = sums.total(item_);
  double shear = 0;
  for (std::size_t d = 0; d < Dim; ++d) shear += now[A::shear + d] * now[A::shear + d];
  normal_impulse_ -= dt * now[A::traction];
  tangential_impulse_ += dt * std::sqrt(shear);
  PairSample& p = part_;
  p.area = now[A::area], p.traction = now[A::traction], p.velocity = now[A::velocity], p.gap = now[A::gap];
  p.work += dt * now[A::power];
  for (std::size_t d = 0; d < Dim; ++d) {
    p.force[d] = now[A::force + d];
    p.impulse[d] += dt * p.force[d];
  }
  p.widest_gap = std::max(now[A::widest], 0.0);
  p.deepest_overlap = -std::max(now[A::deepest], 0.0);
}

template <int Dim>
void ContactWatch<Dim>::read(const GaugeReading<Dim>& reading, std::vector<double>& row) {
  using A = ContactSums<Dim>;
  const PairSample& p = radius_ > 0 ? part_ : reading.pairs[pair_];
  const double whole = reading.units.whole, sign = whole * (turned_ ? -1 : 1);
  const bool touching = p.area > 0;
  row.push_back(touching ? p.traction / p.area : 0);
  row.push_back(touching ? outward_ * p.velocity / p.area : nothing);
  row.push_back(whole * p.area);
  row.push_back(touching ? p.gap / p.area : nothing);
  for (const double edge : {dx_, 1.0}) {
    row.push_back(touching ? edge * p.widest_gap : nothing);
    row.push_back(touching ? edge * p.deepest_overlap : nothing);
  }
  for (std::size_t d = 0; d < Dim; ++d) row.push_back(sign * p.force[d]);
  for (std::size_t d = 0; d < Dim; ++d) row.push_back(sign * p.impulse[d]);
  row.push_back(sign * p.work);
  const std::span<const double> now = reading.sums.total(item_);
  double shear = 0;
  for (std::size_t d = 0; d < Dim; ++d) shear += now[A::shear + d] * now[A::shear + d];
  row.insert(row.end(), {whole * -now[A::traction], whole * std::sqrt(shear), whole * normal_impulse_,
                         whole * tangential_impulse_});
  row.push_back(normal_impulse_ > 0 ? tangential_impulse_ / normal_impulse_ : nothing);
  row.push_back(touching ? scatter<Dim>(now) : nothing);
  if (direction_ == Vec<Dim>{}) return;
  row.push_back(sign * along(p.force));
  row.push_back(sign * along(p.impulse));
}

}  // namespace

template void probe_contact<1>(const State<1>&, int, const Vec<1>&, double, int, ExactSums&);
template void probe_contact<2>(const State<2>&, int, const Vec<2>&, double, int, ExactSums&);
template void probe_contact<3>(const State<3>&, int, const Vec<3>&, double, int, ExactSums&);

RECOIL_WATCH(config::ContactGauge, ContactWatch)

}  // namespace recoil
