#pragma once
// The compensation table as register words (docs/register-map.md, "Words of the table"). Words hold compensations
// (-error) in single precision; sensors by number in the profile's order, 0 = ambient.

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/compensation/model_table.h"
#include "core/controller/profile.h"

namespace zerodrift::controller {

/// limit_exceeded when it does not fit into `capacity` registers; channel_missing when the machine lacks a sensor.
Result<std::vector<std::uint16_t>> encode_table(const compensation::Table& table, const Profile& profile,
                                                int capacity = 2000);
/// wrong_format when the words are not a table. An empty list of words is the empty table.
Result<compensation::Table> decode_table(std::span<const std::uint16_t> words, const Profile& profile);
/// Name and limits that a table for this machine gets.
compensation::ModelTableOptions table_options(const Profile& profile);
std::uint32_t crc_of_words(std::span<const std::uint16_t> words);

}  // namespace zerodrift::controller
