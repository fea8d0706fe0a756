#pragma once
// What makes two artefacts equal. Inside core/commissioning only.

#include <map>
#include <string>
#include <string_view>

namespace zerodrift::commissioning {

/// SHA-256 of kind, body and the blobs' own hashes by name.
std::string content_hash_of(std::string_view kind, std::string_view body,
                            const std::map<std::string, std::string>& blob_hashes);

}  // namespace zerodrift::commissioning
