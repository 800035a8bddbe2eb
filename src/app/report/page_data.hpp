#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace recoil::app {

using Json = nlohmann::ordered_json;

/// JSON has no NaN: null.
inline Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

/// The packed numbers of a page, one text after another; its JSON says where each begins and how long it is.
class Blocks {
 public:
  /// @returns [begin, length]
  Json add(const std::string& packed) {
    Json place = {text_.size(), packed.size()};
    text_ += packed;
    return place;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace recoil::app
