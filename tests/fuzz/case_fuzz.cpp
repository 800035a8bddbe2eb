// A case file of any bytes: it is read, or every mistake is reported; nothing else may happen.

#include <cstddef>
#include <cstdint>
#include <string>

#include "config/diagnostics.hpp"
#include "config/document.hpp"
#include "config/read_case.hpp"
#include "core/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace recoil;
  config::Diagnostics found;
  const config::Document document =
      config::parse_document(std::string(reinterpret_cast<const char*>(data), size), "case.toml", found);
  config::read_case(document, found);
  require(document.complete || found.has_errors(), "what cannot be read is reported");
  require(found.list().empty() == found.text().empty(), "every message can be shown");
  return 0;
}
