// The readers of core, asked by tests about many documents in one process: a line {"kind": ..., "document": ...} in,
// the sentence with which the reader refuses it out, an empty line where it takes it.

#include <iostream>
#include <string>

#include "app/text/error_text.h"
#include "core/controller/profile.h"
#include "core/physics/machine.h"
#include "core/recording/import/header_map.h"

namespace {

using nlohmann::json;
using zerodrift::Error;

std::string refusal(const std::string& kind, const json& document) {
  const std::string file = "document.json";
  std::vector<std::string> warnings;
  const auto sentence = [](const auto& read) {
    return read ? std::string() : zerodrift::lineOf(read.error()).toStdString();
  };
  if (kind == "machine") return sentence(zerodrift::physics::machine_from_json(document, file, &warnings));
  if (kind == "profile") return sentence(zerodrift::controller::profile_from_json(document, file, &warnings));
  if (kind == "header-map") return sentence(zerodrift::recording::header_map_from_json(document, file, &warnings));
  std::cerr << "no reader of kind " << kind << '\n';
  std::exit(2);
}

}  // namespace

int main() {
  for (std::string line; std::getline(std::cin, line);) {
    const json asked = json::parse(line);
    std::cout << refusal(asked.at("kind"), asked.at("document")) << std::endl;
  }
  return 0;
}
