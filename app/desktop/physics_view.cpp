#include "app/desktop/physics_view.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/text/core_text.h"
#include "core/diagnosis/answer/explain.h"
#include "core/diagnosis/answer/sentences.h"
#include "core/flow/steps/inputs.h"
#include "core/recording/csv.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::desktop {

using nlohmann::json;
using recording::Recording;

namespace {

constexpr int map_columns = 160;
constexpr int map_rows = 60;
constexpr std::size_t most_sparks = 120;

struct PhysicsView {
  Q_DECLARE_TR_FUNCTIONS(PhysicsView)
};

/// "T14", and for the error "dY_um" plainly "Y".
QString short_tag(const std::string& channel) {
  const QString tag = QString::fromStdString(channel.substr(0, channel.rfind('_')));
  const bool error = recording::kind_of(channel) == recording::ChannelKind::error && tag.startsWith(QLatin1Char('d'));
  return error ? tag.mid(1) : tag;
}

QVector<double> values_of(const Recording& run, const std::string& channel) {
  const auto* found = run.find(channel);
  return found == nullptr ? QVector<double>() : QVector<double>(found->values.begin(), found->values.end());
}

double number_of(const json& object, const std::string& key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_number() ? at->get<double>() : std::nan("");
}

double rms_difference(const QVector<double>& a, const QVector<double>& b) {
  double sum = 0.0;
  int count = 0;
  for (qsizetype i = 0; i < std::min(a.size(), b.size()); ++i) {
    const double d = a[i] - b[i];
    if (!std::isfinite(d)) continue;
    sum += d * d;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : std::nan("");
}

/// Recorded minus the model, thinned for a sparkline.
QVector<double> residual_of(const Recording& recorded, const Recording& model, const std::string& channel) {
  const auto* seen = recorded.find(channel);
  const auto* told = model.find(channel);
  QVector<double> out;
  if (seen == nullptr || told == nullptr || seen->values.size() != told->values.size()) return out;
  const std::size_t stride = seen->values.size() / most_sparks + 1;
  for (std::size_t r = 0; r < seen->values.size(); r += stride) {
    const double d = seen->values[r] - told->values[r];
    if (std::isfinite(d)) out.append(d);
  }
  return out;
}

/// Value of a row of the map at a share of its length, linear.
double at_share(const json& row, double share) {
  if (row.size() < 2) return std::nan("");
  const double place = share * static_cast<double>(row.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(place), row.size() - 2);
  const double part = place - static_cast<double>(low);
  const auto value = [&](std::size_t i) { return row[i].is_number() ? row[i].get<double>() : 0.0; };
  return (1.0 - part) * value(low) + part * value(low + 1);
}

/// Positions as they come, however they are spaced, on the even grid the map draws.
ui::HeatMapData located_heat(const json& heat) {
  ui::HeatMapData map;
  map.unit = QStringLiteral("W");
  map.from_mm = heat.at("from_mm").get<double>();
  map.to_mm = heat.at("to_mm").get<double>();
  map.from_s = heat.at("from_s").get<double>();
  map.to_s = heat.at("to_s").get<double>();
  const json& watts = heat.at("watts");
  map.rows = static_cast<int>(watts.size());
  map.columns = map_columns;
  for (const auto& row : watts) {
    for (int c = 0; c < map_columns; ++c) map.values.append(at_share(row, c / (map_columns - 1.0)));
  }
  return map;
}

struct Residual {
  double position_mm;
  const std::vector<double>* recorded;
  const std::vector<double>* simulated;
};

double mean_between(const Residual& sensor, std::size_t from, std::size_t to) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t r = from; r < to; ++r) {
    const double d = (*sensor.recorded)[r] - (*sensor.simulated)[r];
    if (!std::isfinite(d)) continue;
    sum += d;
    ++count;
  }
  return count > 0 ? sum / count : std::nan("");
}

/// Between the sensors that were alive; beyond the last of them nothing is known.
double between(const std::vector<Residual>& sensors, const std::vector<double>& values, double position_mm) {
  std::optional<std::size_t> below;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    const double above_mm = sensors[i].position_mm;
    if (above_mm < position_mm) {
      below = i;
      continue;
    }
    if (above_mm == position_mm) return values[i];
    if (!below) break;
    const double share = (position_mm - sensors[*below].position_mm) / (above_mm - sensors[*below].position_mm);
    return (1.0 - share) * values[*below] + share * values[i];
  }
  return std::nan("");
}

std::vector<Residual> residuals_on(const physics::Machine& machine, const std::string& component,
                                   const Compared& runs) {
  std::vector<Residual> sensors;
  for (const auto& sensor : machine.sensors) {
    const auto* seen = runs.recorded.find(sensor.channel);
    const auto* told = runs.simulated.find(sensor.channel);
    if (sensor.component != component || seen == nullptr || told == nullptr) continue;
    if (seen->values.size() != told->values.size()) continue;
    sensors.push_back({sensor.position_mm, &seen->values, &told->values});
  }
  std::sort(sensors.begin(), sensors.end(), [](auto& a, auto& b) { return a.position_mm < b.position_mm; });
  return sensors;
}

ui::HeatMapData residual_map(const physics::Machine& machine, const std::string& component, const Compared& runs) {
  ui::HeatMapData map;
  const auto sensors = residuals_on(machine, component, runs);
  const std::size_t rows = runs.recorded.rows();
  if (sensors.size() < 2 || rows < map_columns) return map;
  map.unit = QStringLiteral("K");
  map.from_s = runs.recorded.time_s.front();
  map.to_s = runs.recorded.time_s.back();
  map.from_mm = sensors.front().position_mm;
  map.to_mm = sensors.back().position_mm;
  map.columns = map_columns;
  map.rows = map_rows;
  map.values.resize(qsizetype{map_columns} * map_rows);
  for (int c = 0; c < map_columns; ++c) {
    std::vector<double> values;
    const auto from = rows * static_cast<std::size_t>(c) / map_columns;
    const auto to = rows * static_cast<std::size_t>(c + 1) / map_columns;
    for (const auto& sensor : sensors) values.push_back(mean_between(sensor, from, to));
    for (int p = 0; p < map_rows; ++p) {
      const double position_mm = map.from_mm + (map.to_mm - map.from_mm) * p / (map_rows - 1.0);
      map.values[p * map_columns + c] = between(sensors, values, position_mm);
    }
  }
  return map;
}

/// The effect's size: its heat, or else the first parameter of the sentence: "36.1 ± 2.0 W" of "P = 36.1 ± 2.0 W, ...".
QString magnitude_of(const json& effect) {
  const auto heat = effect.find("heat_W");
  if (heat != effect.end()) {
    return QString::fromStdString(diagnosis::watts_in_words(number_of(*heat, "mean"), number_of(*heat, "sigma")));
  }
  const auto facts = diagnosis::sentence_from_json(effect.value("said", json())).facts;
  const auto parameters = facts.find("parameters");
  if (parameters == facts.end()) return {};
  const QString first = QString::fromStdString(parameters->second.substr(0, parameters->second.find(',')));
  return first.section(QStringLiteral(" = "), -1);  // the letter of a formula says nothing here
}

QString rivals_of(const json& diagnosis) {
  QStringList names;
  for (const auto& rival : diagnosis.value("ambiguous_with", json::array())) {
    QString name = effect_name(rival.value("id", ""));
    if (rival.contains("position_mm") && rival["position_mm"].is_number()) {
      name += PhysicsView::tr(" at %1 mm").arg(rival["position_mm"].get<double>(), 0, 'f', 0);
    }
    names << name;
  }
  return names.isEmpty() ? QString() : PhysicsView::tr("Cannot be told from: %1").arg(ui::listText(names));
}

/// The channel that the effect changes most, in widths of its noise.
std::string most_telling(const json& effect, const json& noise) {
  std::string best;
  double largest = -1.0;
  const json contribution = effect.value("contribution", json::object());  // outlives the loop
  for (const auto& [channel, value] : contribution.items()) {
    if (!value.is_number()) continue;
    const double widths = value.get<double>() / std::max(1e-6, number_of(noise, channel));
    if (!(widths > largest)) continue;
    largest = widths;
    best = channel;
  }
  return best;
}

/// Errors are measured now and then: only what was measured makes the curves, or they would fall to pieces.
void fill_curves(const Compared& runs, const recording::Channel& simulated, bool adopted, ui::SimulatedChannel& out) {
  const auto* recorded = runs.recorded.find(simulated.name);
  const auto* refined = adopted ? runs.refined.find(simulated.name) : nullptr;
  const bool sparse = simulated.kind() == recording::ChannelKind::error;
  for (std::size_t r = 0; r < runs.recorded.rows() && r < simulated.values.size(); ++r) {
    if (sparse && !std::isfinite(recorded->values[r])) continue;
    out.time_s.append(runs.recorded.time_s[r]);
    out.recorded.append(recorded->values[r]);
    out.simulated.append(simulated.values[r]);
    if (refined != nullptr && r < refined->values.size()) out.refined.append(refined->values[r]);
  }
}

}  // namespace

namespace {

/// "drift = 2.1 K/h, T = 21 °C": signs that are words, each in the user's language.
QString parametersInWords(const std::string& parameters) {
  QStringList parts = QString::fromStdString(parameters).split(QStringLiteral(", "));
  for (QString& part : parts) part = coreText(part);
  return ui::listText(parts);
}

}  // namespace

QString sentence_of(const json& stored, const std::string& english) {
  auto sentence = diagnosis::sentence_from_json(stored);
  for (const char* key : {"component", "part"}) {
    const auto named = sentence.facts.find(key);
    if (named != sentence.facts.end()) named->second = coreText(named->second).toStdString();
  }
  if (auto& parameters = sentence.facts["parameters"]; !parameters.empty()) {
    parameters = parametersInWords(parameters).toStdString();
  }
  const std::string text =
      diagnosis::said(sentence, [](const std::string& words) { return coreText(words).toStdString(); });
  return text.empty() ? coreText(english) : QString::fromStdString(text);
}

QString sentences_of(const json& body) {
  const json english = body.value("sentences", json::array());
  const json stored = body.value("said", json::array());
  QStringList sentences;
  for (std::size_t i = 0; i < english.size(); ++i) {
    sentences << sentence_of(i < stored.size() ? stored[i] : json(), english[i].get<std::string>());
  }
  return ui::sentencesText(sentences);
}

QString effect_name(const std::string& id) {
  if (id == "none") return PhysicsView::tr("Nothing hidden");
  if (id == "unexplained") return PhysicsView::tr("Unexplained");
  QString name = coreText(diagnosis::plain_name(id));
  if (!name.isEmpty()) name[0] = name[0].toUpper();
  return name;
}

QString effects_in_words(const std::string& ids) {
  QStringList names;
  for (const QString& id : QString::fromStdString(ids).split(QLatin1Char('+'))) names << effect_name(id.toStdString());
  return ui::listText(names);
}

QVector<ui::TrialCurve> trial_curves(const Recording& recorded, const Recording& simulated, const Recording& refined) {
  QVector<ui::TrialCurve> curves;
  for (const auto& channel : recorded.channels) {
    if (channel.kind() != recording::ChannelKind::temperature || simulated.find(channel.name) == nullptr) continue;
    curves.append({short_tag(channel.name), QVector<double>(recorded.time_s.begin(), recorded.time_s.end()),
                   values_of(recorded, channel.name), values_of(simulated, channel.name),
                   values_of(refined, channel.name)});
  }
  return curves;
}

Compared compared_of(const commissioning::Job& job, const Recording& recorded) {
  Compared runs;
  runs.recorded = recorded;
  const auto physics = job.latest("physics");
  if (!physics || !*physics) return runs;
  const auto read = [&](const char* name) -> Recording {
    const auto& names = (*physics)->blob_names;
    if (std::find(names.begin(), names.end(), name) == names.end()) return {};
    const auto bytes = job.blob((*physics)->id, name);
    return bytes ? recording::parse_recording(*bytes, name).value_or(Recording{}) : Recording{};
  };
  runs.simulated = read("prediction.csv");
  runs.refined = read("refined.csv");
  return runs;
}

QVector<ui::DrawnComponent> components_of(const physics::Machine& machine, const json& body) {
  QVector<ui::DrawnComponent> drawn;
  const json placement = body.is_object() ? body.value("placement", json()) : json();
  const json diagnosis = body.is_object() ? body.value("diagnosis", json::object()) : json::object();
  const json mismatch = diagnosis.value("mismatch", json::object());
  for (const auto& component : machine.components) {
    if (component.lump) continue;
    ui::DrawnComponent rod;
    rod.name = coreText(component.id);
    if (!rod.name.isEmpty()) rod.name[0] = rod.name[0].toUpper();
    rod.length_mm = component.length_mm;
    rod.diameter_mm = component.outer_diameter_mm;
    for (const auto& source : component.sources) {
      rod.sources.append({coreText(QString::fromStdString(source.id).replace(QLatin1Char('_'), QLatin1Char(' '))),
                          source.from_mm, source.to_mm});
    }
    for (const auto& sensor : machine.sensors) {
      if (sensor.component == component.id) rod.sensors.append({short_tag(sensor.channel), sensor.position_mm});
    }
    if (placement.is_object() && placement.value("component", "") == component.id) {
      rod.regionFrom_mm = placement.value("from_mm", 0.0);
      rod.regionTo_mm = placement.value("to_mm", 0.0);
    }
    if (mismatch.contains("component") && mismatch["component"] == component.id && mismatch["position_mm"].is_array()) {
      const double from_mm = mismatch["position_mm"][0].get<double>();
      const double to_mm = mismatch["position_mm"][1].get<double>();
      // A mismatch along the whole component is at no place.
      if (to_mm - from_mm < 0.9 * component.length_mm) {
        rod.mismatchFrom_mm = from_mm;
        rod.mismatchTo_mm = to_mm;
      }
    }
    drawn.append(rod);
  }
  return drawn;
}

QVector<ui::SimulatedChannel> channels_of(const Compared& runs, const physics::Machine& machine, const json& body) {
  QVector<ui::SimulatedChannel> channels;
  const bool adopted = body.is_object() && !body.value("adopted", json::array()).empty();
  const json diagnosis = body.is_object() ? body.value("diagnosis", json::object()) : json::object();
  const json noise = diagnosis.value("rmse", json::object()).value("noise", json::object());
  for (const auto& simulated : runs.simulated.channels) {
    const auto kind = recording::kind_of(simulated.name);
    const bool temperature = kind == recording::ChannelKind::temperature;
    const auto* recorded = runs.recorded.find(simulated.name);
    if ((!temperature && kind != recording::ChannelKind::error) || recorded == nullptr) continue;
    ui::SimulatedChannel channel;
    channel.id = QString::fromStdString(simulated.name);
    channel.tag = short_tag(simulated.name);
    channel.unit = temperature ? QStringLiteral("K") : QStringLiteral("µm");
    channel.valueUnit = temperature ? QStringLiteral("°C") : QStringLiteral("µm");
    fill_curves(runs, simulated, adopted, channel);
    channel.rmse = rms_difference(channel.recorded, channel.refined.isEmpty() ? channel.simulated : channel.refined);
    channel.noise = number_of(noise, simulated.name);
    if (std::isnan(channel.noise)) {
      const auto sensor = std::find_if(machine.sensors.begin(), machine.sensors.end(),
                                       [&](const auto& s) { return s.channel == simulated.name; });
      channel.noise = temperature && sensor != machine.sensors.end() ? sensor->accuracy_C : 1.0;
    }
    channels.append(channel);
  }
  return channels;
}

ui::HeatMapData heat_of(const json& body, const physics::Machine& machine, const std::string& component,
                        const Compared& runs) {
  if (body.is_object() && !body.value("adopted", json::array()).empty() && runs.refined.rows() > 0) {
    Compared left = runs;  // what the adopted effects do not explain
    left.simulated = runs.refined;
    return residual_map(machine, component, left);
  }
  const json heat = body.is_object() ? body.value("heat", json()) : json();
  if (heat.is_object() && heat.value("component", "") == component) return located_heat(heat);
  return residual_map(machine, component, runs);
}

void fill_explanations(const json& body, const Compared& runs, ui::PhysicsState& state) {
  const json diagnosis = body.value("diagnosis", json::object());
  const json detectable = diagnosis.value("could_have_detected", json::object());
  const auto listed = [&](const char* list, const std::string& id) {
    const auto ids = body.value(list, std::vector<std::string>{});
    return std::find(ids.begin(), ids.end(), id) != ids.end();
  };
  const json rmse = diagnosis.value("rmse", json::object());
  for (const auto& effect : diagnosis.value("effects", json::array())) {
    ui::Explanation card;
    const std::string id = effect.value("id", "");
    card.id = QString::fromStdString(id);
    card.name = effect_name(id);
    card.sentence = sentence_of(effect.value("said", json()), effect.value("explanation", ""));
    card.magnitude = magnitude_of(effect);
    if (effect["component"].is_string()) {
      card.place = coreText(effect["component"].get<std::string>());
      if (effect.contains("between_mm")) {  // no point where the place is hardly known
        card.place += QStringLiteral(", %1–%2 mm")
                          .arg(effect["between_mm"][0].get<double>(), 0, 'f', 0)
                          .arg(effect["between_mm"][1].get<double>(), 0, 'f', 0);
      } else if (effect["position_mm"].is_number()) {
        card.place += QStringLiteral(", %1 mm").arg(effect["position_mm"].get<double>(), 0, 'f', 0);
      }
    } else if (effect["channel"].is_string()) {
      const std::string channel = effect["channel"].get<std::string>();
      const bool error = recording::kind_of(channel) == recording::ChannelKind::error;
      card.place = error ? PhysicsView::tr("error in %1").arg(short_tag(channel)) : short_tag(channel);
    }
    card.confidence = effect.value("confidence", 0.0);
    card.adopted = listed("adopted", id);
    card.rejected = listed("rejected", id);
    const auto facts = diagnosis::sentence_from_json(effect.value("said", json())).facts;  // what the sentence is about
    const auto told = facts.find("channel");
    const std::string channel =
        told != facts.end() ? told->second : most_telling(effect, rmse.value("noise", json::object()));
    card.unit =
        recording::kind_of(channel) == recording::ChannelKind::temperature ? QStringLiteral("K") : QStringLiteral("µm");
    card.channel = short_tag(channel);
    card.before = residual_of(runs.recorded, runs.simulated, channel);
    card.after = residual_of(runs.recorded, runs.refined, channel);
    card.rmseBefore = number_of(rmse.value("before", json::object()), channel);
    card.rmseRefit = number_of(rmse.value("refitted", json::object()), channel);
    card.rmseAfter = number_of(rmse.value("after", json::object()), channel);
    card.rivals = rivals_of(diagnosis);
    if (detectable.contains(id)) {
      const std::string least =
          diagnosis::parameter_in_words(detectable[id].value("key", ""), number_of(detectable[id], "value"), 0.0,
                                        detectable[id].value("at_rpm", 0.0));
      if (!least.empty()) card.couldDetect = PhysicsView::tr("Would have shown from %1 on").arg(coreText(least));
    }
    state.explanations.append(card);
  }
}

}  // namespace zerodrift::desktop
