#pragma once
// Sentences a technician understands, from the numbers: ids with their facts (core/diagnosis/answer/sentences.h).

#include "core/diagnosis/diagnosis.h"

namespace zerodrift::diagnosis {

/// The channel that shows an effect best: rms without and with it, and of its noise, K or um.
struct ShownBy {
  std::string channel;
  double before = 0.0, after = 0.0, noise = 0.0;
};

/// `end_s`: of the recording.
Sentence explain_effect(const FoundEffect& effect, double end_s, const ShownBy& shown);
/// When an effect acts, in English: "while the coolant runs", "from 155 min on".
std::string regime_of_effect(const FoundEffect& effect, double end_s);
Sentence explain_rival(const Rival& rival);
Sentence explain_verdict(const Diagnosis& diagnosis);
/// When and where what is unexplained shows, as far as that is known better than "all along" and "all the time".
std::vector<Sentence> explain_unexplained(const Diagnosis& diagnosis);
/// Channels that stay unexplained beside what is named; an empty id where there are none.
Sentence explain_left(const Diagnosis& diagnosis);
/// "h = 12.7 ± 0.7 W/m²K": a parameter of an effect with a sign that is the same in every language; sigma 0: unknown.
/// Empty for what is not shown (cosines, logarithms). A figure that holds at one speed says so: "P(8000 rpm) = 26 W".
std::string parameter_in_words(const std::string& key, double value, double sigma, double at_rpm = 0.0);
/// "38 ± 4 W", "-38 ± 4 W"
std::string watts_in_words(double mean_W, double sigma_W);
/// Figures of an effect that grow with the speed, and the full speed at which they hold.
std::map<std::string, double> speeds_of_figures(const std::map<std::string, double>& numbers,
                                                const std::map<std::string, std::string>& words, double full_rpm);
/// A sentence of the catalogue with its facts.
Sentence explain_note(const std::string& id, std::map<std::string, std::string> facts = {});
/// Which tolerances were too small to be believed, and what was taken instead.
Sentence explain_raised(const physics::Tolerances& taken);
/// A note in words; an empty id where it is none for a technician.
Sentence sentence_of(const Note& note);
/// What of the recordings was repaired or left out; but what a note says already.
std::vector<Sentence> explain_findings(const std::vector<RunFinding>& findings, const std::vector<Note>& notes);
/// Facts of the note about a number that the fit moved far from the description.
Note far_from_description(const std::string& quantity, const std::string& of, double factor, double sigmas);
/// `run` in English words: "half speed without coolant"; how long it takes in all.
Sentence explain_experiment(const std::string& best_effect, const std::string& rival_effect, const std::string& run,
                            int minutes);

}  // namespace zerodrift::diagnosis
