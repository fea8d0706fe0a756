#pragma once
// One diagnosis in the making: what select_effects finds is judged (diagnose.cpp) and told (diagnose_report.cpp).

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/elsewhere.h"
#include "core/diagnosis/explain.h"
#include "core/diagnosis/misplaced.h"
#include "core/diagnosis/plausible.h"
#include "core/diagnosis/selection.h"
#include "core/diagnosis/wrong_geometry.h"

namespace zerodrift::diagnosis {

/// Root mean square of measured - predicted where a sample is there and no spike; NaN without such a channel.
double rms_between(const recording::Recording& recording, const std::string& name,
                   const std::vector<double>& predicted);

class Diagnoser {
 public:
  Diagnoser(const physics::Machine& machine, const std::vector<recording::Recording>& recordings,
            const DiagnoseOptions& options, const TaskContext& context);
  /// What the answer is for. Where only one that names something is of use, others are not looked into any further.
  enum class Of { any, what_is_named };
  Result<Diagnosis> run(Of use = Of::any);
  /// Once run: do the others bear the answer out (elsewhere.h)?
  bool borne_out_elsewhere() const;

 private:
  static constexpr double most_left = 0.2;  // of the mismatch, rms, for an effect to explain it
  /// What an explanation may leave, in widths of noise and ordinary misfit, however much it explains. Right ones leave
  /// one.
  static constexpr double most_left_widths = 10.0;

  /// What is fitted: the first recording, thinned if it is long.
  const recording::Recording& recording() const { return m_fitted; }
  Status prepare();
  Status select();
  Status choose_drift();
  double leftover(const physics::Prediction& prediction) const;
  void tell_tried();
  void judge();
  void decide();
  bool of_use() const { return m_use == Of::any || m_out.verdict == Verdict::missing_effect; }
  void check_set_up();
  bool correct_description();
  bool leave_out_what_is_not_there();
  void answer_anew(Selection again);
  std::shared_ptr<Model> without_kind(std::size_t i) const;
  bool names_a_sensor() const;
  void turn_to_the_colder(FoundEffect& found) const;
  void tell_place(FoundEffect& found, std::size_t index);
  void effects();
  ShownBy show_best(FoundEffect& found, const physics::Prediction& without) const;
  void end_within_the_run(FoundEffect& found) const;
  double confidence_of(const FoundEffect& found, const ShownBy& shown) const;
  double odds_against(const FoundEffect& found) const;
  double guessed(const FoundEffect& found) const;
  void doubt_description(FoundEffect& found, const Model& without);
  void rivals();
  bool shows_too_little() const;
  void tell_wrong_set_up();
  bool wrong_set_up() const { return m_wrong_geometry || m_misplaced; }
  double start_above_room_K(const physics::Component& component) const;
  bool steady_inputs() const;
  void hidden_by_steadiness();
  void tell_rivals(std::vector<std::shared_ptr<Model>> nearest);
  void series();
  double usual_noise(bool temperature) const;
  void without_effects();
  std::string driver_of_first() const;
  void mismatch();
  std::string where_to_look() const;
  void map_of_first_rod(const Model& nominal);
  void locate();
  void times();
  void place_from_effect();
  void held_out();
  double left_elsewhere(const physics::Machine& machine) const;
  bool counts_from_each_start(const physics::Machine& best) const;
  void slips_of_its_own(const physics::Machine& best, const recording::Recording& other, HeldOut& result) const;
  bool refuted() const;
  bool heat_is_left() const;
  void details();
  void cannot_show(const std::vector<std::string>& never_driven);
  std::vector<std::string> never_driven() const;
  double room_jump_K(const FoundEffect& found) const;
  double clocks_apart() const;
  ClockOffset clock_offset() const;
  bool rows_are_coarse() const;
  void coarse_rows();
  void few_sensors();
  void inputs_not_logged();
  std::vector<std::string> not_recorded() const;
  void moving_alone();
  void sensor_alone();
  std::vector<std::string> mirrored() const;
  void signs_turned();
  double seconds_between_rows() const;
  bool nothing_drives() const;
  bool moves() const;
  std::vector<Sentence> far_parameters();
  const ChannelReport* missed_by_far(const HeldOut& other) const;
  bool of_another_machine(const HeldOut& other) const;
  void another_machine();
  void worse_elsewhere();
  void notes();

  const physics::Machine& m_machine;  // as described
  const physics::Machine m_bodies;    // what is fitted: with the insides of its rods
  const std::vector<recording::Recording>& m_recordings;
  const recording::Recording m_fitted;
  std::vector<recording::Recording> m_other_rows;  // thinned alike
  DiagnoseOptions m_options;
  Of m_use = Of::any;
  const TaskContext& m_context;
  SelectionOptions m_limits;
  std::vector<std::shared_ptr<const Dataset>> m_other_sets;  // as m_limits.others at first
  std::shared_ptr<const Dataset> m_data, m_default_data;
  bool m_lumps_only = false;
  std::string m_moved_elsewhere;   // what only another recording shows to be unexplained
  bool m_from_each_start = false;  // temperature laws of what is named
  double m_warmth_left = 0.0;      // excess of the temperature that the best explains worst
  bool m_wide = false;             // the data asked for more than the ordinary discrepancy
  physics::RunFacts m_facts;
  Selection m_selection;
  std::shared_ptr<Model> m_used;
  std::vector<FarParameter> m_far;                 // of what explains best
  std::optional<FarParameter> m_corrected;         // the description is taken with this number changed
  std::optional<physics::EffectSpec> m_not_there;  // described, and left out of what explains best
  std::optional<WrongGeometry> m_wrong_geometry;
  std::optional<Misplaced> m_misplaced;
  std::vector<Sentence> m_misstated;     // of what is named beside them
  std::optional<SeenByAll> m_of_others;  // the best in the others, where it fits them; once asked
  physics::Prediction m_explained;
  std::vector<double> m_contribution, m_contribution_in_time;
  std::vector<std::shared_ptr<Model>> m_rivals;
  Diagnosis m_out;
};

}  // namespace zerodrift::diagnosis
