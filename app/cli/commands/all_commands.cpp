#include "app/cli/command.h"

namespace zerodrift::cli {

// void add_<command>(Cli& cli);
void add_access(Cli& cli);
void add_axis_table(Cli& cli);
void add_compensate(Cli& cli);
void add_compensation(Cli& cli);
void add_export(Cli& cli);
void add_import(Cli& cli);
void add_machine_check(Cli& cli);
void add_machine_table(Cli& cli);
void add_table(Cli& cli);
void add_calibrate(Cli& cli);
void add_camera(Cli& cli);
void add_bundle(Cli& cli);
void add_cluster(Cli& cli);
void add_commission(Cli& cli);
void add_record(Cli& cli);
void add_recording(Cli& cli);
void add_report(Cli& cli);
void add_verify(Cli& cli);
void add_predict(Cli& cli);
void add_fit(Cli& cli);
void add_locate(Cli& cli);
void add_diagnose(Cli& cli);
void add_place(Cli& cli);
void add_prove(Cli& cli);
void add_simulate(Cli& cli);

void add_all_commands(Cli& cli) {
  add_access(cli);
  add_axis_table(cli);
  add_compensate(cli);
  add_compensation(cli);
  add_export(cli);
  add_import(cli);
  add_machine_check(cli);
  add_machine_table(cli);
  add_table(cli);
  add_calibrate(cli);
  add_camera(cli);
  add_bundle(cli);
  add_cluster(cli);
  add_commission(cli);
  add_record(cli);
  add_recording(cli);
  add_report(cli);
  add_verify(cli);
  add_predict(cli);
  add_fit(cli);
  add_locate(cli);
  add_diagnose(cli);
  add_place(cli);
  add_prove(cli);
  add_simulate(cli);
}

}  // namespace zerodrift::cli
