#pragma once
// The house's rules, read from the #include lines: who may see whom, and which folder owns which library.

#include <filesystem>
#include <string>
#include <vector>

namespace zerodrift::architecture {

struct Violation {
  std::string file;  // relative to the root
  int line = 0;
  std::string rule;
};

/// Rules for one include found in one file; paths relative to the repository's root, '/' as separator.
std::vector<std::string> broken_rules(const std::string& file, const std::string& include);
/// Reads every .h and .cpp under core, ui and app.
std::vector<Violation> check_tree(const std::filesystem::path& root);

}  // namespace zerodrift::architecture
