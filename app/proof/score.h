#pragma once
// Scoring of blind trials: what was hidden against what diagnosis.json says. Knows neither who made the cases nor how
// the diagnosis works, so that every source of cases is judged by the same rules.

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace zerodrift::proof {

struct TrueEffect {
  std::string id;
  std::optional<double> position_mm;
  std::string channel;
  std::string law;                        // of a heat source: "constant", "on", "n", "n2"
  std::map<std::string, double> sizes{};  // what it was hidden with, by the name of the parameter
};

/// The opened answer of one case.
struct OpenedAnswer {
  std::string name;
  std::vector<TrueEffect> effects;      // empty: nothing was hidden
  bool unlisted = false;                // no library of effects has it: "unexplained" is the right answer
  std::string worst_channel;            // which the hidden effects change most, in noise widths; empty: nothing hidden
  double strength = 0.0;                // raw, of the weakest hidden effect (strength.h)
  double left = 0.0;                    // what of it a re-fit of ordinary numbers leaves
  std::vector<std::string> put_aside;   // drawn before it, and drawn anew because a re-fit leaves too little of them
  std::map<std::string, double> floor;  // noise of each channel in the second recording: no model can be better
  /// What the true structure, re-fitted, reaches in the second recording; empty where nobody asked.
  std::map<std::string, double> reached;
  /// Log evidence, for one who is told the truth, of the hidden effect that shows least beside the others.
  std::optional<double> told;
  /// For the same, one standard deviation of each hidden place, mm, by the effect's id.
  std::map<std::string, double> told_place_sigma_mm;

  std::string words() const;  // "none", "coolant", "coolant+sensor_lag"
};

enum class Outcome {
  right,        // every effect, and no other; or rightly consistent; or an unlisted one rightly unexplained
  first_right,  // the first named is one of the hidden, the list is not complete or too long
  wrong_name,
  given_up,     // unexplained although the library has it
  missed,       // consistent although something was hidden
  false_alarm,  // something although nothing was hidden
  failed,       // the diagnosis refused the files
};
std::string name_of(Outcome outcome);

/// A hidden effect that the answer does not name, beside what the answer said that this recording could have shown.
struct NotNamed {
  std::string id, key;           // key: of the size, empty where the two are not given in the same unit
  double hidden = 0.0;           // its size
  double could_show_from = 0.0;  // the smallest size that would have shown, as the answer says
  bool compared() const { return !key.empty(); }
  /// The answer said beforehand that so small an effect would not show.
  bool was_told() const { return compared() && hidden < could_show_from; }
};

struct Judgement {
  std::string name, truth, answer;
  Outcome outcome = Outcome::failed;
  double confidence = 0.0;  // of the first effect
  double seconds = 0.0;
  double strength = 0.0, left = 0.0;
  std::optional<double> location_error_mm;
  std::optional<double> told;  // OpenedAnswer::told
  std::vector<NotNamed> not_named;
  /// The recording holds what an answer needs, for one who is told; true where nobody asked.
  bool decidable() const;
};

/// A figure of the proof beside what it must reach.
struct ProofFigure {
  std::string id, label, value, unit, limit;
  std::optional<bool> met;  // empty: no limit, or too little to judge
};

class Score {
 public:
  /// Judges one case by its diagnosis.json.
  Judgement add(const OpenedAnswer& truth, const nlohmann::json& diagnosis);
  /// The diagnosis refused: counts as wrong.
  Judgement add_failure(const OpenedAnswer& truth, const std::string& answer);

  std::vector<ProofFigure> figures() const;
  /// Confusion: truth -> answer -> cases.
  const std::map<std::string, std::map<std::string, int>>& confusion() const { return m_confusion; }
  const std::vector<Judgement>& judgements() const { return m_judgements; }

  struct Bin {
    double low = 0.0, high = 0.0, confidence = 0.0, right = 0.0;  // means of the bin
    int cases = 0;
  };
  /// Reliability of the confidence of named effects: stated against how often it was right.
  std::vector<Bin> reliability() const;
  double expected_calibration_error() const;

  /// Medians over channels and cases of the rms in K or um: "T", "dZ", "dY".
  struct Improvement {
    std::string kind;
    bool second = false;  // on the recording that was held out
    double nominal = 0.0, refitted = 0.0, explained = 0.0, floor = 0.0, worst_over_floor = 0.0;
    int channels = 0;
    /// The true structure's rms, explained over it as a ratio of medians, and the median of the channels' ratios; on
    /// channels of cases where it is known (NaN without).
    double reached = 0.0, over_reached = 0.0, median_over_reached = 0.0;
  };
  std::vector<Improvement> improvements() const;

  /// Of the listed effects not answered rightly: how many, and for how many of them the recording holds less evidence,
  /// even for one who is told the truth, than any answer needs.
  struct Undecidable {
    int wrong = 0, undecidable = 0;
    int compared = 0, said_so = 0;  // effects not named whose size can be compared with what could have shown
  };
  Undecidable undecidable() const;

  /// Cases in which the first recording could not show the effect: the second was fitted and the first held out.
  /// OpenedAnswer::put_aside of all cases: how often each effect was.
  const std::map<std::string, int>& put_aside() const { return m_put_aside; }

  nlohmann::json to_json() const;
  std::string text() const;

 private:
  struct Tally {
    int good = 0, all = 0;
    void add(bool ok) {
      good += ok ? 1 : 0;
      ++all;
    }
    double share() const { return all > 0 ? static_cast<double>(good) / all : 0.0; }
  };
  struct Rms {
    std::vector<double> nominal, refitted, explained, floor;
    std::vector<double> reached, explained_there;  // where the true structure's is known
  };

  void count_outcome(const OpenedAnswer& truth, const Judgement& judgement);
  void count_location(const OpenedAnswer& truth, const nlohmann::json& diagnosis, Judgement& judgement);
  void count_rms(const OpenedAnswer& truth, const nlohmann::json& diagnosis);

  Tally m_first, m_all_right, m_pairs, m_pairs_decidable, m_quiet, m_missed, m_unlisted, m_channel, m_location_stated,
      m_stretch;
  std::map<std::string, int> m_put_aside;
  std::vector<double> m_location_mm, m_point_mm, m_decidable_mm, m_seconds, m_processor_s;
  std::vector<std::pair<double, bool>> m_confidence;
  std::map<std::pair<std::string, bool>, Rms> m_rms;  // (kind of channel, second recording)
  std::map<std::string, std::map<std::string, int>> m_confusion;
  std::vector<Judgement> m_judgements;
};

}  // namespace zerodrift::proof
