// A run that is in the job already, as the page shows it.

#include <algorithm>
#include <cmath>

#include "app/desktop/run_feed.h"
#include "app/desktop/run_words.h"
#include "core/recording/recording.h"
#include "ui/pages/run_view.h"

namespace zerodrift::desktop {
void RunFeed::showRecording(const recording::Recording& run, const std::vector<commissioning::Event>& events) {
  m_view->clear();
  m_marks.clear();
  m_pauses.clear();
  m_importedNames.clear();
  for (const auto& channel : run.channels) {
    if (recording::present_count(channel) > 0) m_importedNames.push_back(channel.name);
  }
  nameChannels();
  m_view->setCameraShown(false);  // its pictures were not kept
  m_largest_um = 0.0;
  m_longestHole_s = 0.0;
  m_lastRow_s = -1.0;
  for (const double time_s : run.time_s) noteRow(time_s);
  showMarks(events);
  m_speeds = {};
  m_speeds.time_s = run.time_s;
  for (const char* name : {"spindle_rpm", "coolant_on"}) {
    if (const auto* input = run.find(name)) m_speeds.ensure(name).values = input->values;
  }
  for (const auto& channel : run.channels) {
    QVector<double> times;
    QVector<double> values;
    const bool error = recording::kind_of(channel.name) == recording::ChannelKind::error;
    auto pause = m_marks.begin();
    for (std::size_t r = 0; r < run.rows(); ++r) {
      if (std::isnan(channel.values[r])) continue;
      // Nothing is measured in a pause: no line leads over it.
      for (; error && pause != m_marks.end() && pause->at < run.time_s[r]; ++pause) {
        if (!m_pauses.contains(pause->at)) continue;
        times.append(pause->at);
        values.append(std::nan(""));
      }
      times.append(run.time_s[r]);
      values.append(channel.values[r]);
      noteErrors(channel.name, channel.values[r]);
    }
    m_view->append(QString::fromStdString(channel.name), times, values);
  }
  showRegimes(run);
  if (run.rows() == 0) return;
  QVector<ui::RunValue> last;
  for (const auto& channel : run.channels) {
    const auto sigma = std::find_if(run.channels.begin(), run.channels.end(),
                                    [&](const auto& one) { return one.name == sigma_channel(channel.name); });
    const double sigma_nm =
        sigma == run.channels.end() ? std::nan("") : recording::value_at(run, *sigma, run.time_s.back());
    last.append({QString::fromStdString(channel.name),
                 recording::value_at(run, channel, run.time_s.back()),
                 uncertainty_text(sigma_nm),
                 {}});
  }
  m_view->setValues(last);
  if (!m_compensated) return;
  std::vector<std::string> names;
  std::vector<QVector<double>> values;
  for (const auto& channel : run.channels) {
    names.push_back(channel.name);
    values.emplace_back(channel.values.begin(), channel.values.end());
  }
  appendCompensation(names, QVector<double>(run.time_s.begin(), run.time_s.end()), values);
}

/// The channels of a run from a file are its own, called as they were assigned.
void RunFeed::nameImported() {
  QVector<ui::RunChannel> temperatures;
  QVector<ui::RunChannel> errors;
  QVector<ui::RunChannel> inputs;
  const auto& names = m_importedNames;
  const bool speed = std::find(names.begin(), names.end(), "spindle_rpm") != names.end();
  for (const std::string& name : names) {
    ui::RunChannel named = channel_of(name, m_bench.channelInWords(name));
    named.tag = m_bench.tagOf(name);
    const auto kind = recording::kind_of(name);
    if (kind == recording::ChannelKind::temperature || kind == recording::ChannelKind::ambient) {
      temperatures.append(named);
    } else if (kind == recording::ChannelKind::error || kind == recording::ChannelKind::tilt) {
      const auto axis = QStringLiteral("XYZ").indexOf(named.tag);
      if (axis >= 0 && named.tag.size() == 1) named.color = ui::axisColor(static_cast<int>(axis));
      errors.append(named);
    } else if (!speed || name == "spindle_rpm") {  // other inputs have another scale
      inputs.append(named);
    }
  }
  m_view->setChannels(temperatures, errors, inputs);
  m_view->setCameraShown(false);  // nobody watched
}

void RunFeed::showMarks(const std::vector<commissioning::Event>& events) {
  for (const auto& event : events) {
    if (event.kind == "note") mark(event.time_s, QString::fromStdString(event.text));
    if (event.kind == "pause") markPause(event.time_s);
  }
}

void RunFeed::showHappened(const std::vector<acquisition::Happening>& happened, int measurements, int refused) {
  ui::RunTrouble trouble;
  trouble.ended = true;
  trouble.so_far = inWords(happened, measurements, refused);
  m_view->setTrouble(trouble);
}

}  // namespace zerodrift::desktop
