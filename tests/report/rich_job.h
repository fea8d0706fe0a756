#pragma once
// A job in which every section of the report has something to say; its figures are made up and easy to recognise.

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "core/commissioning/job.h"

namespace zerodrift::report {

class RichJob {
 public:
  explicit RichJob(const commissioning::JobHeader& header) {
    m_folder = std::filesystem::temp_directory_path() / ("zd_rich_" + std::to_string(::getpid()) + "_" + unique());
    std::filesystem::remove_all(m_folder);
    std::filesystem::create_directories(m_folder);
    m_job = std::make_unique<commissioning::Job>(commissioning::Job::create(m_folder / "rich.zdj", header).value());
    fill();
  }
  ~RichJob() {
    m_job.reset();
    std::filesystem::remove_all(m_folder);
  }
  RichJob(const RichJob&) = delete;
  RichJob& operator=(const RichJob&) = delete;

  commissioning::Job& job() { return *m_job; }
  std::filesystem::path folder() const { return m_folder; }

  void put(const char* kind, const nlohmann::json& body) {
    m_job->put(commissioning::NewArtefact::of(kind, body)).value();
  }

 private:
  using Json = nlohmann::json;

  static void must(const Status& done) {
    if (!done) throw std::runtime_error(describe(done.error()));
  }

  static std::string unique() {
    static int number = 0;
    return std::to_string(++number);
  }

  static Json plan() {
    return {{"name", "Warm-up, 4 h, stepped speeds"},
            {"steps",
             {{{"duration_s", 3600.0}, {"spindle_rpm", 3000.0}, {"coolant_on", true}, {"path", "cycle"}},
              {{"duration_s", 2400.0}, {"spindle_rpm", 0.0}, {"coolant_on", false}, {"path", "still"}}}}};
  }

  commissioning::SeriesId record(const char* name, double scale) {
    const auto series = m_job
                            ->start_series(name, {"spindle_rpm", "ambient_C", "T1_C", "T2_C", "dX_um", "dY_um", "dZ_um",
                                                  "A_urad", "sigma_X_nm", "sigma_Y_nm", "sigma_Z_nm"})
                            .value();
    for (int i = 0; i <= 100; ++i) {
      const double rise = 10.0 * (1.0 - std::exp(-0.03 * i));
      const std::vector<double> row = {i < 60 ? 3000.0 : 0.0,
                                       20.0 + 0.01 * i,
                                       20.0 + rise,
                                       20.5 + 0.5 * rise,
                                       -0.4 * scale * rise,
                                       i == 0 ? -0.02 : 0.1 * scale * rise,
                                       scale * 6.0 * rise,
                                       0.2 * rise,
                                       20.0,
                                       21.0,
                                       22.0 + i};
      must(m_job->append(series, 60.0 * i, row));
    }
    must(m_job->flush());
    must(m_job->add_event(series, {1200.0, "note", "door opened <b>briefly</b>", "{}", ""}));
    must(m_job->add_event(series, {1500.0, "pause", "", "{}", ""}));
    must(m_job->add_event(series, {1600.0, "problem", "sensor_stuck", "{}", ""}));
    must(m_job->finish_series(series));
    return series;
  }

  void fill() {
    machine();
    const Json sigma = {{0.0024, 0.0024}, {0.0024, 0.0024}};
    put("calibration", {{"source", "camera"},
                        {"reference_target", false},
                        {"cameras",
                         {{{"id", "front"},
                           {"axes", {"X", "Z"}},
                           {"um_per_px", 12.0},
                           {"rotation_deg", -2.29},
                           {"rms_um", 0.09},
                           {"positions", 9},
                           {"calibration", {{"sigma", sigma}, {"leave_one_out_um", 0.12}}}}}}});
    put("warmup", {{"series", record("warm-up", 1.0)},
                   {"plan", plan()},
                   {"rows", 101},
                   {"lost_samples", 3},
                   {"refused", 1},
                   {"measurements", 101},
                   {"problems",
                    {"sensor stuck (T2_C), 2 times",
                     "reference lost (camera front: reference 2: target missing; camera side: reference 2: "
                     "target occluded), once",
                     "target refused (camera front: reference 1: target missing; reference 2: target "
                     "occluded), once",
                     "link: machine_silent, 3 times, overcome"}}});
    sensors();
    model();
    physics();
    upload();
    verification(7.2, "failed");
    verification(3.1, "passed");
    axis();
    commissioning::AuditEntry entry;
    entry.machine = "VMC";
    entry.action = "upload table";
    entry.subject = "compensation table";
    entry.old_value = "version 0, 2 registers";
    entry.result = "started";
    m_job->audit(entry).value();
    entry.result = "upload_restored";
    m_job->audit(entry).value();
  }

  void machine() {
    put("machine",
        {{"identity", {{"name", "VMC"}, {"serial", 17}}},
         {"spread_K", 1.43},
         {"round_trip_ms", 140.0},
         {"clock_difference_s", -3.2},
         {"sensors_alive", 2},
         {"problems", {"sensor T2_C (Column front, top) is stuck"}},
         {"health",
          {{{"channel", "T1_C"},
            {"label", "Spindle front bearing"},
            {"value_C", 20.01},
            {"noise_K", 0.09},
            {"state", "ok"}},
           {{"channel", "T2_C"},
            {"label", "Column front, top"},
            {"value_C", 20.52},
            {"noise_K", 0.08},
            {"state", "stuck"}}}},
         {"profile",
          {{"calibration_span_mm", 1.6},
           {"cameras", {{{"id", "front"}, {"url", "http://camera:hunter2@10.0.0.5/front.mjpg?token=abcdef"}}}},
           {"controller", {{"host", "10.0.0.9"}, {"password", "hunter2"}}},
           {"machine", {{"sensors", {{{"channel", "T1_C"}, {"component", "spindle"}, {"position_mm", 345.0}}}}}},
           {"sensors", {{{"channel", "T1_C"}, {"accuracy_C", 0.1}}, {{"channel", "T2_C"}, {"accuracy_C", 0.1}}}}}}});
  }

  void sensors() {
    put("sensors",
        {{"chosen", {"T1_C", "T2_C"}},
         {"chosen_by", "hand"},
         {"choice",
          {{"sets",
            {{{"in_words", "sensitive points of the clusters"},
              {"sensors", {"T1_C"}},
              {"held_out_rms_um", 1.14},
              {"held_out_peak_um", 2.4},
              {"expected_um", 1.2},
              {"chosen", false}},
             {{"in_words", "nearest to the model on all"},
              {"sensors", {"T1_C", "T2_C"}},
              {"held_out_rms_um", 0.7},
              {"held_out_peak_um", 1.4},
              {"expected_um", 0.8},
              {"chosen", true}}}}}},
         {"budget",
          {{{"sensors", 1}, {"held_out_rms_um", 3.1}, {"held_out_peak_um", 4.9}},
           {{"sensors", 2}, {"held_out_rms_um", 0.7}, {"held_out_peak_um", 1.4}}}},
         {"price", {{"held_out_rms_um", 2.4}, {"all_rms_um", 1.6}}},
         {"condition_number", {{"chosen", 912.0}}},
         {"sensors",
          {{{"sensor", "T1_C"}, {"correlation", {{"dX_um", -0.9}, {"dY_um", 0.2}, {"dZ_um", 0.99}}}, {"vif", 12.0}}}},
         {"table",
          {{{"channel", "T1_C"}, {"cluster", 1}, {"correlation_sum", 2.09}, {"kept", true}},
           {{"channel", "T2_C"}, {"cluster", 2}, {"correlation_sum", 1.5}, {"kept", false}}}}});
  }

  void model() {
    const Json band = {{"stated_coverage", 0.9}, {"measured_coverage", 0.8}, {"half_width_um", 1.9}};
    const Json error = {{"error", "dZ_um"}, {"band", band}, {"held_out", {{"removed_percent", 97.2}}}};
    put("model",
        {{"summary",
          "Method ridge on 2 sensors: leaves. A dynamic model, which needs the host compensator, would leave "
          "0.9 um rms."},
         {"figures",
          {{{"channel", "dZ_um"}, {"rms_fit_um", 0.34}, {"rms_held_out_um", 0.7}, {"peak_held_out_um", 7.28}}}},
         {"table",
          {{{"axis", "Z"}, {"sensor", "T1_C"}, {"um_per_K", 5.912}, {"reference_C", 20.0}},
           {{"axis", "Z"}, {"sensor", "T2_C"}, {"um_per_K", -0.0004}, {"reference_C", 20.5}}}},
         {"offset_um", {{"Z", -0.001}}},
         {"model",
          {{"method", "ridge"},
           {"sensors", {"T1_C", "T2_C"}},
           {"held_out", "each of 4 cycles in turn"},
           {"errors", {error}},
           {"candidates",
            {{{"label", "ridge on 2 sensors"},
              {"held_out_rms_um", 0.7},
              {"held_out_peak_um", 1.4},
              {"runs_on_controller", true},
              {"chosen", true}}}},
           {"quality",
            {{"error_range_um", 40.0},
             {"advice",
              {"The warmest sensor rose by only 9.5 K: run longer or "
               "faster."}}}},
           {"findings", {{{"text", "T2_C stopped during the run (no samples from 3000 s); it is not used"}}}}}}});
  }

  void physics() {
    const Json effect = {{"id", "structure_bending"},
                         {"confidence", 0.781},
                         {"log_evidence_gain", 20.9},
                         {"parameters", {{"um_per_unit", -0.109}, {"lag_s", 1987.0}}},
                         {"sigma", {{"um_per_unit", 0.048}, {"lag_s", 450.0}}},
                         {"explanation", "English"},
                         {"said",
                          {{"id", "effect_found"},
                           {"facts",
                            {{"regime", "while the spindle turns"},
                             {"channel", "dY_um"},
                             {"before", "3.1"},
                             {"unit", "µm"},
                             {"name", "structure_bending"},
                             {"where", "where_channel"},
                             {"place_channel", "dY_um"},
                             {"parameters", "g = -0.109 ± 0.048 µm per unit of its driver, τ = 1987 ± 450 s"},
                             {"removed_percent", "37"},
                             {"fingerprint", "Only displacements are off; they follow the room with a delay"}}}}}};
    const Json rival = {{"id", "structure_ambient"},
                        {"why", "English"},
                        {"said",
                         {{"id", "rival_left"},
                          {"facts", {{"name", "structure_ambient"}, {"where", "where_nowhere"}, {"behind", "1.2"}}}}}};
    const Json run = {{"text", "English"},
                      {"said",
                       {{"id", "experiment_run"},
                        {"facts",
                         {{"best", "structure_bending"},
                          {"rival", "structure_ambient"},
                          {"minutes", "60"},
                          {"run", "half speed without coolant"}}}}}};
    put("physics",
        {{"rmse", {{"before", {{"T1_C", 0.52}, {"dY_um", 7.4}}}}},
         {"diagnosis",
          {{"verdict", "unexplained"},
           {"sentences", {"English"}},
           {"said",
            {{{"id", "verdict_unexplained"},
              {"facts", {{"channel", "dY_um"}, {"watts", "35"}, {"regime", "all the time"}}}}}},
           {"effects", {effect}},
           {"ambiguous_with", {rival}},
           {"suggested_experiment", run},
           {"could_have_detected",
            {{"radiation", {{"key", "emissivity"}, {"value", 1.2}}},
             {"sensor_lag", {{"key", "lag_s"}, {"value", 33.1}}}}},
           {"rmse",
            {{"refitted", {{"T1_C", 0.11}, {"dY_um", 3.1}}},
             {"after", {{"T1_C", 0.1}, {"dY_um", 1.9}}},
             {"noise", {{"T1_C", 0.1}, {"dY_um", 0.05}}},
             {"held_out_refitted", {{"T1_C", 0.12}}},
             {"held_out_after", {{"T1_C", 0.11}}}}},
           {"mismatch",
            {{"channels", {"dY_um"}},
             {"component", "spindle"},
             {"position_mm", {150.0, 190.0}},
             {"regime", "while the spindle turns"},
             {"missing_heat_W", 35.0}}}}},
         {"heat",
          {{"component", "spindle"},
           {"from_mm", 8.0},
           {"to_mm", 392.0},
           {"from_s", 0.0},
           {"to_s", 6000.0},
           {"watts", {{-0.1, 0.2, 0.3}, {0.0, 0.1, -0.4}}}}},
         {"sentences", {"The simulation differs."}},
         {"said",
          {{{"id", "simulation_differs"},
            {"facts",
             {{"channel", "T1_C"}, {"rms", "0.52"}, {"unit", "K"}, {"largest", "1.16"}, {"minutes", "153"}}}}}},
         {"curves",
          {{{"channel", "T1_C"},
            {"unit", "C"},
            {"time_h", {0.0, 1.0}},
            {"values", {20.0, 29.0}},
            {"refined", {20.0, 29.5}}}}}});
  }

  void upload() {
    put("upload",
        {{"version", 2},
         {"crc32", "33d1a6b5"},
         {"registers", 206},
         {"largest_change_um", 3.19},
         {"problems", {"T1_C 29.10 C (valid 21.40 to 28.60): the machine is outside the range the model was made in"}},
         {"table", {{"valid", {{"T1_C", {20.0, 30.0}}}}}},
         {"difference",
          {{{"what", "Z T1_C"}, {"old", "-"}, {"new", "5.912 um/K from 20.00 C"}},
           {{"what", "Z offset"}, {"old", "0.50 um"}, {"new", "-0.00 um"}}}},
         {"states",
          {{{"state", "saving_old"}, {"at_s", 0.0}, {"detail", ""}},
           {{"state", "staging"}, {"at_s", 0.01}, {"detail", "206 registers"}},
           {{"state", "done"}, {"at_s", 0.06}, {"detail", ""}}}},
         {"sign_check",
          {{"passed", true},
           {"axes",
            {{{"axis", "Z"},
              {"commanded_um", 10.0},
              {"seen_um", {0.0, 0.0, 9.99}},
              {"sigma_um", {0.02, 0.02, 0.014}},
              {"watched", true}}}}}},
         {"record",
          {{"difference",
            {{{"axis", "Z"},
              {"compensation",
               {{{"position_mm", 0.0}, {"old_up_um", 0.0}, {"new_up_um", -3.0}, {"new_down_um", -3.1}},
                {{"position_mm", 400.0}, {"old_up_um", 0.5}, {"new_up_um", -2.0}, {"new_down_um", -2.2}}}}}}}}}});
  }

  void verification(double after_um, const char* verdict) {
    put("verification",
        {{"series", record("verification", 0.05)},
         {"plan", plan()},
         {"compared_s", 6000.0},
         {"peak_error_before_um", {{"X", 3.8}, {"Y", 0.95}, {"Z", 57.0}}},
         {"rms_error_before_um", {{"X", 3.0}, {"Y", 0.7}, {"Z", 44.0}}},
         {"peak_error_after_um", {{"X", 0.2}, {"Y", 1.1}, {"Z", after_um}}},
         {"rms_error_after_um", {{"X", 0.1}, {"Y", 0.6}, {"Z", 1.04}}},
         {"removed_percent", {{"X", 94.7}, {"Y", -15.8}, {"Z", 94.6}}},
         {"end_error_before_um", {{"X", 3.7}, {"Y", 0.3}, {"Z", 56.0}}},
         {"end_error_after_um", {{"X", 0.1}, {"Y", 0.9}, {"Z", 1.0}}},
         {"limit_um", 5.0},
         {"corrected_table", {{"version", 3}}},
         {"correction",
          {{{"axis", "Z"},
            {"kappa", 0.971},
            {"offset_um", -0.02},
            {"reason", "the temperature terms are multiplied by 0.971 and the offset is moved by -0.02 um"}},
           {{"axis", "X"},
            {"kappa", 1.0},
            {"offset_um", 0.0},
            {"reason", "0 of 91 measurements exceed 1.0 um: no need to correct"}}}},
         {"verdict", verdict}});
  }

  void axis() {
    put("axis_table", {{"file", "laser-x.csv"},
                       {"statistics",
                        {{"A_um", 8.1},
                         {"E_um", 6.2},
                         {"R_um", 2.2},
                         {"B_um", 1.1},
                         {"B_mean_um", -0.9},
                         {"M_um", 5.5},
                         {"P_um", 9.0},
                         {"Pa_um", 5.6},
                         {"Ps_max_um", 2.0},
                         {"Ps_mean_um", 1.5},
                         {"U_max_um", 1.2},
                         {"U_mean_um", 0.9}}},
                       {"notes", {"criterion: |r| of position and error at least 0.98, from 10 points"}},
                       {"table",
                        {{"axes",
                          {{"X",
                            {{"points",
                              {{{"position_mm", 0.0}, {"error_up_um", 0.0}, {"error_down_um", -1.0}},
                               {{"position_mm", 400.0}, {"error_up_um", 6.0}, {"error_down_um", 5.0}}}},
                             {"segments",
                              {{{"from_mm", 0.0},
                                {"to_mm", 400.0},
                                {"a", 1.000015},
                                {"b_mm", -0.0005},
                                {"r", 0.991},
                                {"points", 11}}}}}}}}}}});
  }

  std::filesystem::path m_folder;
  std::unique_ptr<commissioning::Job> m_job;
};

}  // namespace zerodrift::report
