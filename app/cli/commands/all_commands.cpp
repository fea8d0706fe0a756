#include "app/cli/command.h"

namespace zerodrift::cli {

// void add_<command>(Cli& cli);
void add_cluster(Cli& cli);

void add_all_commands(Cli& cli) {
  add_cluster(cli);
}

}  // namespace zerodrift::cli
