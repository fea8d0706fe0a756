#pragma once
// Lists of registers as PLC projects give them, row by row: column names in English, German and Chinese, addresses as
// plain numbers, Modicon's (40011, 400011, 4x00011) or %MW10, elements of arrays in any order. A column that could
// change a value and is not understood is an error that names it; every other one is listed.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace zerodrift::controller {

/// The document of a register map; `base`: what the first register is called where addresses are plain numbers, -1 for
/// as the list says, else 0.
Result<nlohmann::json> register_list_to_json(std::string_view bytes, const std::string& file, int base,
                                             std::vector<std::string>* warnings);

}  // namespace zerodrift::controller
