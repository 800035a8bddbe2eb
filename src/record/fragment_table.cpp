#include "record/fragment_table.hpp"

#include <cstddef>
#include <utility>

#include "core/nothing.hpp"
#include "record/resumed_table.hpp"

namespace recoil {

template <int Dim>
FragmentTable<Dim>::FragmentTable(std::vector<std::string> names, std::vector<bool> rigid,
                                  const RunUnits& units)
    : names_(std::move(names)), rigid_(std::move(rigid)), units_(units) {
  begin_telling();
}

template <int Dim>
void FragmentTable<Dim>::begin_telling() {
  last_.clear();
  for (std::size_t m = 0; m < names_.size(); ++m) {
    if (rigid_[m]) continue;
    BodyFragments& b = last_.emplace_back();
    b.body = names_[m];
    b.heaviest.assign(BodyFragments::told, {nothing, std::vector<double>(Dim, nothing)});
  }
}

template <int Dim>
void FragmentTable<Dim>::open(const std::filesystem::path& path, CsvMode mode, double last) {
  std::vector<std::string> columns{"time [us]", "fragment", "body", "kind"};
  const auto add = [&](const std::string& name, const std::string& unit) {
    columns.push_back(name + " [" + unit + "]");
  };
  const auto add_vector = [&](const std::string& name, const std::string& unit) {
    for (const std::string& axis : units_.axes) add(name + "." + axis, unit);
  };
  add("mass", units_.mass);
  add("failed-mass", units_.mass);
  add("volume", units_.volume);
  add_vector("position", "mm");
  add_vector("velocity", "m/s");
  add("kinetic", units_.energy);
  add_vector("lowest", "mm");
  add_vector("highest", "mm");
  add("diameter", "mm");
  columns.emplace_back("cells");
  if (mode == CsvMode::append) {
    std::size_t told = 0;
    for (const BodyFragments& b : last_) told += static_cast<std::size_t>(b.pieces + b.heaps);
    if (told > 0) cut_back(path, last, told);
    if (told == 0 && std::filesystem::exists(path)) truncate_csv(path, last * 1e6);
  }
  file_.emplace(path, columns, std::vector<std::string>{}, mode);
}

template <int Dim>
void FragmentTable<Dim>::tell(const Fragment<Dim>& f) {
  for (BodyFragments& b : last_) {
    if (b.body != names_[static_cast<std::size_t>(f.body)]) continue;
    if (!f.piece) {
      ++b.heaps;
      b.rubble += units_.whole * f.mass;
      continue;
    }
    const auto place = static_cast<std::size_t>(b.pieces++);
    if (place < b.heaviest.size())
      b.heaviest[place] = {units_.whole * f.mass, {f.velocity.c.begin(), f.velocity.c.end()}};
  }
}

template <int Dim>
void FragmentTable<Dim>::write(const Fragments<Dim>& fragments, double time) {
  begin_telling();
  double number = 0;
  std::vector<CsvCell> row;
  for (const Fragment<Dim>& f : fragments.list) {
    tell(f);
    const auto add_vector = [&](const Vec<Dim>& v, double scale) {
      for (int d = 0; d < Dim; ++d) row.emplace_back(scale * v[d] + 0.0);  // no -0 in files
    };
    row.assign({time * 1e6, ++number, names_[static_cast<std::size_t>(f.body)],
                std::string(f.piece ? "piece" : "rubble"), units_.whole * f.mass, units_.whole * f.failed,
                units_.whole * f.volume});
    add_vector(f.position, 1e3);
    add_vector(f.velocity, 1);
    row.emplace_back(units_.whole * f.kinetic);
    add_vector(f.lowest, 1e3);
    add_vector(f.highest, 1e3);
    row.emplace_back(f.diameter * 1e3);
    row.emplace_back(static_cast<double>(f.cells));
    file_->row(row);
  }
  file_->flush();
}

template class FragmentTable<1>;
template class FragmentTable<2>;
template class FragmentTable<3>;

}  // namespace recoil
