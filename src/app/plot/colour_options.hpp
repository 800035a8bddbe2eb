#pragma once

#include <string>
#include <vector>

#include "app/commands.hpp"
#include "picture/axis.hpp"
#include "picture/colour_key.hpp"
#include "picture/field_picture.hpp"

namespace recoil::app {

/// Colours by the options; zero in the middle of them where values have both signs.
/// @param label with the unit, "pressure [GPa]"; says afterwards where the values are round-off only, or
/// all the same. @throws InputError.
ColourChoice chosen_colours(const std::vector<double>& values, std::string& label,
                            const std::vector<Category>& categories, bool signed_values,
                            const PlotOptions& options);

/// The same for a picture of the plane.
void choose_colours(FieldPicture& picture, bool signed_values, const PlotOptions& options);

/// Makes the ends of the values --min and --max, where the options name none, and they are no noise.
void hold_limits(PlotOptions& options, const std::string& label, Range values);

}  // namespace recoil::app
