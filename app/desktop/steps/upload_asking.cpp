// What is asked before a table is written, and what is told of a machine that holds another one.

#include <algorithm>

#include "app/desktop/steps/upload_presenter.h"
#include "app/text/error_text.h"
#include "core/controller/table_words.h"
#include "core/flow/flow.h"
#include "core/report/limits.h"
#include "ui/pages/upload_page.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::desktop {

using nlohmann::json;

namespace {

QString axes_text(const compensation::Table& table) {
  QStringList axes;
  for (const auto& [name, axis] : table.axes) axes << QString::fromStdString(name);
  return ui::listText(axes);
}

}  // namespace

std::optional<compensation::Table> UploadPresenter::chosenTable() const {
  return m_correction ? m_correction : m_lostTable;
}

/// A machine that holds nothing gets back what this job wrote last, corrections and all, as long as the model is the
/// same. True when that is another table than the one looked at, which must be compared anew.
bool UploadPresenter::takeLostTable() {
  if (m_correction || m_lostTable || !isWritten() || !controller::is_empty_table(m_preview->record.old_words.size())) {
    return false;
  }
  const auto history = bench().job()->history("upload");
  if (!history) return false;
  for (auto artefact = history->rbegin(); artefact != history->rend(); ++artefact) {
    const json body = artefact->document().value_or(json::object());
    const auto words = body.value("record", json::object()).value("new_words", std::vector<std::uint16_t>{});
    if (controller::is_empty_table(words.size())) continue;  // gone back to before the first one
    if (controller::same_table(words, m_preview->record.new_words)) return false;
    auto last = compensation::table_from_json(body.value("table", json::object()), "the uploaded table");
    if (!last) return false;
    m_lostTable = std::move(*last);
    return true;
  }
  return false;
}

/// What is active in the machine is not what this job has written: another one wrote, or it was started anew.
bool UploadPresenter::machineHoldsAnother() const {
  const json body = bench().body("upload");
  if (!body.is_object() || !m_preview) return false;
  const auto own = body.at("record").value("new_words", std::vector<std::uint16_t>{});
  const auto& now = m_preview->record.old_words;
  return !controller::same_table(own, now);
}

void UploadPresenter::tellForeign() {
  if (!machineHoldsAnother()) return;
  const auto& record = m_preview->record;
  const bool none = controller::is_empty_table(record.old_words.size());
  tell([version = record.old_sequence, none] {
    return none ? ui::Problem{ui::ProblemKind::warning,
                              tr("The machine holds no table: what this job wrote is not in it any more."),
                              tr("Write puts the last one back, with its corrections; the history has them all."),
                              {}}
                : ui::Problem{
                      ui::ProblemKind::warning,
                      tr("The machine holds version %1, which is not the table of this job.").arg(version),
                      tr("It was written from elsewhere. Compare before you write; it is kept in the history then."),
                      {}};
  });
}

/// Sensors that are outside the model's range stand in one sentence.
QStringList UploadPresenter::warningsInWords() const {
  static const std::string outside = ": the machine is outside the range the model was made in";
  QStringList sensors;
  QStringList warnings;
  for (const auto& warning : m_preview->record.warnings) {
    if (warning.ends_with(outside)) {
      sensors << bench().inWords(warning.substr(0, warning.size() - outside.size()));
    } else {
      warnings << bench().inWords(warning);
    }
  }
  if (!sensors.isEmpty()) {
    warnings.prepend(tr("The machine is outside the range the model was made in: %1").arg(ui::listText(sensors)));
  }
  return warnings;
}

/// What a person should know before the question is answered: a model above its limit, a machine outside its range.
QStringList UploadPresenter::doubtsOfWriting() const {
  QStringList doubts;
  const std::string& outdated = m_preview->model_outdated_by;
  if (!outdated.empty()) {
    doubts << tr("The model is out of date: %1 changed after it was fitted.").arg(stepName(outdated));
  }
  double peak_um = 0.0;
  const json model = bench().body("model");
  for (const auto& figure : model.is_object() ? model.value("figures", json::array()) : json::array()) {
    if (const auto peak = figure.find("peak_held_out_um"); peak != figure.end() && peak->is_number()) {
      peak_um = std::max(peak_um, peak->get<double>());
    }
  }
  if (!chosenTable() && peak_um > report::limits::attainable_peak_um) {
    doubts << tr("The fit leaves up to %1 µm on unseen stretches, above the limit of %2 µm.")
                  .arg(peak_um, 0, 'f', 1)
                  .arg(report::limits::attainable_peak_um, 0, 'f', 0);
  }
  for (const QString& warning : warningsInWords()) doubts << tr("%1.", "a whole sentence").arg(warning);
  return doubts;
}

/// What is written, a line each.
QString UploadPresenter::factsOfWriting() const {
  const auto& record = m_preview->record;
  const QString signs = m_correction   ? tr("Sign: as checked for the version before.")
                        : signStands() ? tr("Sign: checked at %1.").arg(m_signAt.toString(QStringLiteral("HH:mm")))
                                       : tr("Sign: each axis is first moved by 10 µm and back, watched by the camera.");
  const QString change = m_preview->largest_change_axis.empty()
                             ? tr("Nothing changes at the temperatures of this moment.")
                             : tr("Largest change now: %1 µm in %2.")
                                   .arg(m_preview->largest_change_um, 0, 'f', 1)
                                   .arg(QString::fromStdString(m_preview->largest_change_axis));
  const QString version =
      controller::is_empty_table(record.old_words.size())
          ? tr("Version %1; the machine holds no table now.").arg(record.sequence)
          : tr("Version %1 takes the place of version %2.").arg(record.sequence).arg(record.old_sequence);
  return QStringList{tr("Axes: %1.").arg(axes_text(m_preview->table)), change, version, signs,
                     tr("The compensation is off while it is written and on afterwards.")}
      .join(QLatin1Char('\n'));
}

void UploadPresenter::askAndWrite(Done done) {
  if (m_writing) return;
  // What is asked must be what is there now, so the machine is read again before.
  preview([this, done = std::move(done)](bool good) {
    if (!good || !m_preview) {
      if (done) done(false);
      return;
    }
    const auto& record = m_preview->record;
    const QString heading =
        tr("Write the table into %1?")
            .arg(tr("%1 (serial %2)").arg(QString::fromStdString(record.machine)).arg(record.serial));
    const QStringList doubts = doubtsOfWriting();
    QString text = factsOfWriting();
    if (doubts.size() == 1) text += QStringLiteral("\n\n") + doubts.first();
    if (doubts.size() > 1) {
      text += QStringLiteral("\n\n") +
              tr("%n warning(s), in the details. The first: %1", nullptr, static_cast<int>(doubts.size()))
                  .arg(doubts.first());
    }
    const QString details = doubts.size() > 1 ? doubts.join(QStringLiteral("\n\n")) : QString();
    if (confirmed(heading, text, tr("Write"), details)) {
      write(done);
    } else if (done) {
      done(false);
    }
  });
}

}  // namespace zerodrift::desktop
