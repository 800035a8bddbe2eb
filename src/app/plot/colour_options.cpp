#include "app/plot/colour_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/plot/plot_file.hpp"
#include "core/error.hpp"

namespace recoil::app {

ColourChoice chosen_colours(const std::vector<double>& shown, std::string& label,
                            const std::vector<Category>& categories, bool signed_values,
                            const PlotOptions& o) {
  ColourChoice choice;
  choice.categories = categories;
  if (!categories.empty()) {
    if (o.log || !o.lowest.empty() || !o.highest.empty())
      throw InputError("--min, --max and --log do not apply to a field of names\n   = help: omit them");
    return choice;
  }
  Range values;
  for (const double v : shown) values.include(v, o.log);
  choice.log = o.log;
  const Spread spread = spread_of(o, label, values, RoundOff::of_dumps);
  choice.range = shown_range(o, label, values, spread, signed_values);
  if (spread != Spread::real) label = noted(label, spread);
  const double lo = choice.range ? choice.range->first : values.lo;
  const double hi = choice.range ? choice.range->second : values.hi;
  if (signed_values && !o.log && lo < 0 && (hi > 0 || !choice.range)) choice.map = ColourMap::diverging;
  return choice;
}

void choose_colours(FieldPicture& picture, bool signed_values, const PlotOptions& o) {
  const ColourChoice choice =
      chosen_colours(picture.values, picture.label, picture.categories, signed_values, o);
  picture.map = choice.map;
  picture.log = choice.log;
  picture.range = choice.range;
}

void hold_limits(PlotOptions& o, const std::string& label, Range values) {
  if (!(values.lo < values.hi) || spread_of(o, label, values, RoundOff::of_dumps) != Spread::real) return;
  if (o.log) values.lo = std::max(values.lo, 1e-6 * values.hi);
  if (o.lowest.empty()) o.lowest = fmt::format("{:.17g}", values.lo);
  if (o.highest.empty()) o.highest = fmt::format("{:.17g}", values.hi);
}

}  // namespace recoil::app
