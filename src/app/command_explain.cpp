#include <fmt/format.h>

#include <string>

#include "app/commands.hpp"
#include "config/schema.hpp"
#include "material/library.hpp"

namespace recoil::app {

int print_schema(bool markdown) {
  fmt::print("{}", markdown ? config::reference_page(material_sections())
                            : config::json_schema(material_sections()));
  return 0;
}

int explain(const std::string& key) {
  fmt::print("{}", config::explain(key, material_sections()));
  return 0;
}

}  // namespace recoil::app
