#include "config/gauge/gauge.hpp"

#include "config/declare/kinds.hpp"

namespace recoil::config {

namespace {

constexpr const char* kind_doc = "what it records";

}  // namespace

std::vector<Column> written_columns(const Gauge& gauge) {
  return std::visit(
      [](const auto& kind) {
        std::vector<Column> columns = kind.columns();
        if constexpr (requires { kind.switched_off(); }) columns.resize(columns.size() - kind.switched_off());
        return columns;
      },
      gauge.kind);
}

void read_gauges(const Node& table, std::vector<Gauge>& gauges, const CaseReading& in) {
  for (const Node& node : table.children) {
    if (!check_is_table(node, "gauge", in.out) || !check_name(node, "gauge", in.out)) continue;
    Gauge& gauge = gauges.emplace_back();
    gauge.name = node.key;
    gauge.place = node.key_place;
    read_kind(node, gauge.kind, "gauge", kind_doc, in);
  }
}

void add_gauge_sections(const std::string& path, std::vector<Section>& all) {
  add_kind_sections<GaugeKind>(path, kind_doc, all);
}

}  // namespace recoil::config
