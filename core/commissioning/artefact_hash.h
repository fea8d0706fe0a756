#pragma once
// What makes two artefacts equal. Inside core/commissioning only.

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace zerodrift::commissioning {

/// SHA-256 of kind, body (without the observed keys) and the blobs' own hashes by name.
std::string content_hash_of(std::string_view kind, std::string_view body, const std::vector<std::string>& observed,
                            const std::map<std::string, std::string>& blob_hashes);
std::string text_of_keys(const std::vector<std::string>& keys);
std::vector<std::string> keys_from(const std::string& text);

}  // namespace zerodrift::commissioning
