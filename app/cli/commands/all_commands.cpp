#include "app/cli/command.h"

namespace zerodrift::cli {

// void add_<command>(Cli& cli);
void add_calibrate(Cli& cli);
void add_cluster(Cli& cli);
void add_commission(Cli& cli);
void add_record(Cli& cli);
void add_report(Cli& cli);
void add_verify(Cli& cli);
void add_predict(Cli& cli);
void add_fit(Cli& cli);
void add_locate(Cli& cli);
void add_place(Cli& cli);
void add_simulate(Cli& cli);

void add_all_commands(Cli& cli) {
  add_calibrate(cli);
  add_cluster(cli);
  add_commission(cli);
  add_record(cli);
  add_report(cli);
  add_verify(cli);
  add_predict(cli);
  add_fit(cli);
  add_locate(cli);
  add_place(cli);
  add_simulate(cli);
}

}  // namespace zerodrift::cli
