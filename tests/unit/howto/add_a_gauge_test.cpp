// What docs/how-to/add-a-gauge.md shows, compiled and tried. Its blocks of C++ stand here word for word.
#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

#include "../support/small_case.hpp"
#include "config/declare/common_keys.hpp"
#include "config/declare/kinds.hpp"
#include "gauge/gauge_watch.hpp"

namespace recoil::config {

struct EnergyGauge {
  std::string body;
  double every = 0;  // s; 0: every step

  static constexpr const char* kind = "energy";
  static constexpr const char* doc = "The energy of a whole body.";
  static Entries<EnergyGauge> keys() {
    return {body_key("body", &EnergyGauge::body, watched_body), every_key(&EnergyGauge::every, every_record)};
  }
  static std::vector<Column> columns() {
    return {{"total", "energy", "kinetic and internal"}, {"kinetic-part", "1", "of the total"}};
  }
};

}  // namespace recoil::config

namespace recoil {

namespace {

template <int Dim>
class EnergyWatch : public GaugeWatch<Dim> {
 public:
  EnergyWatch(const config::EnergyGauge& from, const WatchSetup<Dim>& setup)
      : body_(body_number(setup.state, from.body)) {}

  bool needs_totals() const override { return true; }
  void read(const GaugeReading<Dim>& reading, std::vector<double>& row) override {
    const BodyTotals<Dim>& b = reading.totals->bodies[body_];
    row.push_back(reading.units.whole * b.energy);
    row.push_back(b.energy > 0 ? b.kinetic / b.energy : nothing);
  }

 private:
  int body_;
};

}  // namespace

RECOIL_WATCH(config::EnergyGauge, EnergyWatch)

namespace {

const char* flying = R"(
[domain]
geometry = "1d"
x = ["0 mm", "20 mm"]
[mesh]
finest = "0.1 mm"
[time]
end = "1 us"
[body.rod]
material = "none"
shape = { kind = "box", x = ["5 mm", "10 mm"] }
velocity = { x = "100 m/s" }
)";

TEST(HowToAddAGauge, TheGaugeIsReadAndRecords) {
  config::Diagnostics out;
  const config::Document document =
      config::parse_document("[gauge.e]\nkind = \"energy\"\nbody = \"rod\"\n", "case.toml", out);
  std::variant<config::PointGauge, config::EnergyGauge> kind;
  config::CaseReading in{config::Geometry::line, {"x"}, out};
  in.bodies = {"rod"};
  config::read_kind(*document.find("gauge.e"), kind, "gauge", "what it records", in);
  ASSERT_EQ(out.text(), "");

  const config::Case c = case_from(flying);
  const State<1> state = state_of<1>(c);
  const parallel::World world;
  ExactSums sums;
  const RunUnits units = run_units(c.domain.geometry);
  const auto& gauge = std::get<config::EnergyGauge>(kind);
  const auto watch = make_watch<1>(gauge, WatchSetup<1>{c, state, sums});
  const Totals<1> totals = find_totals(state, world);
  std::vector<double> row;
  watch->read({0, 0, sums, {}, &totals, units}, row);
  ASSERT_EQ(row.size(), column_list(gauge.columns(), units).size());
  EXPECT_NEAR(row[0], 0.5 * 1000 * 5e-3 * 100 * 100, 1e-9 * row[0]) << "J/m2";
  EXPECT_EQ(row[1], 1);
}

}  // namespace
}  // namespace recoil
