#pragma once

#include <string>
#include <variant>
#include <vector>

#include "config/diagnostics.hpp"
#include "config/gauge/attitude.hpp"
#include "config/gauge/bar.hpp"
#include "config/gauge/body.hpp"
#include "config/gauge/contact.hpp"
#include "config/gauge/crater.hpp"
#include "config/gauge/fragments.hpp"
#include "config/gauge/peak_stress.hpp"
#include "config/gauge/peak_tension.hpp"
#include "config/gauge/point.hpp"
#include "config/gauge/pullback.hpp"
#include "config/gauge/residual.hpp"
#include "config/gauge/surface_velocity.hpp"

namespace recoil::config {

/// Every kind of gauge, in the order of help. Each declares its keys and columns; what it does stands in
/// src/gauge/kind/NAME_gauge.cpp.
using GaugeKind = std::variant<SurfaceVelocityGauge, PointGauge, BodyGauge, ContactGauge, BarGauge,
                               AttitudeGauge, PeakStressGauge, PullbackGauge, FragmentsGauge,
                               PeakTensionGauge, CraterGauge, ResidualGauge>;

/// A record over time, written to gauges/NAME.csv.
struct Gauge {
  std::string name;
  GaugeKind kind;
  Place place = {};
};

/// The columns that a gauge writes as it is set: those of its kind, without any that one of its keys switches
/// on.
std::vector<Column> written_columns(const Gauge& gauge);

/// Reads every [gauge.NAME] below the table `gauge`.
void read_gauges(const Node& table, std::vector<Gauge>& gauges, const CaseReading& in);
void add_gauge_sections(const std::string& path, std::vector<Section>& all);

}  // namespace recoil::config
